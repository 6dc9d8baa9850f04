"""From a structure to its report: every number of the contract, and sentences where it falls short."""

import numpy as np

from plisse.geometry.vectors import norm
from plisse.measure.deviation import crease_deviation
from plisse.measure.measurements import Measurements, measure
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import MIN_SECTOR, OPENING_RANGE
from plisse.measure.sectors import angle_defect
from plisse.measure.shape import Shape
from plisse.measure.verdict import EXACT, FAR
from plisse.recipe import MILLIMETRES
from plisse.result import Interval, Report, Sheet, Spread
from plisse.structure.lines import joined
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure

__all__ = ["assess", "overlap_notes", "spread", "start_defects"]

ISOMETRIC = 1e-9
COARSEST = 20.0


def assess(structure: PleatedStructure, *, principal: bool = False, guides: np.ndarray | None = None,
           amplitude: float = 1.0, units: str = "mm", shape: Shape | None = None,
           astray: np.ndarray | None = None) -> Report:
    """Report on a structure: status, reasons, and every measure.

    `principal` says whether the principal defect belongs to the status; `guides` (m, n, 3) are the curves that the
    creases should follow, `amplitude` the unit of their deviation. What is known already, of the
    `shape` and of how far creases are `astray` in amplitudes, is not measured again. The pipeline adds timings and the way
    there.
    """
    found, inner = measure(structure, shape), structure.topology.is_inner
    shape = found.shape
    defects = [spread(shape.planarity), spread(shape.angle[inner])]
    kawasaki = spread(shape.principal[inner])
    exact = max(defect.max for defect in [*defects, *([kawasaki] if principal else [])]) <= EXACT
    deviation = _deviation(structure, guides, amplitude) if astray is None else spread(astray)
    reasons = [*_incomplete(shape), *_inexact(shape, principal), *_irregular(shape), *_not_isometric(found),
               *_astray(deviation), *_too_coarse(guides, amplitude)]
    degrees = np.degrees(shape.openings)
    return Report(
        status="exact" if not reasons else "infeasible" if exact and not _astray(deviation) else "approximate",
        reasons=reasons,
        vertices=structure.topology.vertex_count,
        faces=structure.topology.face_count,
        planarity=defects[0],
        angle_defect=defects[1],
        principal_defect=kawasaki,
        principal=bool(inner.any() and exact and kawasaki.max <= EXACT),
        min_sector_angle_deg=float(np.degrees(shape.sectors.min())),
        opening_angle_deg=Interval(float(degrees.min()), float(degrees.max())) if degrees.size else None,
        crease_deviation=deviation,
        inverted_faces=int(shape.inverted.sum()),
        self_intersections=len(shape.intersections),
        seams=len(joined(structure.topology.seams)),
        isometry=found.isometry,
        development=_sheet(structure, found, units),
        units=units,
    )


def spread(values: np.ndarray) -> Spread:
    """Largest and mean absolute value; zeros for no values."""
    magnitude = np.abs(values)
    return Spread(float(magnitude.max()), float(magnitude.mean())) if magnitude.size else Spread(0.0, 0.0)


def start_defects(zigzagged: PleatedStructure) -> dict[str, Spread]:
    """Planarity and angle defects of a zigzag before it is solved."""
    topology, vertices = zigzagged.topology, zigzagged.vertices
    return {"planarity": spread(planarity_defect(topology, vertices)),
            "angle_defect": spread(angle_defect(topology, vertices)[topology.is_inner])}


def overlap_notes(report: Report) -> list[str]:
    """What a maker must know about a development that covers a place twice."""
    sheet = report.development
    if sheet is None or not sheet.overlaps:
        return []
    place = "" if sheet.overlap_at_mm is None else f" near ({sheet.overlap_at_mm[0]:.0f}, {sheet.overlap_at_mm[1]:.0f}) mm"
    return [f"the development overlaps itself{place}; cut the sheet apart along rulings and join the pieces after folding"]


def _incomplete(shape: Shape) -> list[str]:
    pieces, out = shape.topology.components, []
    if not shape.openings.size:
        out.append("no crease lies between two faces, so there is no fold to judge")
    if pieces > 1:
        out.append(f"the mesh falls into {pieces} pieces; a structure is one")
    return out


def _inexact(shape: Shape, principal: bool) -> list[str]:
    topology, out = shape.topology, []
    if not shape.planarity.max() <= EXACT:
        worst = place_of(topology, topology.faces[int(np.argmax(shape.planarity))][0])
        out.append(f"faces are not planar: the defect reaches {shape.planarity.max():.1e} (limit {EXACT:.0e}) at {worst}")
    for name, defect in (("the sheet does not lie flat: angles miss 2π by", shape.angle),
                         ("the structure is not principal: opposite angles miss π by", shape.principal * principal)):
        vertex = int(np.argmax(np.abs(defect)))
        if not abs(defect[vertex]) <= EXACT:
            out.append(f"{name} {abs(defect[vertex]):.1e} rad (limit {EXACT:.0e}) at {place_of(topology, vertex)}")
    return out


def _irregular(shape: Shape) -> list[str]:
    topology, corners, out = shape.topology, shape.topology.corners, []
    if not shape.sectors.min() >= MIN_SECTOR:
        worst = place_of(topology, corners.vertex[int(np.argmin(shape.sectors))])
        out.append(f"faces are slivers: an angle is only {np.degrees(shape.sectors.min()):.2f}° (limit 5°) at {worst}; "
                   "a larger amplitude, less torsion or fewer creases help")
    if shape.inverted.any():
        worst = place_of(topology, topology.faces[int(np.argmax(shape.inverted))][0])
        out.append(f"{shape.inverted.sum()} faces are folded over, the first at {worst}; a larger amplitude, narrower "
                   "strips or fewer creases help")
    out += _unfolded(shape)
    if len(shape.intersections):
        one, other = (place_of(topology, topology.faces[face][0]) for face in shape.intersections[0])
        out.append(f"the folded shape cuts through itself in {len(shape.intersections)} pairs of faces, for example {one} "
                   f"and {other}; fewer creases, narrower strips or a shorter curve help")
    return out


def _unfolded(shape: Shape) -> list[str]:
    """Creases that are folded shut, or no fold at all."""
    edges = shape.topology.edges
    out: list[str] = []
    if not shape.openings.size:
        return out
    first = edges.vertices[edges.is_crease & ~edges.is_boundary, 0]
    low, high = OPENING_RANGE
    for wrong, index, what in ((shape.openings.min() <= low, np.argmin(shape.openings),
                                "folded shut, a smaller amplitude or theta"),
                               (shape.openings.max() >= high, np.argmax(shape.openings), "no fold, a larger amplitude")):
        if wrong:
            out.append(f"the opening angle is {np.degrees(shape.openings[index]):.2f}° (limits {np.degrees(low):.0f}° and "
                       f"{np.degrees(high):.0f}°) at {place_of(shape.topology, first[index])}: {what} helps")
    return out


def _not_isometric(found: Measurements) -> list[str]:
    if found.isometry is None or found.isometry <= ISOMETRIC:
        return []
    return [f"the development differs from the folded state by {found.isometry:.1e} mean edge lengths "
            f"(limit {ISOMETRIC:.0e})"]


def _astray(deviation: Spread | None) -> list[str]:
    if deviation is None or deviation.max < FAR:
        return []
    return [f"creases stray up to {deviation.max:.1f} amplitudes from their guiding curves (limit {FAR:g}), so this is not "
            "the shape that was asked for; less torsion, fewer creases or a design that is not principal help"]


def _too_coarse(guides: np.ndarray | None, amplitude: float) -> list[str]:
    """Folds much smaller than the distance between vertices: exact perhaps, but no picture of the curves."""
    step = 0.0 if guides is None else float(norm(np.diff(guides, axis=1)).mean())
    if step <= COARSEST * amplitude:
        return []
    return [f"vertices along a crease are {step / amplitude:.0f} amplitudes apart (limit {COARSEST:g}), so the folds are "
            "lost between them; raise pattern.amplitude to about half of pattern.width, or raise pattern.samples"]


def _deviation(structure: PleatedStructure, guides: np.ndarray | None, amplitude: float) -> Spread | None:
    if guides is None:
        return None
    creases = structure.vertices.reshape(len(guides), -1, 3)
    closed = structure.topology.creases[0].closed
    return spread(crease_deviation(creases, guides, closed) / amplitude)


def _sheet(structure: PleatedStructure, found: Measurements, units: str) -> Sheet | None:
    if structure.development is None or found.overlap is None:
        return None
    scale = MILLIMETRES[units]
    width, height = (float(x) for x in scale * np.ptp(structure.development, axis=0))
    place = found.overlap.place
    return Sheet(found.overlap.overlaps, (width, height),
                 None if place is None else (scale * place[0], scale * place[1]), structure.cut.topology.components)

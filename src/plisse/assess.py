"""From a structure to its report: every number of the contract, and sentences where it falls short."""

import numpy as np

from plisse.recipe import MILLIMETRES, Design
from plisse.measure.deviation import crease_deviation
from plisse.measure.folds import crease_opening_angles
from plisse.measure.intersection import intersecting_faces
from plisse.measure.overlap import development_overlap
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import MIN_SECTOR, OPENING_RANGE, regularity
from plisse.measure.sectors import angle_defect, principal_defect, sector_angles
from plisse.measure.verdict import EXACT
from plisse.result import Interval, Report, Sheet, Spread
from plisse.solve.flatten import isometry_error
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure

__all__ = ["assess", "spread", "start_defects"]

ISOMETRIC = 1e-9


def assess(structure: PleatedStructure, *, principal: bool = False, design: Design | None = None,
           guides: np.ndarray | None = None, amplitude: float = 1.0, units: str = "mm") -> Report:
    """Report on a structure: status, reasons, and every measure; `guides` (m, n, 3) where creases were guided.

    `principal` says whether the principal defect belongs to the status. Timings and the way there are added by
    the pipeline.
    """
    topology, vertices = structure.topology, structure.vertices
    reasons = (_inexact(structure, principal) + _irregular(structure) + _intersecting(structure)
               + _not_isometric(structure))
    inner = ~topology.is_boundary
    angle, kawasaki = angle_defect(topology, vertices)[inner], principal_defect(topology, vertices)[inner]
    quality = regularity(topology, vertices)
    planarity = planarity_defect(topology, vertices)
    defects = [spread(planarity), spread(angle)] + ([spread(kawasaki)] if principal else [])
    exact = max(defect.max for defect in defects) <= EXACT
    return Report(
        status="exact" if not reasons else "infeasible" if exact else "approximate",
        reasons=reasons,
        vertices=topology.vertex_count,
        faces=topology.face_count,
        planarity=spread(planarity),
        angle_defect=spread(angle),
        principal_defect=spread(kawasaki),
        principal=bool(spread(kawasaki).max <= EXACT),
        min_sector_angle_deg=float(np.degrees(quality.min_sector)),
        opening_angle_deg=Interval(float(np.degrees(quality.min_opening)), float(np.degrees(quality.max_opening))),
        crease_deviation=_deviation(structure, guides, amplitude),
        inverted_faces=quality.inverted,
        self_intersections=len(intersecting_faces(topology, vertices)),
        isometry=isometry_error(structure) if structure.development is not None else None,
        development=_sheet(structure, units),
        units=units,
        design=design.to_dict() if design is not None else {},
    )


def spread(values: np.ndarray) -> Spread:
    """Largest and mean absolute value; zeros for no values."""
    magnitude = np.abs(values)
    return Spread(float(magnitude.max()), float(magnitude.mean())) if magnitude.size else Spread(0.0, 0.0)


def start_defects(zigzagged: PleatedStructure) -> dict[str, Spread]:
    """Planarity and angle defects of a zigzag before it is solved."""
    topology, vertices = zigzagged.topology, zigzagged.vertices
    return {"planarity": spread(planarity_defect(topology, vertices)),
            "angle_defect": spread(angle_defect(topology, vertices)[~topology.is_boundary])}


def _inexact(structure: PleatedStructure, principal: bool) -> list[str]:
    topology, vertices = structure.topology, structure.vertices
    out = []
    planarity = planarity_defect(topology, vertices)
    if planarity.max() > EXACT:
        face = topology.faces[int(np.argmax(planarity))]
        out.append(f"planarity stays at {planarity.max():.1e} (limit {EXACT:.0e}), worst at {place_of(topology, face[0])}; "
                   "lower the torsion or the number of creases, or change pattern.amplitude")
    for name, defect, wanted in (("angle sums miss 2π by", angle_defect(topology, vertices), True),
                                 ("opposite angles miss π by", principal_defect(topology, vertices), principal)):
        worst = int(np.argmax(np.abs(defect)))
        if wanted and abs(defect[worst]) > EXACT:
            out.append(f"{name} {abs(defect[worst]):.1e} rad (limit {EXACT:.0e}), worst at {place_of(topology, worst)}; "
                       "lower pattern.width or pattern.creases, or change pattern.theta")
    return out


def _irregular(structure: PleatedStructure) -> list[str]:
    topology, vertices = structure.topology, structure.vertices
    quality, out = regularity(topology, vertices), []
    if quality.min_sector < MIN_SECTOR:
        corner = int(np.argmin(sector_angles(topology, vertices)))
        out.append(f"a face has an angle of only {np.degrees(quality.min_sector):.2f}° (limit 5°) at "
                   f"{place_of(topology, topology.corners.vertex[corner])}; raise pattern.amplitude, lower the torsion of "
                   "the seed curve, or keep fewer creases")
    if quality.inverted:
        out.append(f"{quality.inverted} faces are folded over themselves; raise pattern.amplitude, lower pattern.width, "
                   "or keep fewer creases")
    low, high = np.degrees(OPENING_RANGE)
    edges = topology.edges
    inner = np.flatnonzero(edges.is_crease & ~edges.is_boundary)
    opening = np.degrees(crease_opening_angles(topology, vertices))
    if opening.size and opening.min() <= low:
        where = place_of(topology, edges.vertices[inner[np.argmin(opening)], 0])
        out.append(f"a crease closes to an opening angle of {opening.min():.2f}° (limit {low:.0f}°) at {where}; lower "
                   "pattern.theta or pattern.amplitude")
    if opening.size and opening.max() >= high:
        where = place_of(topology, edges.vertices[inner[np.argmax(opening)], 0])
        out.append(f"a crease opens to {opening.max():.2f}° (limit {high:.0f}°) at {where}, so it is no fold; raise "
                   "pattern.amplitude")
    return out


def _intersecting(structure: PleatedStructure) -> list[str]:
    pairs = intersecting_faces(structure.topology, structure.vertices)
    if len(pairs) == 0:
        return []
    one, other = (place_of(structure.topology, structure.topology.faces[face][0]) for face in pairs[0])
    return [f"the folded shape cuts through itself in {len(pairs)} places, for example {one} and {other}; keep fewer "
            "creases, lower pattern.width, or shorten the seed curve"]


def _not_isometric(structure: PleatedStructure) -> list[str]:
    if structure.development is None:
        return ["the structure has no development"]
    error = isometry_error(structure)
    if error <= ISOMETRIC:
        return []
    return [f"the development differs from the folded state by {error:.1e} mean edge lengths (limit {ISOMETRIC:.0e}), "
            "because angle sums or planarity are not exact"]


def _deviation(structure: PleatedStructure, guides: np.ndarray | None, amplitude: float) -> Spread | None:
    if guides is None:
        return None
    creases = structure.vertices.reshape(len(guides), -1, 3)
    closed = structure.topology.creases[0].closed
    return spread(crease_deviation(creases, guides, closed) / amplitude)


def _sheet(structure: PleatedStructure, units: str) -> Sheet | None:
    if structure.development is None:
        return None
    scale = MILLIMETRES[units]
    width, height = (float(x) for x in scale * np.ptp(structure.development, axis=0))
    overlap = development_overlap(structure.cut.topology, structure.development)
    place = None if overlap.place is None else (scale * overlap.place[0], scale * overlap.place[1])
    return Sheet(overlap.overlaps, (width, height), place)

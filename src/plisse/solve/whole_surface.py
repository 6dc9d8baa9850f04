"""A whole surface pleated: layouts scanned, solved as they come, and the best refined (§3.1, Figs 20 and 23).

Where one piece does not reach, sheets are cut apart along seams and solved together.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.parametric import ParametricSurface
from plisse.layout.automatic import (
    OVERHANG_LIMIT,
    UPRIGHT_LIMIT,
    Layout,
    Sizes,
    centres,
    lay_out,
    sensible_width,
    starting_rows,
)
from plisse.layout.coverage import AreaSamples, covered
from plisse.layout.rows import ChartedSurface
from plisse.layout.straight import Straight, straight_and_round
from plisse.measure.folds import crease_opening_angles
from plisse.measure.inclination import crease_inclinations, overhanging
from plisse.measure.mid_surface import MidSurfaceDeviation, mid_surface_deviation
from plisse.measure.regularity import OPENING_RANGE
from plisse.measure.sectors import sector_angles
from plisse.solve.candidate import FULL, Candidate, holes_of
from plisse.solve.masked import Trim, solve_masked
from plisse.solve.seams import seam_defects
from plisse.solve.search import Jobs, best_of, stages
from plisse.structure.pleated import PleatedStructure

__all__ = ["Candidate", "WholeSurface", "whole_surface"]

FOLDABLE = np.radians(15.0)
REACH = 3.0  # how far from the reference the structure counts as lying over it, in widths
AMPLITUDE = 0.8  # in widths: lower pleats cover less, higher ones open less
SCAN = Trim(rounds=7, hold=0.1)

Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class WholeSurface:
    """An exact structure over a surface, without development, and how it lies there.

    `inclination` (K,) in radians belongs to the inner crease edges of the topology, `rows` (V,) number the creases,
    `overhanging` is the fraction of faces that lean beyond the surface normal.
    `candidates` are all that were solved, in order; `notes` sentences for the report.
    """

    structure: PleatedStructure
    coverage: float
    deviation: MidSurfaceDeviation
    inclination: np.ndarray
    rows: np.ndarray
    overhanging: float
    best: Candidate
    candidates: tuple[Candidate, ...]
    notes: tuple[str, ...]

    @property
    def inclination_by_crease(self) -> dict[int, np.ndarray]:
        """Inclinations in radians along every crease, by its number among the rows; creases at the rim have none."""
        edges = self.structure.topology.edges
        row = self.rows[edges.vertices[edges.is_crease & ~edges.is_boundary, 0]]
        return {int(k): self.inclination[row == k] for k in np.unique(row)}


@dataclass(frozen=True, eq=False)
class _Task:
    """What all candidates share."""

    mesh: ReferenceMesh
    surface: ChartedSurface
    samples: AreaSamples
    least_opening: float
    upright: bool

    @property
    def is_annulus(self) -> bool:
        """Whether rows can run around between two boundaries."""
        try:
            starting_rows(self.mesh, self.surface, None, self.mesh.diagonal)
        except Infeasible:
            return False
        return True

    def layout(self, centre: Straight | np.ndarray | None, sizes: Sizes) -> Layout:
        if isinstance(centre, Straight):
            assert isinstance(self.surface, ParametricSurface)
            return lay_out(centre.rows(self.surface, sizes.width, inside=sizes.inside), self.samples, self.surface, sizes,
                           centre.label(self.surface))
        rows = starting_rows(self.mesh, self.surface, centre, sizes.width, parallel=not sizes.inside)
        if centre is None:
            return lay_out(rows, self.samples, self.surface, sizes, "rows between the boundaries")
        x, y, z = self.surface.to_space(np.array([[*centre, 0.0]]))[0] + 0.0
        label = f"centre ({x:.4g}, {y:.4g}, {z:.4g})"
        return replace(lay_out(rows, self.samples, self.surface, sizes, label), centre=np.asarray(centre))

    def solved(self, layout: Layout, trim: Trim, seams: tuple[int, ...] = ()) -> Candidate | None:
        trim = replace(trim, least_opening=self.least_opening)
        found = solve_masked(layout.zigzag, layout.net.normals, layout.mask, layout.net.closed, trim, seams=seams,
                             is_ring=layout.net.is_ring)
        if found is None:
            return None
        topology = found.grid.topology
        normals = layout.net.normals.reshape(-1, 3)[found.grid.used][topology.quads].sum(axis=1)
        return Candidate(layout, found,
                         covered(self.samples, found.vertices, topology.quads, REACH * layout.sizes.width),
                         mid_surface_deviation(self.surface, found.vertices, topology.quads),
                         float(crease_opening_angles(topology, found.vertices).min(initial=np.pi)),
                         float(np.minimum(angles := sector_angles(topology, found.vertices), np.pi - angles).min()),
                         holes_of(topology, self.mesh), overhanging(topology, found.vertices, normals), self.upright)


def whole_surface(mesh: ReferenceMesh, surface: ChartedSurface, *, width: float | None = None,
                  amplitude: float | None = None, theta: float | None = None, centre: np.ndarray | None = None,
                  overhang: bool = False, above: bool = False, inside: bool = False, candidates: int = 20,
                  seams: int | None = None, progress: Progress | None = None) -> WholeSurface:
    """An exact, regular structure over as much of a surface as can be had.

    Lengths are in model units, `theta` (preferred inclination) is in radians. Only layouts around `centre` (3,) are
    tried where it is given; it may lie anywhere, its chart coordinates count. Without `overhang` creases open by 15° at
    least and layouts prefer |θ| below 45°, which solving may exceed. The first crease lies `above` the surface or below;
    with `inside` no row reaches beyond its boundary. At most `seams` cut it apart; None leaves it in one piece unless no
    centre is given and seams cover notably more. `progress` hears the stage and how much of it is done. Raises
    Infeasible where no layout has a solution.
    """
    report = progress or (lambda stage, fraction: None)
    width = width or sensible_width(mesh, surface)
    limit, opening = (OVERHANG_LIMIT, OPENING_RANGE[0]) if overhang else (UPRIGHT_LIMIT, FOLDABLE)
    task = _Task(mesh, surface, AreaSamples.of(mesh.vertices, mesh.triangles), opening, not overhang)
    sizes = Sizes(width, amplitude or AMPLITUDE * width, theta or 0.0, limit, 0.0, above=above, inside=inside)
    if centre is not None and isinstance(surface, ParametricSurface) and surface.period is not None:
        raise Infeasible("creases go up a tube or around it, not around a centre; leave out surface.centre")
    place = None if centre is None else surface.to_plane(np.asarray(centre, float)[None])[0, :2]
    seams = 0 if seams is None and centre is not None else seams
    layouts: list[Layout] = []
    tried: list[Candidate] = []
    for stage, jobs in stages(_first(task, sizes, place, candidates), layouts, tried, seams):
        for fraction, layout, trim, columns in jobs:
            report(stage, fraction)
            layouts.append(layout)
            candidate = task.solved(layout, trim, columns)
            tried += [candidate] if candidate else []
            if candidate and candidate.is_done:
                return _finished(candidate, tuple(tried))
    if not tried:
        raise Infeasible("no layout over this surface has a solution; a smaller width or a smoother surface may help")
    return _finished(best_of(tried, seams), tuple(tried))


def _first(task: _Task, sizes: Sizes, centre: np.ndarray | None, count: int) -> Jobs:
    """Layouts around one centre or many; for an annulus, rows between its boundaries, of several widths."""
    jobs: list[tuple[Straight | np.ndarray | None, Sizes]] = []
    if centre is None and isinstance(task.surface, ParametricSurface):
        jobs += straight_and_round(task.mesh, task.surface, sizes, count)
    elif centre is None and task.is_annulus:
        jobs += [(None, replace(sizes, width=sizes.width * size, amplitude=sizes.amplitude * size * height,
                               curvature=weight, limit=limit))
                for limit, weight in ((OVERHANG_LIMIT, 0.0), (OVERHANG_LIMIT, 1.0), (sizes.limit, 0.0))
                for size, height in ((1.0, 1.5), (0.8, 1.5), (1.0, 1.0))]
    elif centre is None:
        jobs += [(place, sizes) for place in centres(task.mesh, task.surface, count)]
    else:
        jobs += [(centre, replace(sizes, curvature=weight)) for weight in (0.0, 1.0)]
    for k, (place, size) in enumerate(jobs):
        yield k / len(jobs), task.layout(place, size), SCAN, ()


def _finished(best: Candidate, tried: tuple[Candidate, ...]) -> WholeSurface:
    part, net = best.solved.grid, best.layout.net
    vertices = best.solved.vertices
    normals, outward = (field.reshape(-1, 3)[part.used] for field in (net.normals, net.outward))
    inclination = crease_inclinations(part.topology, vertices, normals, outward)
    notes = _notes(best, inclination)
    structure = PleatedStructure(part.topology, vertices)
    return WholeSurface(structure, best.coverage, best.deviation, inclination, part.rows, best.overhanging, best, tried,
                        tuple(notes))


def _notes(best: Candidate, inclination: np.ndarray) -> Iterator[str]:
    """Sentences on inclinations, holes and parts left out."""
    leaning, sizes = f"{100 * best.overhanging:.0f} % of the faces overhang", best.layout.sizes
    yield (f"fitted inclination, {best.layout.label}, width {sizes.width:.4g}, amplitude {sizes.amplitude:.4g}: θ runs from "
           f"{np.degrees(inclination.min()):.0f}° to {np.degrees(inclination.max()):.0f}°"
           + ("" if best.upright else f", {leaning}"))
    if best.upright and best.overhanging > 0:
        yield (f"overhang = false keeps creases open by {np.degrees(FOLDABLE):.0f}° and prefers upright pleats; {leaning} "
               "all the same")
    if best.holes > 0:
        yield f"the structure has {best.holes} hole{'s' if best.holes > 1 else ''} where no exact pleats were found"
    if best.seams:
        defects = np.degrees(seam_defects(best.solved.grid.topology, best.solved.vertices))
        yield (f"{len(best.seams)} seam{'s' if len(best.seams) > 1 else ''} cut the sheet apart, along the columns "
               f"{', '.join(map(str, best.seams))} of {best.layout.mask.shape[1]}; angles there miss 360° by "
               f"{defects.mean():.0f}° on average and {defects.max():.0f}° at most")
    if best.coverage < FULL:
        yield f"{100 * (1 - best.coverage):.1f} % of the surface are not covered"
    if not best.solved.is_sound:
        yield "no layout came out exact and regular; this is the nearest one"

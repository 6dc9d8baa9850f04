"""A whole surface pleated: layouts scanned, solved as they come, and the best refined (§3.1, Figs 20 and 23).

Coverage at full regularity counts first, then nearness, then opening angles that one can fold.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
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
from plisse.measure.folds import crease_opening_angles
from plisse.measure.inclination import crease_inclinations
from plisse.measure.mid_surface import MidSurfaceDeviation, mid_surface_deviation
from plisse.measure.regularity import OPENING_RANGE
from plisse.solve.masked import Masked, Trim, solve_masked
from plisse.structure.pleated import PleatedStructure

__all__ = ["Candidate", "WholeSurface", "whole_surface"]

FOLDABLE = np.radians(15.0)
REACH = 3.0  # how far from the reference the structure counts as lying over it, in widths
FULL = 0.995  # coverage that is as good as all
SLENDER, STOUT = 0.5, 0.8  # amplitudes in widths
SCAN = Trim(rounds=7, hold=0.03)
HOLDS = (0.3, 0.1, 0.01, 0.0)
FINALISTS = 3
FARNESS = 0.02  # coverage that one amplitude of mean deviation is worth

Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Candidate:
    """A layout and what came of it: coverage, deviation of the mid-surface, opening angles (K,) in radians."""

    layout: Layout
    solved: Masked
    coverage: float
    deviation: MidSurfaceDeviation
    openings: np.ndarray

    @property
    def mean_deviation(self) -> float:
        """Mean deviation in amplitudes."""
        return self.deviation.mean / self.layout.sizes.amplitude

    @property
    def rank(self) -> tuple[bool, float]:
        """Sort key: soundness, then coverage and nearness weighed against each other, with a little for openness."""
        open_ = min(float(np.degrees(self.openings.min(initial=np.pi / 6))), 30.0) / 30
        return self.solved.is_sound, min(self.coverage, FULL) - FARNESS * self.mean_deviation + 0.005 * open_

    @property
    def is_full(self) -> bool:
        """Whether nothing is left to be covered."""
        return self.solved.is_sound and self.coverage >= FULL


@dataclass(frozen=True, eq=False)
class WholeSurface:
    """An exact structure over a surface, without development, and how it lies there.

    `inclination` (K,) in radians belongs to the inner crease edges of the topology, `rows` (V,) number the creases.
    `candidates` are all that were solved, in order; `notes` sentences for the report.
    """

    structure: PleatedStructure
    coverage: float
    deviation: MidSurfaceDeviation
    inclination: np.ndarray
    rows: np.ndarray
    best: Candidate
    candidates: tuple[Candidate, ...]
    notes: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class _Task:
    """What all candidates share."""

    mesh: ReferenceMesh
    surface: ChartedSurface
    samples: AreaSamples
    least_opening: float

    def layout(self, centre: np.ndarray | None, sizes: Sizes) -> Layout:
        rows = starting_rows(self.mesh, self.surface, centre, sizes.width)
        label = "rows between the boundaries" if centre is None else f"centre ({centre[0]:.4g}, {centre[1]:.4g})"
        return lay_out(rows, self.samples, self.surface, sizes, label)

    def solved(self, layout: Layout, trim: Trim) -> Candidate | None:
        trim = replace(trim, least_opening=self.least_opening)
        found = solve_masked(layout.zigzag, layout.net.normals, layout.mask, layout.net.closed, trim)
        if found is None:
            return None
        topology = found.grid.topology
        return Candidate(layout, found,
                         covered(self.samples, found.vertices, topology.quads, REACH * layout.sizes.width),
                         mid_surface_deviation(self.surface, found.vertices, topology.quads),
                         crease_opening_angles(topology, found.vertices))


def whole_surface(mesh: ReferenceMesh, surface: ChartedSurface, *, width: float | None = None,
                  amplitude: float | None = None, theta: float | None = None, centre: np.ndarray | None = None,
                  overhang: bool = False, candidates: int = 20, progress: Progress | None = None) -> WholeSurface:
    """An exact, regular structure over as much of a surface as can be had in one piece.

    Lengths are in model units, `theta` (preferred inclination) in radians, `centre` (2,) in the surface's chart: with
    a centre only layouts around it are tried. Without `overhang` |θ| stays below 45° and creases open by 15° at
    least. Raises Infeasible where no layout has a solution.
    """
    report = progress or (lambda stage, fraction: None)
    width = width or sensible_width(mesh, surface)
    limit = OVERHANG_LIMIT if overhang else UPRIGHT_LIMIT
    task = _Task(mesh, surface, AreaSamples.of(mesh.vertices, mesh.triangles), OPENING_RANGE[0] if overhang else FOLDABLE)
    variants = [Sizes(width, amplitude or ratio * width, theta or 0.0, limit, curvature)
                for ratio, curvature in ((SLENDER, 1.0), (STOUT, 0.0))]
    around: list[np.ndarray | None] = [centre] if centre is not None else list(centres(mesh, surface, candidates))
    if centre is None and len(mesh.boundary_loops) == 2:
        around = [None]
    tried = list(_scan(task, around, variants, report))
    if not tried:
        raise Infeasible("no layout over this surface has a solution; a smaller width or a smoother surface may help")
    best = list(_refined(task, tried, report))
    tried += best
    return _finished(task, max(tried, key=lambda candidate: candidate.rank), tuple(tried))


def _scan(task: _Task, around: Iterable[np.ndarray | None], variants: list[Sizes],
          report: Progress) -> Iterator[Candidate]:
    """Candidates in turn; the scan ends when two cover everything and lie near."""
    jobs = [(centre, sizes) for centre in around for sizes in variants]
    good = 0
    for k, (centre, sizes) in enumerate(jobs):
        report("scan", k / len(jobs))
        candidate = task.solved(task.layout(centre, sizes), SCAN)
        if candidate is None:
            continue
        yield candidate
        good += candidate.is_full
        if good >= 2:
            return


def _refined(task: _Task, tried: list[Candidate], report: Progress) -> Iterator[Candidate]:
    """The best layouts solved again, held nearer to the reference or left freer."""
    finalists = sorted(tried, key=lambda candidate: candidate.rank, reverse=True)[:FINALISTS]
    jobs = [(candidate, hold) for candidate in finalists for hold in HOLDS]
    for k, (candidate, hold) in enumerate(jobs):
        report("refine", k / len(jobs))
        again = task.solved(candidate.layout, Trim(hold=hold))
        if again is not None:
            yield again


def _finished(task: _Task, best: Candidate, tried: tuple[Candidate, ...]) -> WholeSurface:
    part, net = best.solved.grid, best.layout.net
    normals, outward = (field.reshape(-1, 3)[part.used] for field in (net.normals, net.outward))
    inclination = crease_inclinations(part.topology, best.solved.vertices, normals, outward)
    return WholeSurface(PleatedStructure(part.topology, best.solved.vertices), best.coverage, best.deviation,
                        inclination, part.rows, best, tried, tuple(_notes(best, inclination)))


def _notes(best: Candidate, inclination: np.ndarray) -> Iterator[str]:
    """Sentences on holes, parts left out, and inclinations."""
    topology = best.solved.grid.topology
    yield (f"fitted inclination, {best.layout.label}: θ runs from {np.degrees(inclination.min()):.0f}° to "
           f"{np.degrees(inclination.max()):.0f}°")
    holes = (0 if best.layout.net.closed else 1) - topology.euler_characteristic
    if holes > 0:
        yield f"the structure has {holes} hole{'s' if holes > 1 else ''} where no exact pleats were found"
    if best.coverage < FULL:
        yield f"{100 * (1 - best.coverage):.1f} % of the surface are not covered"
    if not best.solved.is_sound:
        yield "no layout came out exact and regular; this is the nearest one"

"""From a guide or a point on a surface to a structure of constant inclination (§3.1, Figs 2, 12, 20)."""

import msgspec
import numpy as np

from plisse.assess import assess, overlap_notes, spread, start_defects
from plisse.designs.families import SAMPLES, family_of
from plisse.designs.outcomes import broken_down, way_of
from plisse.designs.reconstruction import deviation_of, lies_over, overhang_notes
from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.polyline import distance_to_polyline
from plisse.geometry.surface import Surface
from plisse.layout.coverage import AreaSamples
from plisse.layout.family import Family
from plisse.layout.family_columns import pattern_of
from plisse.layout.family_outline import outlined
from plisse.layout.rectangle import GAPS
from plisse.recipe import SurfaceDesign
from plisse.result import Overlay, Report, Result
from plisse.solve.attempt import Start
from plisse.solve.candidate import holes_of
from plisse.solve.cutting import best_cut
from plisse.solve.energies import Guides
from plisse.solve.flatten import flatten, laid_out
from plisse.solve.masked import solve_masked
from plisse.solve.paper import solve_paper
from plisse.solve.portfolio import GUIDED, GUIDED_PRINCIPAL, solve
from plisse.solve.zigzag import zigzag
from plisse.stopwatch import Stopwatch
from plisse.structure.pleated import PleatedStructure

__all__ = ["guided"]

FAN_GAPS = (0.5, 2.0)  # where a fan begins and ends, in gaps of a flat disk
COVERED = 0.9  # coverage below which the report says how to get more
EVEN = 1.25  # largest over smallest width of a strip up to which principal structures were found


def guided(recipe: SurfaceDesign, mesh: ReferenceMesh, surface: Surface, watch: Stopwatch) -> Result:
    """Creases of constant inclination, shot from a guide or around a point, and what becomes of them."""
    watch.start("layout", 0.1)
    try:
        family = family_of(recipe.surface, recipe.pattern, mesh, surface)
        if recipe.surface.crop == "outline":
            watch.start("solve", 0.3)
            return _to_the_outline(recipe, family, mesh, surface, watch)
        start = _start(recipe, family, surface)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    watch.start("solve", 0.3)
    return (_by_the_paper if recipe.solve.method == "paper" else _exactly)(recipe, start, mesh, surface, watch)


def _start(recipe: SurfaceDesign, family: Family, surface: Surface) -> Start:
    section, amplitude = recipe.surface, recipe.pattern.amplitude
    assert amplitude is not None
    fan = section.point is not None
    pattern = pattern_of(family, surface, amplitude, recipe.pattern.samples or SAMPLES, ends=section.boundary and not fan,
                         crop=recipe.pattern.creases is None, gaps=FAN_GAPS if fan else GAPS)
    return Start(pattern, amplitude, pattern.samples, recipe.solve.principal)


def _exactly(recipe: SurfaceDesign, start: Start, mesh: ReferenceMesh, surface: Surface, watch: Stopwatch) -> Result:
    outcome = solve([(start, GUIDED_PRINCIPAL if start.principal else GUIDED)])
    best = outcome.best
    if best.attempt.vertices is None:
        return broken_down(recipe, [best.attempt.message], watch)
    watch.start("flatten", 0.8)
    structure = PleatedStructure(start.topology, best.attempt.vertices)
    structure = flatten(structure, best_cut(structure, recipe.solve.cut))
    watch.start("measure", 0.9)
    report = assess(structure, principal=start.principal, guides=start.guides(start.samples), amplitude=start.amplitude,
                    units=recipe.units, shape=best.shape, astray=best.astray)
    reasons = report.reasons + (_uneven(start) if start.principal and report.reasons else [])
    report = msgspec.structs.replace(report, reasons=reasons, **way_of(outcome))
    return _over(recipe, start, structure, report, mesh, surface, watch)


def _by_the_paper(recipe: SurfaceDesign, start: Start, mesh: ReferenceMesh, surface: Surface, watch: Stopwatch) -> Result:
    """Functional (5) as printed (§3.4)."""
    first, binormals = zigzag(start.pattern, start.amplitude), start.pattern.binormals.reshape(-1, 3)
    topology, cut = first.topology, best_cut(first, recipe.solve.cut)
    found = solve_paper(topology, first.vertices, Guides.along_creases(topology, first.vertices, binormals), cut=cut,
                        weights=recipe.solve.weights, iterations=recipe.solve.iterations, principal=start.principal)
    watch.start("measure", 0.9)
    structure = PleatedStructure(topology, found.vertices, cut, laid_out(cut.topology, found.development))
    report = assess(structure, principal=start.principal, guides=start.guides(start.samples), amplitude=start.amplitude,
                    units=recipe.units)
    report = msgspec.structs.replace(report, iterations=found.iterations, method="paper",
                                     history=[float(value) for value in found.history])
    return _over(recipe, start, structure, report, mesh, surface, watch)


def _over(recipe: SurfaceDesign, start: Start, structure: PleatedStructure, report: Report, mesh: ReferenceMesh,
          surface: Surface, watch: Stopwatch) -> Result:
    """The result with what lies where over the surface."""
    coverage, deviation = lies_over(structure, mesh, surface, start.amplitude)
    first = zigzag(start.pattern, start.amplitude)
    report = msgspec.structs.replace(
        report, start=start_defects(first), coverage=coverage, seconds=watch.stop(), design=recipe.to_dict(),
        deviation=deviation_of(deviation, mesh.diagonal, start.amplitude),
        warnings=[*_coverage_notes(recipe, coverage), *overhang_notes(structure, surface, recipe.pattern),
                  *overlap_notes(report)])
    return Result(recipe, report, start.pattern, first, structure, Overlay(mesh, deviation.distances, start.amplitude))


def _to_the_outline(recipe: SurfaceDesign, family: Family, mesh: ReferenceMesh, surface: Surface,
                    watch: Stopwatch) -> Result:
    """All quads of a family that meet the surface, without those that cannot become exact."""
    section, amplitude = recipe.surface, recipe.pattern.amplitude
    assert amplitude is not None
    layout = outlined(family, surface, AreaSamples.of(mesh.vertices, mesh.triangles), amplitude,
                      recipe.pattern.samples or SAMPLES, section.boundary)
    found = solve_masked(layout.zigzag, layout.normals, layout.mask, layout.closed)
    if found is None:
        raise Infeasible("hardly any part of the family can become exact; give another guide, another theta, or a larger "
                         "amplitude")
    watch.start("flatten", 0.8)
    structure = PleatedStructure(found.grid.topology, found.vertices)
    structure = flatten(structure, best_cut(structure))
    watch.start("measure", 0.9)
    report = assess(structure, amplitude=amplitude, units=recipe.units)
    coverage, deviation = lies_over(structure, mesh, surface, amplitude)
    astray = np.concatenate([distance_to_polyline(found.vertices[found.grid.rows == row], layout.zigzag[row], layout.closed)
                             for row in np.unique(found.grid.rows)])
    lost = layout.mask.sum() - len(found.grid.topology.quads)
    notes = [f"{lost} of {layout.mask.sum()} quads were left out, because they cannot become exact"] if lost else []
    report = msgspec.structs.replace(
        report, seconds=watch.stop(), design=recipe.to_dict(), coverage=coverage, method="optimised, cropped to the outline",
        deviation=deviation_of(deviation, mesh.diagonal, amplitude), crease_deviation=spread(astray / amplitude),
        iterations=len(found.history), holes=holes_of(structure.topology, mesh),
        warnings=[*notes, *_coverage_notes(recipe, coverage), *overhang_notes(structure, surface, recipe.pattern),
                  *overlap_notes(report)])
    return Result(recipe, report, structure=structure, overlay=Overlay(mesh, deviation.distances, amplitude))


def _coverage_notes(recipe: SurfaceDesign, coverage: float) -> list[str]:
    """How much of the surface lies under the structure where that is little, and what would cover more."""
    if coverage >= COVERED:
        return []
    section = recipe.surface
    around = section.point is not None and not section.directions
    closed = around or section.guide_closed or section.guide_boundary is not None
    remedies = ['surface.crop = "outline"'] * (section.crop != "outline" and not closed)
    remedies += ["a larger surface.reach"] * (section.reach is not None) + ["surface.beyond = true"] * (
        not section.beyond and not section.boundary and section.crop != "outline")
    return [f"only {100 * coverage:.0f} % of the surface lie under the structure: "
            f"{', '.join(remedies) + ', ' * bool(remedies)}another guide or another theta may cover more"]


def _uneven(start: Start) -> list[str]:
    """Why a family has no principal structure near it: fold angles follow the width."""
    widths = start.pattern.widths
    ratio = widths.max(axis=1) / widths.min(axis=1)
    if ratio.max() < EVEN:
        return []
    strip = int(np.argmax(ratio))
    return [f"strip {strip + 1} is {ratio[strip]:.2f} times as wide at one place as at another; principal structures have "
            "constant fold angles, so they need even widths: give another guide or shorter creases (surface.reach), or set "
            "solve.principal = false"]

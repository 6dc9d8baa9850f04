"""The paper's paragraph (§3): evolve a pattern, zigzag it, make it exact, lay it flat, and say how good it is."""

from collections.abc import Callable, Iterator
from pathlib import Path

import msgspec
import numpy as np

from plisse.assess import assess, overlap_notes, start_defects
from plisse.designs.arrangements import arranged_strips
from plisse.designs.asymptotic import along_asymptotic_curves
from plisse.designs.outcomes import broken_down, way_of
from plisse.designs.surfaces import reconstructed
from plisse.designs.varied import varied
from plisse.errors import Infeasible
from plisse.io.designs import checked_design
from plisse.layout.guiding import Guiding, guiding
from plisse.measure.shape import Shape
from plisse.recipe import AsymptoticDesign, Curve, Design, March, Recipe, SurfaceDesign
from plisse.result import Report, Result
from plisse.solve.attempt import Start
from plisse.solve.closed_form import closed_form
from plisse.solve.cutting import best_cut
from plisse.solve.energies import Guides
from plisse.solve.flatten import flatten, laid_out
from plisse.solve.forecast import forecast
from plisse.solve.marching import marched_design
from plisse.solve.paper import solve_paper
from plisse.solve.portfolio import CONSTRUCTED_ONLY, GENERAL, OPTIMISED_ONLY, PRINCIPAL, SECOND_CHANCE, Way, solve
from plisse.solve.workspace import Workspace
from plisse.solve.zigzag import zigzag
from plisse.stopwatch import Stopwatch
from plisse.structure.pleated import PleatedStructure
from plisse.threads import bounded

__all__ = ["design"]

Progress = Callable[[str, float], None]


@bounded()
def design(recipe: Recipe | dict | str | Path, *, progress: Progress | None = None,
           workspace: Workspace | None = None) -> Result:
    """The structure that a recipe asks for, with the pattern it follows and the report that proves it.

    `recipe` is a Design, nested dictionaries as in TOML, or the path of a design file. `progress(stage, fraction)` is
    called as work goes on; designs of one size that share a `workspace` are solved faster. Raises InvalidDesign for
    impossible recipes; geometry that breaks down on the way is reported (status "infeasible"), not raised.
    """
    recipe = checked_design(recipe)
    watch = Stopwatch(progress)
    if isinstance(recipe, AsymptoticDesign):
        return along_asymptotic_curves(recipe, watch, workspace or Workspace())
    if recipe.strips is not None:
        return arranged_strips(recipe, watch)
    if isinstance(recipe, SurfaceDesign):
        return reconstructed(recipe, watch)
    result = _pleated(recipe, watch, workspace)
    return result if recipe.parallel is None else varied(result, recipe.parallel)


def _pleated(recipe: Design, watch: Stopwatch, workspace: Workspace | None) -> Result:
    """The structure of a closed form, a march, or a curve and pattern."""
    if recipe.closed_form is not None:
        return _by_formula(recipe, watch)
    assert recipe.curve is not None  # a checked recipe without closed form has it
    if recipe.march is not None:
        return _by_march(recipe, recipe.curve, recipe.march, watch)
    assert recipe.pattern is not None
    watch.start("evolve", 0.0)
    try:
        guide = guiding(recipe.curve, recipe.pattern)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    watch.start("solve", 0.2)
    workspace, pattern = workspace or Workspace(), guide.pattern.resampled(guide.samples)
    zigzagged = zigzag(pattern, guide.amplitude, workspace.grid(*pattern.shape))
    if recipe.solve.method == "paper":
        return _by_the_paper(recipe, guide, zigzagged, watch)
    return _exactly(recipe, guide, zigzagged, watch, workspace)


def _by_formula(recipe: Design, watch: Stopwatch) -> Result:
    """A structure in closed form: nothing is solved, only laid flat and measured."""
    watch.start("construct", 0.0)
    return _constructed(recipe, closed_form(recipe.closed_form), "closed form", [], watch)


def _by_march(recipe: Design, curve: Curve, march: March, watch: Stopwatch) -> Result:
    """An explicit principal structure (§2.4): exact by construction, as far as its strips live."""
    watch.start("construct", 0.0)
    try:
        marched = marched_design(curve, march)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    return _constructed(recipe, marched.structure, "march", marched.notes, watch)


def _constructed(recipe: Design, structure: PleatedStructure, method: str, notes: list[str], watch: Stopwatch) -> Result:
    """The result of a structure that is exact without a solver, laid flat and measured."""
    watch.start("flatten", 0.5)
    structure = flatten(structure, best_cut(structure, recipe.solve.cut))
    watch.start("measure", 0.8)
    report = assess(structure, principal=True, units=recipe.units)
    report = msgspec.structs.replace(report, method=method, warnings=notes + overlap_notes(report), seconds=watch.stop(),
                                     design=recipe.to_dict())
    return Result(recipe, report, structure=structure)


def _exactly(recipe: Design, guide: Guiding, zigzagged: PleatedStructure, watch: Stopwatch,
             workspace: Workspace) -> Result:
    """The best of the portfolio, to machine precision where the geometry allows it."""
    ahead = forecast(guide.pattern, guide.amplitude, recipe.solve.principal)
    outcome = solve(_plans(recipe, guide, workspace))
    best = outcome.best
    if best.attempt.vertices is None:
        return broken_down(recipe, [best.attempt.message, *ahead.warnings()], watch, guide, zigzagged)
    watch.start("flatten", 0.6)
    structure = PleatedStructure(best.start.topology, best.attempt.vertices)
    structure = flatten(structure, best_cut(structure, recipe.solve.cut), workspace)
    report = _measured(recipe, best.start.guides(best.start.samples), guide.amplitude, structure, watch, best.shape,
                       best.astray)
    # predictions about rulings are of no interest once a comfortable structure refutes them
    foreseen = ahead.warnings_of_openings() if best.is_comfortable and not report.reasons else ahead.warnings()
    warnings = guide.notes + _notes(best.start, guide) + overlap_notes(report)
    report = msgspec.structs.replace(
        report, start=start_defects(zigzagged), **way_of(outcome),
        warnings=warnings + ([] if report.reasons else foreseen),
        reasons=report.reasons + (foreseen if report.reasons else []))
    return Result(recipe, report, best.start.pattern, zigzagged, structure)


def _by_the_paper(recipe: Design, guide: Guiding, zigzagged: PleatedStructure, watch: Stopwatch) -> Result:
    """Functional (5) as printed (§3.4); it ends near 1e-4, so its status is seldom exact."""
    topology, binormals = zigzagged.topology, guide.pattern.resampled(guide.samples).binormals.reshape(-1, 3)
    cut = best_cut(zigzagged, recipe.solve.cut)
    found = solve_paper(topology, zigzagged.vertices, Guides.along_creases(topology, zigzagged.vertices, binormals),
                        weights=recipe.solve.weights, iterations=recipe.solve.iterations, cut=cut,
                        principal=recipe.solve.principal)
    structure = PleatedStructure(topology, found.vertices, cut, laid_out(cut.topology, found.development))
    report = msgspec.structs.replace(
        _measured(recipe, zigzagged.vertices.reshape(-1, guide.samples, 3), guide.amplitude, structure, watch),
        start=start_defects(zigzagged), iterations=found.iterations, method="paper",
        history=[float(value) for value in found.history], warnings=guide.notes)
    return Result(recipe, report, guide.pattern, zigzagged, structure)


def _measured(recipe: Design, guides: np.ndarray, amplitude: float, structure: PleatedStructure,
              watch: Stopwatch, shape: Shape | None = None, astray: np.ndarray | None = None) -> Report:
    watch.start("measure", 0.8)
    report = assess(structure, principal=recipe.solve.principal, guides=guides, amplitude=amplitude, units=recipe.units,
                    shape=shape, astray=astray)
    return msgspec.structs.replace(report, seconds=watch.stop(), design=recipe.to_dict())


def _notes(start: Start, guide: Guiding) -> list[str]:
    if start.samples == guide.samples:
        return []
    return [f"pattern.samples was raised from {guide.samples} to {start.samples}, because this closed principal structure "
            "closes exactly only for odd numbers"]


def _plans(recipe: Design, guide: Guiding, workspace: Workspace) -> Iterator[tuple[Start, tuple[Way, ...]]]:
    """The pattern as designed, then patterns whose binormals are smoothed differently, then an odd number of samples.

    General designs that will not come out are tried as principal ones too: those are exact as well, and stiffer.
    """
    assert recipe.curve is not None
    assert recipe.pattern is not None
    amplitude, principal = guide.amplitude, recipe.solve.principal
    ways = PRINCIPAL if principal else GENERAL
    yield Start(guide.pattern, amplitude, guide.samples, principal, workspace=workspace), ways
    stiff = Start(guide.pattern, amplitude, guide.samples, True, "as a principal structure", workspace)
    if not principal:
        yield stiff, OPTIMISED_ONLY
    for factor in (2.0, 0.5, 4.0):
        try:
            other = guiding(recipe.curve, recipe.pattern, smoothing_factor=factor)
        except Infeasible:
            continue
        label = f"binormals smoothed {factor:g} times as far"
        yield Start(other.pattern, amplitude, guide.samples, principal, label, workspace), SECOND_CHANCE
    if not principal:
        yield stiff, CONSTRUCTED_ONLY
    if principal and recipe.is_closed and guide.samples % 2 == 0:
        yield Start(guide.pattern, amplitude, guide.samples + 1, principal, "one sample more, to close", workspace), ways

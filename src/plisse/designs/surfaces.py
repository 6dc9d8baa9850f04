"""From a surface section to a structure over it (§3.1, Figs 20, 23 and 25)."""

import msgspec
import numpy as np

from plisse.assess import assess, overlap_notes
from plisse.designs.guided import guided
from plisse.designs.outcomes import broken_down
from plisse.designs.reconstruction import (
    as_chosen,
    chosen_layout,
    deviation_of,
    edited_vertices,
    inclinations_of,
    laid_out_over,
    lies_over,
    made_principal,
    reference_surface,
    sampled,
    solved_again,
)
from plisse.errors import Infeasible
from plisse.geometry.graph import GraphSurface
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.parametric import ParametricSurface
from plisse.layout.automatic import Sizes, starting_rows
from plisse.layout.coverage import AreaSamples
from plisse.layout.positions import refuse_too_many
from plisse.layout.rows import ChartedSurface
from plisse.recipe import SurfaceDesign
from plisse.result import Overlay, Result
from plisse.solve.bad_start import fail_both_ways, surface_start
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.stopwatch import Stopwatch

__all__ = ["reconstructed"]


def reconstructed(recipe: SurfaceDesign, watch: Stopwatch) -> Result:
    """The structure over a surface: along a guide where one is given, otherwise over all of it."""
    watch.start("surface", 0.0)
    try:
        mesh, surface = reference_surface(recipe.surface)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    if recipe.surface.is_guided:
        return guided(recipe, mesh, surface, watch)
    watch.start("solve", 0.1)
    assert isinstance(surface, GraphSurface | ParametricSurface)
    try:
        if recipe.pattern.initial == "normal":
            return _from_a_bad_start(recipe, mesh, surface, watch)
        found = laid_out_over(recipe, mesh, surface)
        vertices = edited_vertices(recipe.surface, mesh)
        if vertices is not None:
            mesh, found = solved_again(found, mesh, vertices, bool(recipe.surface.overhang))
        elif recipe.pattern.samples is not None:
            found = sampled(found, mesh, surface, recipe.pattern.samples, bool(recipe.surface.overhang))
        if recipe.solve.principal:
            found = made_principal(found, mesh, surface, bool(recipe.surface.overhang))
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    watch.start("flatten", 0.9)
    structure = flatten(found.structure, best_cut(found.structure))
    watch.start("measure", 0.95)
    report = assess(structure, principal=recipe.solve.principal, units=recipe.units)
    amplitude = found.best.layout.sizes.amplitude
    chosen = chosen_layout(found, surface)
    report = msgspec.structs.replace(
        report, seconds=watch.stop(), design=as_chosen(recipe, found, chosen).to_dict(), layout=chosen,
        method="fitted inclination", coverage=found.coverage,
        deviation=deviation_of(found.deviation, mesh.diagonal, amplitude), inclination_deg=inclinations_of(found),
        seams=len(found.best.seams), holes=max(found.best.holes, 0),
        warnings=[*found.notes, *overlap_notes(report)])
    return Result(recipe, report, structure=structure, overlay=Overlay(mesh, found.deviation.distances, amplitude))


def _from_a_bad_start(recipe: SurfaceDesign, mesh: ReferenceMesh, surface: ChartedSurface, watch: Stopwatch) -> Result:
    """Fig. 25: evenly spaced curves moved along normals, and what the paper's functional makes of them."""
    pattern = recipe.pattern
    assert pattern.width is not None
    assert pattern.amplitude is not None
    refuse_too_many(mesh.area / pattern.width**2, "give a larger pattern.width")
    place = surface.to_plane(np.array([recipe.surface.centre]))[0, :2]
    rows = starting_rows(mesh, surface, place, pattern.width)
    samples = AreaSamples.of(mesh.vertices, mesh.triangles)
    bad = fail_both_ways(surface_start(surface, samples, rows, Sizes(pattern.width, pattern.amplitude)))
    watch.start("flatten", 0.8)
    structure = bad.start.structure.with_vertices(bad.held.vertices)
    structure = flatten(structure, best_cut(structure))
    watch.start("measure", 0.9)
    coverage, deviation = lies_over(structure, mesh, surface, pattern.amplitude)
    report = assess(structure, units=recipe.units)
    tried = [f"{name}: planarity {bad.defects(found)[0]:.1e}, angles {bad.defects(found)[1]:.1e}, "
             f"{bad.departure(found):.1f} amplitudes away"
             for name, found in (("exactness enforced", bad.straightened), ("closeness enforced", bad.held))]
    report = msgspec.structs.replace(
        report, seconds=watch.stop(), design=recipe.to_dict(), method="paper", coverage=coverage, tried=tried,
        deviation=deviation_of(deviation, mesh.diagonal, pattern.amplitude), reasons=[bad.diagnosis, *report.reasons])
    return Result(recipe, report, zigzagged=bad.start.structure, structure=structure)

"""From a surface section to a structure over it (§3.1, Figs 2, 12, 20, 23 and 25)."""

import msgspec
import numpy as np

from plisse.assess import assess, overlap_notes
from plisse.errors import Infeasible
from plisse.geometry.graph import GraphSurface
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.surface import Surface
from plisse.layout.automatic import Sizes, starting_rows
from plisse.layout.coverage import AreaSamples
from plisse.outcomes import broken_down, way_of
from plisse.recipe import SurfaceDesign
from plisse.reconstruction import (
    deviation_of,
    edited_vertices,
    guided_start,
    inclinations_of,
    laid_out_over,
    lies_over,
    reference_surface,
    solved_again,
)
from plisse.result import Overlay, Result
from plisse.solve.bad_start import fail_both_ways, surface_start
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.solve.portfolio import SECOND_CHANCE, solve
from plisse.solve.zigzag import zigzag
from plisse.stopwatch import Stopwatch
from plisse.structure.pleated import PleatedStructure

__all__ = ["reconstructed"]


def reconstructed(recipe: SurfaceDesign, watch: Stopwatch) -> Result:
    """The structure over a surface: along a guide where one is given, otherwise over all of it."""
    watch.start("surface", 0.0)
    mesh, surface = reference_surface(recipe.surface)
    watch.start("solve", 0.1)
    if recipe.surface.guide is not None or recipe.surface.fan is not None:
        return _along_a_guide(recipe, mesh, surface, watch)
    if not isinstance(surface, GraphSurface):
        return broken_down(recipe, ["the surface is no graph over its mean plane, so rows cannot be laid over the whole of "
                                    "it; give surface.guide or surface.fan"], watch)
    try:
        if recipe.pattern.initial == "normal":
            return _from_a_bad_start(recipe, mesh, surface, watch)
        found = laid_out_over(recipe, mesh, surface)
        vertices = edited_vertices(recipe.surface, mesh)
        if vertices is not None:
            mesh, found = solved_again(found, mesh, vertices, recipe.surface.overhang)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    watch.start("flatten", 0.9)
    structure = flatten(found.structure, best_cut(found.structure))
    watch.start("measure", 0.95)
    report, amplitude = assess(structure, units=recipe.units), found.best.layout.sizes.amplitude
    report = msgspec.structs.replace(
        report, seconds=watch.stop(), design=recipe.to_dict(), method="fitted inclination", coverage=found.coverage,
        deviation=deviation_of(found.deviation, mesh.diagonal, amplitude), inclination_deg=inclinations_of(found),
        warnings=[*found.notes, *overlap_notes(report)])
    return Result(recipe, report, structure=structure, overlay=Overlay(mesh, found.deviation.distances, amplitude))


def _along_a_guide(recipe: SurfaceDesign, mesh: ReferenceMesh, surface: Surface, watch: Stopwatch) -> Result:
    """Creases of constant inclination, shot from a guide or around a point (Figs 2, 12, 20)."""
    try:
        start = guided_start(recipe.surface, recipe.pattern, mesh, surface)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    best = (outcome := solve([(start, SECOND_CHANCE)])).best
    if best.attempt.vertices is None:
        return broken_down(recipe, [best.attempt.message], watch)
    watch.start("flatten", 0.8)
    structure = PleatedStructure(start.topology, best.attempt.vertices)
    structure = flatten(structure, best_cut(structure))
    watch.start("measure", 0.9)
    report = assess(structure, guides=start.guides(start.samples), amplitude=start.amplitude, units=recipe.units)
    coverage, deviation = lies_over(structure, mesh, surface, start.amplitude)
    report = msgspec.structs.replace(
        report, seconds=watch.stop(), design=recipe.to_dict(), coverage=coverage,
        deviation=deviation_of(deviation, mesh.diagonal, start.amplitude), warnings=overlap_notes(report),
        **way_of(outcome))
    return Result(recipe, report, start.pattern, zigzag(start.pattern, start.amplitude), structure,
                  Overlay(mesh, deviation.distances, start.amplitude))


def _from_a_bad_start(recipe: SurfaceDesign, mesh: ReferenceMesh, surface: GraphSurface, watch: Stopwatch) -> Result:
    """Fig. 25: evenly spaced curves moved along normals, and what the paper's functional makes of them."""
    pattern = recipe.pattern
    assert pattern.width is not None
    assert pattern.amplitude is not None
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

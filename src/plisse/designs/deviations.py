"""How far a structure is from what its recipe asked for, measured again from the recipe alone (Figs 17 and 20)."""

import numpy as np

from plisse.designs.asymptotic_surface import charted_surface
from plisse.designs.reconstruction import edited_vertices, reference_surface
from plisse.draw.colour_maps import ColourMap, deviation_from_guides, deviation_from_surface
from plisse.errors import PlisseError
from plisse.geometry.mesh import ReferenceMesh
from plisse.io.designs import design_from_dict
from plisse.layout.guiding import guiding
from plisse.measure.mid_surface import mid_surface_deviation
from plisse.recipe import AsymptoticDesign, Design, SurfaceDesign
from plisse.result import Report
from plisse.structure.pleated import PleatedStructure

__all__ = ["deviation_again"]

AGREES = 0.02  # relative to the largest deviation in the report


def deviation_again(structure: PleatedStructure, report: Report) -> ColourMap | None:
    """The deviation from the surface or pattern of a report's recipe, or None where the recipe cannot tell it any more.

    Recipes whose files have gone, or that led elsewhere than their pattern said, give none.
    """
    try:
        recipe = design_from_dict(report.design)
    except PlisseError:
        return None
    found = None
    if isinstance(recipe, AsymptoticDesign):
        found = _from_chart(structure, recipe, report)
    elif isinstance(recipe, SurfaceDesign):
        found = _from_surface(structure, recipe, report)
    elif isinstance(recipe, Design):
        found = _from_pattern(structure, recipe)
    told = report.deviation.max_amplitudes if report.deviation else report.crease_deviation and report.crease_deviation.max
    return found if found is not None and told and abs(found.largest - told) <= AGREES * told else None


def _from_chart(structure: PleatedStructure, recipe: AsymptoticDesign, report: Report) -> ColourMap | None:
    found = report.deviation
    if found is None or not found.max_amplitudes:
        return None
    try:
        _, _, surface = charted_surface(recipe.surface)
    except PlisseError:
        return None
    topology = structure.topology
    distances = mid_surface_deviation(surface, structure.vertices, topology.quads).distances
    return deviation_from_surface(topology, np.append(distances, np.full(len(topology.hubs), np.nan)),
                                  found.max / found.max_amplitudes)


def _from_surface(structure: PleatedStructure, recipe: SurfaceDesign, report: Report) -> ColourMap | None:
    found = report.deviation
    if found is None or not found.max_amplitudes or structure.topology.hubs:
        return None
    try:
        mesh, surface = reference_surface(recipe.surface)
        edited = edited_vertices(recipe.surface, mesh)
        if edited is not None:
            mesh = ReferenceMesh(edited, mesh.triangles)
    except PlisseError:
        return None
    distances = mid_surface_deviation(surface, structure.vertices, structure.topology.quads).distances
    return deviation_from_surface(structure.topology, distances, found.max / found.max_amplitudes)


def _from_pattern(structure: PleatedStructure, recipe: Design) -> ColourMap | None:
    if recipe.curve is None or recipe.pattern is None or recipe.parallel is not None or recipe.strips is not None:
        return None
    try:
        guide = guiding(recipe.curve, recipe.pattern)
    except PlisseError:
        return None
    return deviation_from_guides(structure, guide.pattern, guide.amplitude)

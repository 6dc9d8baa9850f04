"""From a strips section of a design to strips along its guiding curves (Fig. 6)."""

import msgspec
import numpy as np

from plisse.assess_strips import assess_strips
from plisse.designs.families import guide_of
from plisse.designs.outcomes import broken_down
from plisse.designs.reconstruction import reference_surface
from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
from plisse.layout.guiding import guiding
from plisse.recipe import Design, Strips, SurfaceDesign
from plisse.result import Result
from plisse.solve.closed_form import closed_form
from plisse.solve.marching import marched_design
from plisse.stopwatch import Stopwatch
from plisse.structure.pleated import PleatedStructure
from plisse.transform.arrangement import Arrangement, arranged, strips_along_creases, strips_along_rows, surface_of
from plisse.transform.strip_lanes import lanes_on_surface
from plisse.transform.strip_solids import strip_solid

__all__ = ["arranged_strips"]


def arranged_strips(recipe: Design | SurfaceDesign, watch: Stopwatch) -> Result:
    """Rectifying strips instead of pleats: over a surface, along the curves of an evolution, or on a closed form."""
    assert recipe.strips is not None
    mesh = None
    watch.start("strips", 0.1)
    try:
        if isinstance(recipe, SurfaceDesign):
            found, mesh = _over_surface(recipe, recipe.strips)
        else:
            found, mesh = _along_curves(recipe, recipe.strips)
        if recipe.strips.thickness is not None:
            for strip in found.strips:
                strip_solid(strip, recipe.strips.thickness)
    except Infeasible as error:
        return broken_down(recipe, [str(error)], watch)
    watch.start("measure", 0.8)
    report = msgspec.structs.replace(assess_strips(found, recipe.units), seconds=watch.stop(), design=recipe.to_dict())
    return Result(recipe, report, structure=found.structure, arrangement=found, surface=mesh)


def _over_surface(recipe: SurfaceDesign, strips: Strips) -> tuple[Arrangement, ReferenceMesh]:
    mesh, surface = reference_surface(recipe.surface)
    guide = guide_of(recipe.surface, mesh, surface)
    assert strips.theta is not None
    assert strips.spacing is not None
    lanes = lanes_on_surface(surface, guide, theta=float(np.radians(strips.theta)), spacing=strips.spacing,
                             side=1.0 if strips.lean == "left" else -1.0, samples=strips.samples,
                             reach=recipe.surface.reach)
    return arranged(lanes, strips.width, strips.side), mesh


def _along_curves(recipe: Design, strips: Strips) -> tuple[Arrangement, ReferenceMesh | None]:
    """Strips, and the structure whose creases they follow where there is one."""
    if recipe.closed_form is not None:
        return _along_creases(closed_form(recipe.closed_form), strips)
    assert recipe.curve is not None
    if recipe.march is not None:
        return _along_creases(marched_design(recipe.curve, recipe.march).structure, strips)
    assert recipe.pattern is not None
    pattern = guiding(recipe.curve, recipe.pattern).pattern
    pattern = pattern.resampled(strips.samples + (recipe.is_closed and strips.samples % 2 == 0))
    rows = strips_along_rows(pattern.curves, pattern.binormals, strips.width, side=strips.side, closed=recipe.is_closed)
    return rows, None


def _along_creases(structure: PleatedStructure, strips: Strips) -> tuple[Arrangement, ReferenceMesh]:
    return strips_along_creases(structure, strips.width, side=strips.side), surface_of(structure)

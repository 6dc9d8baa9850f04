"""Automatic layouts over a surface as pictures to choose from."""

from dataclasses import dataclass

from plisse.designs.reconstruction import laid_out_over, reference_surface
from plisse.draw.candidates import candidate_png
from plisse.errors import InvalidDesign
from plisse.geometry.graph import GraphSurface
from plisse.geometry.parametric import ParametricSurface
from plisse.recipe import SurfaceDesign
from plisse.solve.candidate import Candidate, centre_of
from plisse.studio.bench import Progress

__all__ = ["Choice", "candidates_of"]


@dataclass(frozen=True, eq=False)
class Choice:
    """A layout to choose: what is said about it, its picture as a PNG, and the changes that make it the design."""

    words: str
    picture: bytes
    changes: dict


def candidates_of(recipe: SurfaceDesign, count: int, progress: Progress) -> list[Choice]:
    """At most `count` layouts over the surface, the best first by `Candidate.rank`, each as good as it was made.

    Raises InvalidDesign for surfaces whose creases start from a guide or a point.
    """
    mesh, surface = reference_surface(recipe.surface)
    if recipe.surface.is_guided or not isinstance(surface, GraphSurface | ParametricSurface):
        raise InvalidDesign("creases start from a guide or a point, so layouts are not searched for; take it away first")
    found = laid_out_over(recipe, mesh, surface, count, progress)
    ranked = sorted(found.candidates, key=lambda candidate: candidate.rank, reverse=True)
    best = {id(candidate.layout): candidate for candidate in reversed([found.best, *ranked])}
    return [Choice(f"Layout {number}: {_said(candidate)}", candidate_png(candidate, mesh, surface),
                   _changes(candidate, surface))
            for number, candidate in enumerate(sorted(best.values(), key=[found.best, *ranked].index)[:count], 1)]


def _said(candidate: Candidate) -> str:
    """What counts most in the order of layouts: coverage, nearness, seams and holes."""
    counted = ((len(candidate.seams), "seam"), (candidate.holes, "hole"))
    more = "".join(f", {number} {name}{'s' * (number > 1)}" for number, name in counted if number)
    return f"{100 * candidate.coverage:.1f} % covered, {candidate.mean_deviation:.2f} amplitudes away{more}"


def _changes(candidate: Candidate, surface: GraphSurface | ParametricSurface) -> dict:
    sizes, centre = candidate.layout.sizes, centre_of(candidate, surface)
    changes: dict = {"pattern.width": float(sizes.width), "pattern.amplitude": float(sizes.amplitude)}
    return changes if centre is None else {**changes, "surface.centre": centre.tolist()}

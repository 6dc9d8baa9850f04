"""Automatic layouts over a surface as pictures to choose from."""

import tempfile
from pathlib import Path

from plisse.designs.reconstruction import laid_out_over, reference_surface
from plisse.draw.candidates import write_candidates
from plisse.errors import InvalidDesign
from plisse.geometry.graph import GraphSurface
from plisse.geometry.parametric import ParametricSurface
from plisse.recipe import SurfaceDesign
from plisse.solve.candidate import Candidate, centre_of
from plisse.studio.bench import Progress

__all__ = ["candidates_of"]


def candidates_of(recipe: SurfaceDesign, count: int, progress: Progress) -> tuple[bytes, list[tuple[str, dict]]]:
    """A PNG of all layouts that were tried, and for each its words and the changes that make it the design.

    Raises InvalidDesign for surfaces whose creases start from a guide or a point.
    """
    mesh, surface = reference_surface(recipe.surface)
    if recipe.surface.is_guided or not isinstance(surface, GraphSurface | ParametricSurface):
        raise InvalidDesign("creases start from a guide or a point, so layouts are not searched for; take it away first")
    found = laid_out_over(recipe, mesh, surface, count, progress)
    with tempfile.TemporaryDirectory(prefix="plisse-studio-") as directory:
        picture = Path(directory) / "candidates.png"
        write_candidates(found.candidates, found.candidates.index(found.best), mesh, surface, picture)
        content = picture.read_bytes()
    return content, [_choice(number, candidate, surface) for number, candidate in enumerate(found.candidates, 1)]


def _choice(number: int, candidate: Candidate, surface: GraphSurface | ParametricSurface) -> tuple[str, dict]:
    sizes, centre = candidate.layout.sizes, centre_of(candidate, surface)
    words = f"{number}: {100 * candidate.coverage:.1f} % covered"
    changes: dict = {"pattern.width": float(sizes.width), "pattern.amplitude": float(sizes.amplitude)}
    return words, changes if centre is None else {**changes, "surface.centre": centre.tolist()}

"""From a surface section to guides and families of creases of constant inclination (§3.1)."""

import numpy as np
from scipy.spatial import cKDTree

from plisse.errors import InvalidDesign
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.surface import Surface as Reference
from plisse.layout.family import Family, fan, shoot
from plisse.layout.guides import Guide, boundary_guide, guide_through, section_guide
from plisse.layout.positions import fan_radius, refuse_too_many
from plisse.recipe import Surface, SurfacePattern

__all__ = ["family_of", "guide_of"]

SIDEWAYS = 0.99  # cosine of the angle between normal and x axis from which angles are counted from the y axis
FAR = 0.5  # distance from the surface, in its diagonals, from which points are surely not meant to lie on it
SAMPLES = 60  # vertices per crease unless asked for
STEPS = 100_000  # along a crease


def guide_of(section: Surface, mesh: ReferenceMesh, surface: Reference) -> Guide:
    """The guide of a surface section; raises InvalidDesign or Infeasible where it does not lie on the surface."""
    if section.guide_boundary is not None:
        return boundary_guide(surface, mesh, section.guide_boundary - 1)
    if section.guide_section is not None:
        return section_guide(surface, mesh, section.guide_section.point, section.guide_section.normal)
    points = np.asarray(section.guide, dtype=float)
    _refuse_astray(points, mesh, "guide")
    guide = guide_through(surface, points, section.guide_closed)
    if not surface.project(guide.points).known.any():
        distance = float(cKDTree(mesh.vertices).query(guide.points)[0].min())
        raise InvalidDesign(f"the guide is not on the surface: it passes {distance:.3g} beside it; give points that lie on "
                            "the surface")
    return guide


def family_of(section: Surface, recipe: SurfacePattern, mesh: ReferenceMesh, surface: Reference) -> Family:
    """The creases that leave the guide, or the point, of a surface section; a checked recipe has all they need.

    Raises Infeasible where there is no room for them, or where they end at once.
    """
    assert recipe.theta is not None
    assert recipe.width is not None
    assert recipe.amplitude is not None
    theta, above, outline = np.radians(recipe.theta), section.side == "above", section.crop == "outline"
    beyond = section.beyond or (outline and not section.boundary)
    length = mesh.diagonal if section.reach is None and beyond else section.reach
    if section.point is not None:
        assert recipe.creases is not None
        _refuse_astray(np.array([section.point]), mesh, "point")
        turn = section.directions
        sector = (np.radians(turn[0]), np.radians(turn[1])) if isinstance(turn, list) else None
        radius = fan_radius(recipe.creases, theta=theta, width=recipe.width, amplitude=recipe.amplitude, sector=sector)
        if (length or 2 * mesh.diagonal) > STEPS * radius / 40:
            raise InvalidDesign(f"creases around the point would start {radius:.2g} from it, too near for a surface that is "
                                f"{mesh.diagonal:.3g} across; give more creases, a larger pattern.width or a smaller "
                                "surface.reach")
        return fan(surface, section.point, theta=theta, creases=recipe.creases, radius=radius, sector=sector,
                   towards=_first_direction(surface, section.point), length=length, beyond=beyond, above=above)
    angle = section.directions if isinstance(section.directions, float) else 90.0
    guide = guide_of(section, mesh, surface)
    creases = guide.length / recipe.width if recipe.creases is None else recipe.creases
    refuse_too_many(creases * (recipe.samples or SAMPLES), "give a larger pattern.width, or fewer pattern.creases or "
                    "pattern.samples")
    return shoot(surface, guide, theta=theta, width=recipe.width, amplitude=recipe.amplitude,
                 creases=recipe.creases, angle=np.radians(angle), tuned=section.directions in (None, "tuned"), length=length,
                 beyond=beyond, above=above)


def _refuse_astray(points: np.ndarray, mesh: ReferenceMesh, name: str) -> None:
    """Raise InvalidDesign where one of the points (N, 3) lies far from the surface."""
    distance = cKDTree(mesh.vertices).query(points)[0]
    k = int(np.argmax(distance))
    if not distance[k] <= FAR * mesh.diagonal:
        place = ", ".join(f"{value:.4g}" for value in points[k])
        raise InvalidDesign(f"surface.{name} is not on the surface: ({place}) lies {distance[k]:.4g} away from it, and the "
                            f"surface is {mesh.diagonal:.4g} across; give points that lie on it")


def _first_direction(surface: Reference, point: list[float]) -> np.ndarray:
    """The x axis, or the y axis where the surface is orthogonal to the x axis."""
    normal = surface.project(np.array([point])).normals[0]
    return np.eye(3)[1 if abs(normal[0]) > SIDEWAYS else 0]

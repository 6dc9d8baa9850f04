"""Offsets: the same faces at constant distance, over parallel edges (§2.4, Fig. 9)."""

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.vectors import dot
from plisse.measure.planarity import face_normals
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure
from plisse.transform.cone_axes import cone_axes
from plisse.transform.principal import require_principal

__all__ = ["offset", "offset_axes", "offset_range"]

TOUCHING = 1e-9
PARALLEL = 1e-9


def offset(structure: PleatedStructure, distance: float) -> PleatedStructure:
    """The principal structure whose faces lie at `distance` (model units) from those of `structure`, with development.

    Positive distances lie on the side that the faces are oriented to, from which the development runs
    counterclockwise. Vertices move along the axes of their cones, edges stay parallel and keep their sense. Raises
    InvalidStructure for structures that are not principal, InvalidDesign where the distance is beyond `offset_range`.
    """
    if not np.isfinite(distance):
        raise InvalidDesign(f"the distance is {distance}; give a finite number in model units")
    axes = offset_axes(structure)
    low, high = _range(structure, axes)
    if not low < distance < high:
        raise InvalidDesign(_too_far(structure, axes, distance, low if distance < 0 else high))
    moved = structure.with_vertices(structure.vertices + distance * axes)
    return flatten(moved, best_cut(structure) if structure.development is None else structure.cut)


def offset_range(structure: PleatedStructure) -> tuple[float, float]:
    """Distances (negative, positive) in model units between which every edge of an offset keeps its sense; may be ±inf.

    Raises InvalidStructure for structures that are not principal.
    """
    return _range(structure, offset_axes(structure))


def offset_axes(structure: PleatedStructure) -> np.ndarray:
    """Displacements (V, 3) per unit of distance; raises InvalidStructure where the structure is not principal.

    Raises Infeasible where faces touch no cone, as those of a flat-folded state.
    """
    require_principal(structure, "it has no offset at constant distance")
    topology, corners = structure.topology, structure.topology.corners
    axes = cone_axes(topology, structure.vertices)
    miss = np.abs(dot(face_normals(topology, structure.vertices)[corners.face], axes[corners.vertex]) - 1)
    worst = int(np.argmax(miss))
    if not miss[worst] <= TOUCHING:
        vertex = int(corners.vertex[worst])
        raise Infeasible(f"the faces around vertex {vertex} ({place_of(topology, vertex)}) touch no common cone (they miss "
                         f"it by {miss[worst]:.1e}), so there is no offset; give a state that is not folded flat")
    return axes


def _range(structure: PleatedStructure, axes: np.ndarray) -> tuple[float, float]:
    growth = _growth(structure, axes)
    shrinks, grows = growth.min(), growth.max()
    return float(-1 / grows if grows > 0 else -np.inf), float(-1 / shrinks if shrinks < 0 else np.inf)


def _growth(structure: PleatedStructure, axes: np.ndarray) -> np.ndarray:
    """Relative growth (E,) of every edge per unit of distance: λ_ij − 1 of §2.3, 0 where nothing but round-off is left."""
    start, end = structure.topology.edges.vertices.T
    along = structure.vertices[end] - structure.vertices[start]
    growth = dot(axes[end] - axes[start], along) / dot(along, along)
    return np.where(np.abs(growth) * structure.diagonal < PARALLEL, 0.0, growth)


def _too_far(structure: PleatedStructure, axes: np.ndarray, distance: float, limit: float) -> str:
    growth = _growth(structure, axes)
    edge = int(np.argmin(growth) if distance > 0 else np.argmax(growth))
    place = place_of(structure.topology, int(structure.topology.edges.vertices[edge, 0]))
    return (f"the offset at distance {distance:g} does not exist: an edge at {place} would shrink to nothing; "
            f"the largest possible distance on that side is {_towards_zero(limit)}")


def _towards_zero(limit: float) -> str:
    """Five digits of a limit, rounded so that the number itself still works."""
    digits = 10.0 ** (np.floor(np.log10(abs(limit))) - 4)
    return f"{np.trunc(limit / digits) * digits:.10g}"

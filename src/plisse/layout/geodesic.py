"""The geodesic between two points of a surface, a guide that families of creases can cross."""

from typing import Protocol

import numpy as np
from scipy.linalg import solve_banded
from scipy.sparse import coo_array
from scipy.sparse.csgraph import dijkstra
from scipy.spatial import cKDTree

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.polyline import sample_evenly
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import dot, norm, unit

__all__ = ["geodesic", "mesh_path"]

NODES = 240
STEPS = 60


class _WithMesh(Protocol):
    mesh: ReferenceMesh


def geodesic(surface: Surface, a, b, count: int, nodes: int = NODES) -> np.ndarray:
    """Points (count, 3) at equal distances along a geodesic from a to b, both taken onto the surface.

    It starts from the chord, or from the shortest path along the edges where the surface is fitted to a mesh, and
    relaxes: the tangential parts of all second differences vanish. Fourth order in the number of `nodes`. It is locally
    shortest, no more, and may cross gaps of the mesh where the surface is continued over them.
    Raises Infeasible where no geodesic is found.
    """
    ends = np.array([a, b], dtype=float)
    if ends.shape != (2, 3) or not np.isfinite(ends).all():
        raise InvalidDesign("a geodesic runs between two points [x, y, z]")
    ends = surface.project(ends).positions
    if not norm(ends[1] - ends[0]) > 1e-6 * surface.diagonal:
        raise InvalidDesign("the two end points of the geodesic are the same point of the surface")
    start = _first_guess(surface, ends, max(nodes, count))
    return sample_evenly(_relaxed(surface, start), count)


def mesh_path(mesh: ReferenceMesh, a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Shortest path (K, 3) along edges between the vertices nearest to a and b, a and b in their place."""
    start, end = cKDTree(mesh.vertices).query([a, b])[1]
    one, two = mesh.edges.T
    count = len(mesh.vertices)
    graph = coo_array((mesh.edge_lengths, (one, two)), shape=(count, count)).tocsr()
    came = dijkstra(graph, directed=False, indices=end, return_predecessors=True)[1]
    path = [start]
    while path[-1] != end:
        path.append(came[path[-1]])
    return np.concatenate([[a], mesh.vertices[path[1:-1]], [b]])


def _first_guess(surface: Surface | _WithMesh, ends: np.ndarray, nodes: int) -> np.ndarray:
    mesh = getattr(surface, "mesh", None)
    path = mesh_path(mesh, *ends) if isinstance(mesh, ReferenceMesh) else ends
    along = np.concatenate([[0.0], np.cumsum(norm(np.diff(path, axis=0)))])
    at = np.linspace(0, along[-1], nodes)
    return np.stack([np.interp(at, along, column) for column in path.T], axis=1)


def _relaxed(surface: Surface, points: np.ndarray) -> np.ndarray:
    """Nodes (N, 3) on the surface whose second differences are normal to it, by damped Newton steps."""
    at = surface.project(points)
    spacing = norm(np.diff(at.positions, axis=0)).mean()
    for _ in range(STEPS):
        if not np.isfinite(at.positions).all():
            break
        step = _newton_step(at, 4 if norm(_bend(at.positions, 2)).max() < 0.5 * spacing else 2)
        size = float(norm(step).max())
        longest = 0.1 * surface.diagonal
        inner = at.positions[1:-1] + step * min(1.0, longest / max(size, 1e-300))
        at = surface.project(np.concatenate([points[:1], inner, points[-1:]]))
        if size < 1e-10 * surface.diagonal:
            return np.concatenate([points[:1], at.positions[1:-1], points[-1:]])
    reason = "" if at.known.all() else ": the shortest way leaves the surface"
    raise Infeasible(f"no geodesic was found between the two points of the guide{reason}; choose points that are "
                     "closer, or give the guide as a file")


def _bend(points: np.ndarray, order: int) -> np.ndarray:
    """Second differences (N − 2, 3), of fourth order away from the ends if wanted."""
    second = points[2:] - 2 * points[1:-1] + points[:-2]
    if order == 4 and len(points) > 6:
        correction = np.zeros_like(second)
        correction[1:-1] = second[2:] - 2 * second[1:-1] + second[:-2]
        correction[0], correction[-1] = correction[1], correction[-2]
        second = second - correction / 12
    return second


def _newton_step(at, order: int) -> np.ndarray:
    """Tangential moves (N − 2, 3) of the inner nodes that make second differences normal.

    With P the tangential projection, d(P D²x) = P D²δ + (n · D²x) B δ. Bands of a 2 × 2 block tridiagonal matrix.
    """
    bend, normals, bending = _bend(at.positions, order), at.normals[1:-1], at.bending[1:-1]
    axis = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    one = unit(np.cross(normals, axis))
    frames = np.stack([one, np.cross(normals, one)], axis=1)
    count = len(bend)
    diagonal = -2 * np.eye(2) + dot(bend, normals)[:, None, None] * (frames @ bending @ frames.swapaxes(1, 2))
    upper = frames[:-1] @ frames[1:].swapaxes(1, 2)
    bands = np.zeros((7, 2 * count))
    for i in range(2):
        for j in range(2):
            bands[3 + i - j, j::2] = diagonal[:, i, j]
            bands[3 + i - j - 2, 2 + j::2] = upper[:, i, j]
            bands[3 + i - j + 2, j:2 * count - 2:2] = upper[:, j, i]
    right = -np.einsum("nki,ni->nk", frames, bend).ravel()
    move = solve_banded((3, 3), bands, right).reshape(count, 2)
    return np.einsum("nk,nki->ni", move, frames)

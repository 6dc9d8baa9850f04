"""Axes of the cones that touch the faces around every vertex, scaled to offsets at unit distance (§2.4, Fig. 9)."""

import numpy as np
from scipy.sparse import block_array, csr_array, eye_array
from scipy.sparse.linalg import splu

from plisse.geometry.vectors import dot, unit
from plisse.measure.planarity import face_normals
from plisse.structure.topology import Topology

__all__ = ["cone_axes"]

COPLANAR = 1e-7
SOFT = 1e-12
RELIEF = 1e-9


def cone_axes(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Displacements (V, 3) that move the plane of every face by 1 along its normal and keep all edges parallel.

    An inner vertex of a principal structure moves along the axis of its cone. On the boundary fewer faces meet: there
    the vertices slide in their faces so that boundary edges stay parallel too, and of all such positions (one freedom
    for each side of the sheet) those are taken that change the lengths of edges least. Where the faces around a
    boundary vertex leave no freedom, boundary edges beside it may turn in the planes of their faces.
    """
    normals = face_normals(topology, vertices)
    axes, free_vertex, free_direction = _smallest(topology, normals)
    if len(free_vertex) == 0:
        return axes
    sliding = _sliding(topology, vertices, normals, axes, free_vertex, free_direction)
    np.add.at(axes, free_vertex, sliding[:, None] * free_direction)
    return axes


def _smallest(topology: Topology, normals: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Shortest displacements (V, 3) with n·w = 1 for all faces, and vertices (M,) and unit directions (M, 3) left free."""
    corners = topology.corners
    count = np.bincount(corners.vertex, minlength=topology.vertex_count)
    by_vertex, first = np.argsort(corners.vertex, kind="stable"), np.cumsum(count) - count
    axes, vertices, directions = np.zeros((topology.vertex_count, 3)), [], []
    for valence in np.unique(count[count > 0]):
        at = np.flatnonzero(count == valence)
        around = normals[corners.face[by_vertex[first[at][:, None] + np.arange(valence)]]]
        left, size, right = np.linalg.svd(around)
        size = np.concatenate([size, np.zeros((len(at), 3 - size.shape[1]))], axis=1)
        held = size > COPLANAR
        share = np.divide(left.sum(axis=1)[:, :3], size[:, :left.shape[2]], where=held[:, :left.shape[2]],
                          out=np.zeros((len(at), min(3, left.shape[2]))))
        axes[at] = np.einsum("vk,vki->vi", share, right[:, :share.shape[1]])
        row, column = np.nonzero(~held)
        vertices.append(at[row])
        directions.append(right[row, column])
    return axes, np.concatenate(vertices), np.concatenate(directions)


def _sliding(topology: Topology, vertices: np.ndarray, normals: np.ndarray, axes: np.ndarray, free_vertex: np.ndarray,
             free_direction: np.ndarray) -> np.ndarray:
    """How far (M,) vertices go along their free directions: edges do not turn, and change their lengths least."""
    edges = topology.edges
    loose = np.zeros(topology.vertex_count, bool)
    loose[free_vertex] = True
    touched = loose[edges.vertices].any(axis=1)
    start, end = edges.vertices[touched].T
    along = vertices[end] - vertices[start]
    across = unit(np.cross(normals[edges.faces[touched, 0]], along))
    coordinate = 3 * np.repeat(free_vertex, 3) + np.tile([0, 1, 2], len(free_vertex))
    freedoms = csr_array((free_direction.ravel(), (coordinate, np.repeat(np.arange(len(free_vertex)), 3))),
                         shape=(axes.size, len(free_vertex)))
    stretch = _differences(along / dot(along, along)[:, None], start, end, axes.size)
    turn = _differences(across, start, end, axes.size)
    return _constrained(stretch @ freedoms, stretch @ axes.ravel(), turn @ freedoms, turn @ axes.ravel())


def _differences(direction: np.ndarray, start: np.ndarray, end: np.ndarray, size: int) -> csr_array:
    """Rows that take the component along directions (E, 3) of what differs between both ends of an edge."""
    row = np.tile(np.repeat(np.arange(len(start)), 3), 2)
    column = (3 * np.concatenate([start, end])[:, None] + [0, 1, 2]).ravel()
    return csr_array((np.concatenate([-direction, direction]).ravel(), (row, column)), shape=(len(start), size))


def _constrained(wish, wish_offset: np.ndarray, condition, condition_offset: np.ndarray) -> np.ndarray:
    """The y that minimises |wish y + offset|² among those with condition y + offset = 0, also for redundant conditions."""
    quadratic = wish.T @ wish + SOFT * eye_array(wish.shape[1])
    exact = block_array([[quadratic, condition.T], [condition, None]], format="csr")
    relief = block_array([[0 * quadratic, None], [None, RELIEF * eye_array(condition.shape[0])]])
    factors = splu((exact - relief).tocsc())
    right = np.concatenate([-(wish.T @ wish_offset), -condition_offset])
    solution, rest, before = np.zeros_like(right), right, np.inf
    # redundant conditions need the relief, and these steps take its effect back; they stall where conditions contradict
    while np.abs(rest).max() < 0.7 * before:
        before = np.abs(rest).max()
        solution = solution + factors.solve(rest)
        rest = right - exact @ solution
    return solution[:wish.shape[1]]

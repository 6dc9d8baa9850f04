"""Edges as seen from the corners of faces, trees of edges, and the loops that faces do not fill."""

from collections.abc import Callable

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from plisse.structure.lines import edge_keys
from plisse.structure.topology import Topology

__all__ = ["corner_means", "edge_lookup", "edges_of_corners", "loop_edges", "tree_edges"]


def edge_lookup(topology: Topology) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    """A function that takes both ends of edges, in any order, to their numbers."""
    count = topology.vertex_count
    key = edge_keys(topology.edges.vertices, count)
    order = np.argsort(key)

    def edge(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return order[np.searchsorted(key[order], edge_keys(np.stack([a, b], axis=-1), count))]

    return edge


def corner_means(topology: Topology, values: np.ndarray) -> np.ndarray:
    """Means (V, k) over the corners of every vertex for values (C, k); 0 at vertices without faces."""
    vertex, count = topology.corners.vertex, topology.vertex_count
    total = np.stack([np.bincount(vertex, column, count) for column in values.T], axis=1)
    return total / np.maximum(np.bincount(vertex, minlength=count), 1)[:, None]


def edges_of_corners(topology: Topology) -> tuple[np.ndarray, np.ndarray]:
    """For every corner (C,) the edge from its vertex to the next one, and ±1 where the edge runs that way or against it."""
    corners = topology.corners
    edge = edge_lookup(topology)(corners.vertex, corners.next)
    return edge, np.where(topology.edges.vertices[edge, 0] == corners.vertex, 1, -1)


def tree_edges(topology: Topology, root: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (N,) in breadth-first order from `root`, and per vertex (V,) the edge that leads to it, −1 for none."""
    ends = topology.edges.vertices
    leading = np.full(topology.vertex_count, -1)
    link = coo_array((np.arange(1.0, len(ends) + 1), ends.T), shape=(topology.vertex_count,) * 2).tocsr()
    link = (link + link.T).tocsr()
    sequence, parent = breadth_first_order(link, root, directed=False)
    leading[sequence[1:]] = np.asarray(link[parent[sequence[1:]], sequence[1:]]).ravel().astype(np.int64) - 1
    return sequence, leading


def loop_edges(topology: Topology, leading: np.ndarray) -> np.ndarray:
    """Edges whose loops through the tree cannot be filled by faces: none on a disk, one on a ring.

    `leading` are the edges of a spanning tree as from `tree_edges`.
    """
    edges = topology.edges
    free = np.ones(len(edges.vertices), bool)
    free[leading[leading >= 0]] = False
    outside = topology.face_count
    faces = np.where(edges.faces < 0, outside, edges.faces)
    numbers = np.flatnonzero(free)
    # parallel links between two faces: only one of them is crossed by the tree of faces
    pairs, first = np.unique(np.sort(faces[numbers], axis=1), axis=0, return_index=True)
    link = coo_array((numbers[first] + 1.0, pairs.T), shape=(outside + 1,) * 2).tocsr()
    link = (link + link.T).tocsr()
    root = outside if edges.is_boundary.any() else 0
    sequence, parent = breadth_first_order(link, root, directed=False)
    crossed = np.asarray(link[parent[sequence[1:]], sequence[1:]]).ravel().astype(np.int64) - 1
    free[crossed] = False
    return np.flatnonzero(free)

"""Faces in the order in which one is reached from the next: a breadth-first tree that starts in the middle.

Chains of positions lose digits; trees from the middle are short.
"""

from typing import NamedTuple

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from plisse.structure.topology import Topology

__all__ = ["FaceTree", "Level", "face_tree"]


class Level(NamedTuple):
    """Faces (N,) that are equally far from the root, their parents, and the corners of both at the common edge.

    The edge begins in the corner `at_child` as the child has it, in the corner `at_parent` as the parent has it.
    """

    child: np.ndarray
    parent: np.ndarray
    at_child: np.ndarray
    at_parent: np.ndarray


class FaceTree(NamedTuple):
    """The root face and the levels of all faces that hang together with face 0 over edges."""

    root: int
    levels: list[Level]


def face_tree(topology: Topology) -> FaceTree:
    """Breadth-first tree from a middle face, one level per step."""
    corners = topology.corners
    low, high = np.minimum(corners.vertex, corners.next), np.maximum(corners.vertex, corners.next)
    order = np.argsort(low * np.int64(topology.vertex_count) + high, kind="stable")
    twin = np.flatnonzero((np.diff(low[order]) == 0) & (np.diff(high[order]) == 0))
    a, b = order[twin], order[twin + 1]
    start, end = np.concatenate([a, b]), np.concatenate([b, a])
    # corner + 1, because a stored zero is no entry
    link = coo_array((start + 1.0, (corners.face[start], corners.face[end])), shape=(topology.face_count,) * 2).tocsr()
    root = _middle(link)
    sequence, parent = breadth_first_order(link, root, directed=False)
    depth = np.zeros(topology.face_count, np.int64)
    for face, above in zip(sequence[1:].tolist(), parent[sequence[1:]].tolist(), strict=True):
        depth[face] = depth[above] + 1
    children = sequence[1:]
    if len(children) == 0:
        return FaceTree(root, [])
    at_parent = np.asarray(link[parent[children], children]).ravel().astype(np.int64) - 1
    at_child = np.asarray(link[children, parent[children]]).ravel().astype(np.int64) - 1
    cuts = np.flatnonzero(np.diff(depth[children])) + 1
    split = [np.split(column, cuts) for column in (children, parent[children], at_child, at_parent)]
    return FaceTree(root, [Level(*columns) for columns in zip(*split, strict=True)])


def _middle(link) -> int:
    """A face half way along a longest path: far from a far face's far face."""
    end = breadth_first_order(link, 0, directed=False)[0][-1]
    sequence, parent = breadth_first_order(link, end, directed=False)
    path = [int(sequence[-1])]
    while path[-1] != end:
        path.append(int(parent[path[-1]]))
    return path[len(path) // 2]

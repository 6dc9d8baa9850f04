"""Faces in the order in which one is reached from the next: a breadth-first tree that starts in the middle.

Chains of positions lose digits; trees from the middle are short.
"""

from itertools import pairwise
from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import breadth_first_order

from plisse.structure.topology import Topology

__all__ = ["FaceTree", "Level", "face_tree"]


class Level(NamedTuple):
    """Faces (N,), all equally far from the root in a level, their parents, and the corners of both at the common edge.

    The edge begins in the corner `at_child` as the child has it, in the corner `at_parent` as the parent has it.
    """

    child: np.ndarray
    parent: np.ndarray
    at_child: np.ndarray
    at_parent: np.ndarray


class FaceTree(NamedTuple):
    """The root face and all faces that hang together with face 0 over edges: `every` other one, and level by level.

    `face_count` is the number of all faces.
    """

    root: int
    every: Level
    levels: list[Level]
    face_count: int

    def summed(self, steps: np.ndarray) -> np.ndarray:
        """Sums (F,) along the tree of steps from parents to children, one for `every` child."""
        total, start = np.zeros(self.face_count, steps.dtype), 0
        for child, parent, _, _ in self.levels:
            total[child] = total[parent] + steps[start:start + len(child)]
            start += len(child)
        return total


def face_tree(topology: Topology) -> FaceTree:
    """Breadth-first tree from a middle face, one level per step."""
    edges, count = topology.edges, np.int64(topology.face_count)
    inner = ~edges.is_boundary
    faces, corners = edges.faces[inner], edges.corners[inner]
    faces, corners = (np.concatenate([pairs, pairs[:, ::-1]]) for pairs in (faces, corners))
    key = faces[:, 0] * count + faces[:, 1]
    order = np.argsort(key)
    key, starts = key[order], np.concatenate([[0], np.cumsum(np.bincount(faces[:, 0], minlength=count))])
    link = csr_array((np.ones(len(key), np.int8), faces[order, 1], starts), shape=(count, count))
    root = _middle(link)
    sequence, parent = breadth_first_order(link, root)
    children = sequence[1:].astype(np.int64)
    parents = parent[children]
    at_child, at_parent = corners[order[np.searchsorted(key, children * count + parents)]].T
    rank = np.zeros(count, np.int64)
    rank[sequence] = np.arange(len(sequence))
    above, cuts = rank[parents], [0]
    while cuts[-1] < len(children):  # children of one level follow each other, as their parents do
        cuts.append(int(np.searchsorted(above, cuts[-1] + 1)))
    every = Level(children, parents, at_child, at_parent)
    levels = [Level(*(column[start:end] for column in every)) for start, end in pairwise(cuts)]
    return FaceTree(root, every, levels, topology.face_count)


def _middle(link) -> int:
    """A face half way along a longest path: far from a far face's far face."""
    end = breadth_first_order(link, 0)[0][-1]
    sequence, parent = breadth_first_order(link, end)
    path = [int(sequence[-1])]
    while path[-1] != end:
        path.append(int(parent[path[-1]]))
    return path[len(path) // 2]

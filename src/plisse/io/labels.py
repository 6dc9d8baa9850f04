"""Telling creases from rulings in meshes that do not say: one family of opposite edges against the other.

In a quad, opposite edges are of one kind and neighbouring edges of different kinds; across an edge the kind
is the same. So a connected mesh has two labellings only, and any evidence about a few edges decides between
them.
"""

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from plisse.errors import InvalidStructure
from plisse.measure.folds import fold_angles
from plisse.structure.incidence import edge_lookup
from plisse.structure.topology import Topology

__all__ = ["Corners", "folding_evidence", "labelled_topology", "oriented"]


class Corners:
    """Columns over all corners of polygons: `face`, `start` and `end` of the edge, `odd` position or not."""

    def __init__(self, faces: list[list[int]]):
        size = np.array([len(face) for face in faces])
        self.face = np.repeat(np.arange(len(faces)), size)
        self.start = np.concatenate([np.asarray(face, np.int64) for face in faces])
        first = np.cumsum(size) - size
        position = np.arange(size.sum()) - first[self.face]
        self.end = self.start[first[self.face] + (position + 1) % size[self.face]]
        self.odd = position % 2

    def pairs(self) -> tuple[np.ndarray, np.ndarray]:
        """The two corners (N,) and (N,) at inner edges; raises InvalidStructure where more than two meet."""
        low, high = np.minimum(self.start, self.end), np.maximum(self.start, self.end)
        key = low * (high.max() + 1) + high
        order = np.argsort(key, kind="stable")
        twins = np.flatnonzero(np.diff(key[order]) == 0)
        if (np.diff(twins) == 1).any():
            corner = order[twins[np.argmax(np.diff(twins) == 1)]]
            raise InvalidStructure(f"more than two faces meet in the edge from vertex {self.start[corner] + 1} "
                                   f"to {self.end[corner] + 1}; split the mesh there")
        return order[twins], order[twins + 1]


def oriented(faces: list[list[int]]) -> list[list[int]]:
    """The same faces, those turned round that disagree with the first face of their piece.

    Raises InvalidStructure for one-sided surfaces.
    """
    corners = Corners(faces)
    first, second = corners.pairs()
    against = corners.start[first] == corners.start[second]
    if not against.any():
        return faces
    flip, _ = _two_colouring(len(faces), corners.face[first], corners.face[second], against,
                             "the mesh is one-sided near face {}, so no side of it can be called the front")
    return [face[::-1] if turn else face for face, turn in zip(faces, flip, strict=True)]


def labelled_topology(vertex_count: int, faces: list[list[int]], evidence) -> Topology:
    """Quads first edge on a crease, and hubs likewise, from polygons with an even number of edges.

    `evidence(start, end)` gives for edges between vertices (C,), (C,) a number each: large on creases, small
    on rulings. In each connected piece the family with the larger mean becomes the creases; equal means keep
    each first face as it is. Raises InvalidStructure where faces are odd or no labelling exists.
    """
    _require_even(faces)
    faces = oriented(faces)
    corners = Corners(faces)
    first, second = corners.pairs()
    shifted, piece = _two_colouring(
        len(faces), corners.face[first], corners.face[second], corners.odd[first] != corners.odd[second],
        "the edges of face {} cannot be told into creases and rulings, because an odd number of faces "
        "surrounds a vertex nearby; give a mesh whose edges are two families of polylines")
    family = corners.odd ^ shifted[corners.face]
    mean = _mean_by_family(evidence(corners.start, corners.end), piece[corners.face], family)
    shifted = shifted ^ (mean[1] > mean[0])[piece]
    turned = [face[1:] + face[:1] if shift else face for face, shift in zip(faces, shifted, strict=True)]
    quads = [face for face in turned if len(face) == 4]
    topology = Topology(vertex_count, np.array(quads, np.int64).reshape(-1, 4),
                        tuple(np.array(face) for face in turned if len(face) > 4))
    _ = topology.edges
    return topology


def folding_evidence(vertices: np.ndarray, faces: list[list[int]]):
    """Evidence from the shape: how far (radians) the surface of vertices (V, 3) folds at an edge.

    Pleats fold further than the smooth strips between them bend at their rulings.
    """
    topology = labelled_topology(len(vertices), faces, lambda start, end: np.zeros(len(start)))
    edge, angle = edge_lookup(topology), np.abs(fold_angles(topology, vertices))
    return lambda start, end: angle[edge(start, end)]


def _mean_by_family(values: np.ndarray, piece: np.ndarray, family: np.ndarray) -> np.ndarray:
    bins = family * (piece.max() + 1) + piece
    size = 2 * (piece.max() + 1)
    total = np.bincount(bins, values, size) / np.maximum(np.bincount(bins, minlength=size), 1)
    return np.round(total, 12).reshape(2, -1)


def _two_colouring(count: int, first: np.ndarray, second: np.ndarray, differ: np.ndarray,
                   complaint: str) -> tuple[np.ndarray, np.ndarray]:
    """One bit per node, different across the links that `differ` and equal across the others, and its piece.

    The first node of each piece gets 0. Works on the double cover: two copies of every node, crossed over
    where the bits differ; where a node is joined to its own copy no bits exist and InvalidStructure carries
    the complaint.
    """
    differ = differ.astype(np.int64)
    starts = np.concatenate([2 * first, 2 * first + 1])
    ends = np.concatenate([2 * second + differ, 2 * second + 1 - differ])
    sheet = _components(starts, ends, 2 * count)
    torn = sheet[::2] == sheet[1::2]
    if torn.any():
        raise InvalidStructure(complaint.format(int(np.argmax(torn)) + 1))
    piece = _components(first, second, count)
    _, root = np.unique(piece, return_index=True)
    return (sheet[::2] != sheet[2 * root[piece]]).astype(np.int64), piece


def _components(starts: np.ndarray, ends: np.ndarray, count: int) -> np.ndarray:
    graph = coo_array((np.ones(len(starts), np.int8), (starts, ends)), shape=(count, count))
    return connected_components(graph, directed=False)[1]


def _require_even(faces: list[list[int]]) -> None:
    if not faces:
        raise InvalidStructure("the file has no faces; give a mesh of quads")
    for k, face in enumerate(faces):
        if len(face) % 2 or len(face) < 4:
            raise InvalidStructure(f"face {k + 1} has {len(face)} edges, but pleated structures consist of quads "
                                   "between creases; give a quad mesh")
        if len(set(face)) < len(face):
            raise InvalidStructure(f"face {k + 1} uses a vertex twice; give proper quads")

"""Which faces meet where: labelled quads and hub polygons, without any geometry (§2.3).

A row `[a b c d]` of `quads` has its edges ab and dc on creases and bc and da on rulings. Hubs are polygons with an
even number of vertices whose edges are crease, ruling, crease, … in turn. Nothing here assumes a grid.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from plisse.errors import InvalidStructure
from plisse.structure.lines import Polyline, edge_keys, joined

__all__ = ["Corners", "Edges", "Polyline", "Topology"]


@dataclass(frozen=True, eq=False)
class Topology:
    """Labelled faces over `vertex_count` vertices, consistently oriented.

    `ordering` is an optional key per vertex whose neighbours have nearby values: solvers sort by it to get a
    narrow band. `seams` are edges (S, 2) along which the sheet is in parts that meet in space only: angles around
    their vertices sum to anything. Raises InvalidStructure for indices out of range or edges with more than two faces.
    """

    vertex_count: int
    quads: np.ndarray
    hubs: tuple[np.ndarray, ...] = ()
    ordering: np.ndarray | None = field(default=None, repr=False)
    seams: np.ndarray = field(default_factory=lambda: np.empty((0, 2), np.int64), repr=False)

    def __post_init__(self):
        quads = np.ascontiguousarray(np.asarray(self.quads, dtype=np.int64).reshape(-1, 4))
        hubs = tuple(np.asarray(hub, dtype=np.int64) for hub in self.hubs)
        object.__setattr__(self, "quads", quads)
        object.__setattr__(self, "hubs", hubs)
        seams = np.asarray(self.seams, dtype=np.int64).reshape(-1, 2)
        object.__setattr__(self, "seams", np.unique(np.sort(seams, axis=1), axis=0))
        used = np.concatenate([quads.ravel(), *hubs])
        if used.size == 0:
            raise InvalidStructure("a structure needs at least one face, and this one has none")
        if used.min() < 0 or used.max() >= self.vertex_count:
            raise InvalidStructure(
                f"face indices run from {used.min()} to {used.max()}, but there are {self.vertex_count} vertices"
            )

    @property
    def face_count(self) -> int:
        """Number of quads and hubs together."""
        return len(self.quads) + len(self.hubs)

    @cached_property
    def faces(self) -> list[list[int]]:
        """All faces as lists of vertices, quads first: what file formats want."""
        return self.quads.tolist() + [hub.tolist() for hub in self.hubs]

    @cached_property
    def corners(self) -> "Corners":
        """One entry per vertex of each face, face by face in the order of `faces`."""
        quads = self.quads
        parts = [(np.repeat(np.arange(len(quads)), 4), quads.ravel(), np.roll(quads, -1, 1).ravel(),
                  np.roll(quads, 1, 1).ravel(), np.tile([True, False], 2 * len(quads)))]
        for k, hub in enumerate(self.hubs):
            parts.append((np.full(len(hub), len(quads) + k), hub, np.roll(hub, -1), np.roll(hub, 1),
                          np.arange(len(hub)) % 2 == 0))
        return Corners(*(np.concatenate(column) for column in zip(*parts, strict=True)))

    @cached_property
    def edges(self) -> "Edges":
        """Every edge once, with its two faces (-1 outside) and whether it lies on a crease."""
        return _edges(self)

    @cached_property
    def tetrahedra(self) -> np.ndarray:
        """Vertex quadruples (T, 4) whose volumes vanish when all faces are planar; one per quad, k−3 per hub."""
        fans = [np.stack([np.full(len(hub) - 3, hub[0]), np.full(len(hub) - 3, hub[1]),
                          np.full(len(hub) - 3, hub[2]), hub[3:]], axis=1) for hub in self.hubs]
        return np.concatenate([self.quads, *fans])

    @cached_property
    def rods(self) -> np.ndarray:
        """Vertex pairs (P, 2) of all edges and all diagonals of faces: an isometry keeps their lengths."""
        quads = self.quads
        pairs = [self.edges.vertices, quads[:, [0, 2]], quads[:, [1, 3]]]
        for hub in self.hubs:
            first, second = np.triu_indices(len(hub), 2)
            inner = (second - first) != len(hub) - 1
            pairs.append(np.stack([hub[first[inner]], hub[second[inner]]], axis=1))
        return np.concatenate(pairs)

    @cached_property
    def is_boundary(self) -> np.ndarray:
        """Mask (V,) of vertices on the boundary (or in no face at all)."""
        mask = np.ones(self.vertex_count, bool)
        mask[self.corners.vertex] = False
        mask[self.edges.vertices[self.edges.is_boundary]] = True
        return mask

    @cached_property
    def is_inner(self) -> np.ndarray:
        """Mask (V,) of vertices around which the sheet is whole: neither on the boundary nor on a seam."""
        mask = ~self.is_boundary
        mask[self.seams] = False
        return mask

    @cached_property
    def stars(self) -> dict[int, np.ndarray]:
        """Inner vertices by valence k: rows (N, 1+k) of centre and ring, the ring starting on a crease edge."""
        return _stars(self)

    @cached_property
    def star_corners(self) -> dict[int, np.ndarray]:
        """Corner indices (N, k) that lie between successive ring vertices of `stars`."""
        return {k: _ring_corners(self, k)[1] for k in self.stars}

    @cached_property
    def creases(self) -> tuple[Polyline, ...]:
        """Crease polylines, ordered along the crease."""
        return joined(self.edges.vertices[self.edges.is_crease])

    @cached_property
    def rulings(self) -> tuple[Polyline, ...]:
        """Zigzag polylines of consecutive rulings across the creases."""
        return joined(self.edges.vertices[~self.edges.is_crease])

    @cached_property
    def piece_of_faces(self) -> np.ndarray:
        """Number (F,) of the piece that every face belongs to; pieces hang together over edges."""
        return self.joined_over(~self.edges.is_boundary)

    @cached_property
    def strip_of_faces(self) -> np.ndarray:
        """Number (F,) of the strip that every face belongs to; strips hang together over rulings."""
        return self.joined_over(~self.edges.is_crease)

    def joined_over(self, chosen: np.ndarray) -> np.ndarray:
        """Number (F,) of the group that every face belongs to; groups hang together over the chosen inner edges (E,)."""
        pairs = self.edges.faces[chosen & ~self.edges.is_boundary]
        links = coo_array((np.ones(len(pairs)), pairs.T), shape=(self.face_count,) * 2)
        return connected_components(links, directed=False)[1].astype(np.int64)

    @property
    def components(self) -> int:
        """Number of pieces connected over edges."""
        return int(self.piece_of_faces.max()) + 1

    @cached_property
    def euler_characteristic(self) -> int:
        """V − E + F over the vertices in use: 1 for a disk, 0 for an annulus."""
        used = np.zeros(self.vertex_count, bool)
        used[self.corners.vertex] = True
        return int(np.count_nonzero(used)) - len(self.edges.vertices) + self.face_count


@dataclass(frozen=True, eq=False)
class Corners:
    """Columns over all corners: face, vertex, next and previous vertex in the face, next edge on a crease or not."""

    face: np.ndarray
    vertex: np.ndarray
    next: np.ndarray
    previous: np.ndarray
    next_is_crease: np.ndarray


@dataclass(frozen=True, eq=False)
class Edges:
    """Columns over all edges: vertices (E, 2), faces (E, 2) and corners (E, 2) with −1 outside, `is_crease` (E,).

    `vertices` run along the edge as the first face has it; in both faces the edge leads from a corner to the next.
    """

    vertices: np.ndarray
    faces: np.ndarray
    corners: np.ndarray
    is_crease: np.ndarray

    @property
    def is_boundary(self) -> np.ndarray:
        """Mask of edges with one face only."""
        return self.faces[:, 1] < 0


def _sorted(key: np.ndarray, limit: int) -> tuple[np.ndarray, np.ndarray]:
    """Keys (N,) from 0 up to a limit in order, and the places where they were, those of equal ones in order too."""
    count = len(key)
    if limit * count < 2**63:  # keys that hold their places are sorted several times as fast as one can ask for the order
        return np.divmod(np.sort(key * count + np.arange(count)), count)
    order = np.argsort(key, kind="stable")
    return key[order], order


def _edges(topology: Topology) -> Edges:
    corners = topology.corners
    ends = np.stack([corners.vertex, corners.next], axis=1)
    key, order = _sorted(edge_keys(ends, topology.vertex_count), topology.vertex_count**2)
    starts = np.flatnonzero(np.r_[True, key[1:] != key[:-1]])
    counts = np.diff(np.r_[starts, len(order)])
    if counts.max() > 2:
        a, b = ends[order[starts[np.argmax(counts)]]]
        raise InvalidStructure(f"{counts.max()} faces meet in the edge between vertices {a} and {b}, "
                               "but at most two can; split the mesh there")
    first = order[starts]
    pairs = counts == 2
    second = order[starts[pairs] + 1]
    places = np.full((len(starts), 2), -1)
    places[:, 0], places[pairs, 1] = first, second
    faces = np.where(places < 0, -1, corners.face[places])
    flipped = ends[second, 0] == ends[first[pairs], 0]
    if flipped.any():
        a, b = ends[second[np.argmax(flipped)]]
        raise InvalidStructure(f"the two faces at the edge between vertices {a} and {b} are oriented differently; "
                               "orient the faces consistently")
    if (corners.next_is_crease[second] != corners.next_is_crease[first[pairs]]).any():
        bad = np.argmax(corners.next_is_crease[second] != corners.next_is_crease[first[pairs]])
        raise InvalidStructure(f"the edge between vertices {ends[second[bad], 0]} and {ends[second[bad], 1]} "
                               "is a crease in one face and a ruling in the other")
    # restore the order of first appearance: files and bands stay in the order of the faces
    appearance = np.argsort(first, kind="stable")
    first = first[appearance]
    return Edges(ends[first], faces[appearance], places[appearance], corners.next_is_crease[first])


def _stars(topology: Topology) -> dict[int, np.ndarray]:
    valence = np.bincount(topology.corners.vertex, minlength=topology.vertex_count)
    return {int(k): _ring_corners(topology, int(k))[0] for k in np.unique(valence[topology.is_inner])}


def _ring_corners(topology: Topology, valence: int) -> tuple[np.ndarray, np.ndarray]:
    """Stars (N, 1+k) and their corners (N, k): walk around all vertices of one valence at the same time."""
    corners = topology.corners
    count = np.bincount(corners.vertex, minlength=topology.vertex_count)
    centres = np.flatnonzero(topology.is_inner & (count == valence))
    by_vertex = np.argsort(corners.vertex, kind="stable")
    offset = np.concatenate([[0], np.cumsum(count)])
    around = by_vertex[offset[centres][:, None] + np.arange(valence)]
    current = around[np.arange(len(centres)), np.argmax(corners.next_is_crease[around], axis=1)]
    ring = []
    for _ in range(valence):
        ring.append(current)
        match = corners.next[around] == corners.previous[current][:, None]
        if not match.any(axis=1).all():
            bad = centres[np.argmin(match.any(axis=1))]
            raise InvalidStructure(f"the faces around vertex {bad} do not form a ring; separate them there")
        current = around[np.arange(len(centres)), np.argmax(match, axis=1)]
    walk = np.stack(ring, axis=1)
    return np.concatenate([centres[:, None], corners.next[walk]], axis=1), walk


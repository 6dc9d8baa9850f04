"""Polylines through the vertices of a mesh, joined from loose edges."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["Polyline", "edge_keys", "joined"]


@dataclass(frozen=True, eq=False)
class Polyline:
    """Vertex indices along a chain of edges; closed chains do not repeat the first."""

    vertices: np.ndarray
    closed: bool = False

    @property
    def path(self) -> np.ndarray:
        """The vertices, with the first one again at the end of closed chains."""
        return np.append(self.vertices, self.vertices[0]) if self.closed else self.vertices


def edge_keys(ends: np.ndarray, vertex_count: int) -> np.ndarray:
    """A number (…) for every edge (…, 2), the same in both directions."""
    return np.minimum(ends[..., 0], ends[..., 1]) * np.int64(vertex_count) + np.maximum(ends[..., 0], ends[..., 1])


def joined(ends: np.ndarray) -> tuple[Polyline, ...]:
    """Polylines made of edges (E, 2), in the order of their first vertex, each ordered along itself."""
    if len(ends) == 0:
        return ()
    there = np.zeros(int(ends.max()) + 1, bool)
    there[ends] = True
    used = np.flatnonzero(there)
    local = (np.cumsum(there) - 1)[ends]
    graph = coo_array((np.ones(len(local)), local.T), shape=(len(used),) * 2)
    _, label = connected_components(graph, directed=False)
    arcs = np.stack([local, local[:, ::-1]], axis=1).reshape(-1, 2)
    towards = arcs[np.argsort(arcs[:, 0], kind="stable"), 1]
    degree = np.bincount(local.ravel())
    first = np.cumsum(degree) - degree
    loose = np.flatnonzero(degree == 1)
    start = np.unique(label, return_index=True)[1]
    closed = np.ones(len(start), bool)
    with_end, end = np.unique(label[loose], return_index=True)
    lowest = start.copy()
    start[with_end], closed[with_end] = loose[end], False
    one, other = towards[first].tolist(), np.where(degree > 1, towards[np.minimum(first + 1, len(towards) - 1)], -1).tolist()
    return tuple(Polyline(used[_walk(one, other, int(start[group]))], bool(closed[group])) for group in np.argsort(lowest))


def _walk(one: list[int], other: list[int], start: int) -> list[int]:
    """Vertices from `start` on, each followed by the one of its first two neighbours that it does not come from."""
    path, previous, current = [start], -1, start
    while True:
        ahead = one[current] if one[current] != previous else other[current]
        if ahead < 0 or ahead == start:
            return path
        path.append(ahead)
        previous, current = current, ahead

"""Polylines through the vertices of a mesh, joined from loose edges."""

from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["Polyline", "joined"]


@dataclass(frozen=True, eq=False)
class Polyline:
    """Vertex indices along a chain of edges; closed chains do not repeat the first."""

    vertices: np.ndarray
    closed: bool = False

    @property
    def path(self) -> np.ndarray:
        """The vertices, with the first one again at the end of closed chains."""
        return np.append(self.vertices, self.vertices[0]) if self.closed else self.vertices


def joined(ends: np.ndarray) -> tuple[Polyline, ...]:
    """Polylines made of edges (E, 2), in the order of their first vertex, each ordered along itself."""
    if len(ends) == 0:
        return ()
    used, local = np.unique(ends, return_inverse=True)
    local = local.reshape(-1, 2)
    graph = coo_array((np.ones(len(local)), local.T), shape=(len(used),) * 2)
    _, label = connected_components(graph, directed=False)
    neighbours: list[list[int]] = [[] for _ in used]
    for a, b in local.tolist():
        neighbours[a].append(b)
        neighbours[b].append(a)
    out = []
    for group in _groups(label):
        loose = [v for v in group if len(neighbours[v]) == 1]
        path = _walk(neighbours, loose[0] if loose else group[0])
        out.append(Polyline(used[path], closed=not loose))
    return tuple(out)


def _groups(label: np.ndarray) -> list[list[int]]:
    order = np.argsort(label, kind="stable")
    cuts = np.flatnonzero(np.diff(label[order])) + 1
    groups = [part.tolist() for part in np.split(order, cuts)]
    return sorted(groups, key=lambda group: group[0])


def _walk(neighbours: list[list[int]], start: int) -> list[int]:
    path, previous, current = [start], -1, start
    while True:
        ahead = [v for v in neighbours[current] if v != previous]
        if not ahead or ahead[0] == start:
            return path
        previous, current = current, ahead[0]
        path.append(current)

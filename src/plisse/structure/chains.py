"""Polylines of a topology: edges of one kind joined end to end where they go straight on."""

from collections.abc import Iterable

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from plisse.structure.topology import Polyline, Topology

__all__ = ["boundary_loops", "chains", "successive_triples"]


def chains(topology: Topology, *, crease: bool) -> tuple[Polyline, ...]:
    """Crease (or ruling) polylines in the order of their first vertex, each ordered along itself."""
    edges = topology.edges
    return _join(edges.vertices[edges.is_crease == crease])


def boundary_loops(topology: Topology) -> tuple[np.ndarray, ...]:
    """Closed loops of boundary vertices, in the direction in which the faces run along them."""
    edges = topology.edges
    ends = edges.vertices[edges.is_boundary]
    return tuple(_walk_directed(ends))


def successive_triples(lines: Iterable[Polyline]) -> np.ndarray:
    """Successive vertices (T, 3) along polylines."""
    parts = [np.empty((0, 3), np.int64)]
    for line in lines:
        vertices = np.append(line.vertices, line.vertices[:2]) if line.closed else line.vertices
        parts.append(np.stack([vertices[:-2], vertices[1:-1], vertices[2:]], axis=1))
    return np.concatenate(parts)


def _join(ends: np.ndarray) -> tuple[Polyline, ...]:
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


def _walk_directed(ends: np.ndarray) -> list[np.ndarray]:
    """Loops of directed edges; where several loops touch in a vertex they are separated there."""
    ahead: dict[int, list[int]] = {}
    for a, b in ends.tolist():
        ahead.setdefault(a, []).append(b)
    loops = []
    while ahead:
        start = next(iter(ahead))
        loop, current = [], start
        while True:
            loop.append(current)
            choices = ahead[current]
            following = choices.pop()
            if not choices:
                del ahead[current]
            current = following
            if current == start:
                break
        loops.append(np.array(loop))
    return loops

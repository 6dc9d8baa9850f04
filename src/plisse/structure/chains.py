"""Successions of vertices on a topology: boundary loops, and triples along polylines."""

import numpy as np

from plisse.structure.topology import Topology

__all__ = ["boundary_loops", "directed_loops", "successive_triples"]


def boundary_loops(topology: Topology) -> tuple[np.ndarray, ...]:
    """Closed loops of boundary vertices, in the direction in which the faces run along them."""
    edges = topology.edges
    ends = edges.vertices[edges.is_boundary]
    return tuple(directed_loops(ends))


def successive_triples(ends: np.ndarray) -> np.ndarray:
    """Successive vertices (T, 3) along polylines made of edges (E, 2): every vertex between its two neighbours."""
    source, towards = np.concatenate([ends, ends[:, ::-1]]).T
    towards = towards[np.argsort(source, kind="stable")]
    degree = np.bincount(source)
    middle = np.flatnonzero(degree == 2)
    first = (np.cumsum(degree) - degree)[middle]
    return np.stack([towards[first], middle, towards[first + 1]], axis=1)


def directed_loops(ends: np.ndarray) -> list[np.ndarray]:
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

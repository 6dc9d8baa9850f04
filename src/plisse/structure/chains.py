"""Successions of vertices on a topology: boundary loops, and triples along polylines."""

from collections.abc import Iterable

import numpy as np

from plisse.structure.topology import Polyline, Topology

__all__ = ["boundary_loops", "directed_loops", "successive_triples"]


def boundary_loops(topology: Topology) -> tuple[np.ndarray, ...]:
    """Closed loops of boundary vertices, in the direction in which the faces run along them."""
    edges = topology.edges
    ends = edges.vertices[edges.is_boundary]
    return tuple(directed_loops(ends))


def successive_triples(lines: Iterable[Polyline]) -> np.ndarray:
    """Successive vertices (T, 3) along polylines."""
    parts = [np.empty((0, 3), np.int64)]
    for line in lines:
        vertices = np.append(line.vertices, line.vertices[:2]) if line.closed else line.vertices
        parts.append(np.stack([vertices[:-2], vertices[1:-1], vertices[2:]], axis=1))
    return np.concatenate(parts)


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

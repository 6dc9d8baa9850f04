"""The lines of a structure with one letter each: what is drawn in one stroke."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from plisse.measure.folds import assignments
from plisse.structure.chains import boundary_loops
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline

__all__ = ["Run", "lettered_runs"]


class Run(NamedTuple):
    """Vertices (N,) along a line of one letter: M, V or F on creases, R on rulings, B on the boundary."""

    letter: str
    vertices: np.ndarray
    closed: bool


def lettered_runs(structure: PleatedStructure) -> list[Run]:
    """Boundary loops, then creases, then rulings, split where mountain turns into valley."""
    topology = structure.topology
    edges = topology.edges
    letters = assignments(topology, structure.vertices)
    letters = np.where(edges.is_crease | edges.is_boundary, letters, "R")
    known = _Letters(edges.vertices, letters, topology.vertex_count)
    runs = [Run("B", loop, True) for loop in boundary_loops(topology)]
    for chain in (*topology.creases, *topology.rulings):
        runs += [run for run in _split(chain, known) if run.letter != "B"]
    return runs


class _Letters:
    """Letters of edges, looked up along paths of vertices."""

    def __init__(self, ends: np.ndarray, letters: np.ndarray, vertex_count: int):
        key = ends.min(axis=1) * vertex_count + ends.max(axis=1)
        order = np.argsort(key)
        self._key, self._letters, self._count = key[order], letters[order], vertex_count

    def along(self, path: np.ndarray) -> np.ndarray:
        """One letter per edge of a path (N,): (N−1,)."""
        a, b = path[:-1], path[1:]
        return self._letters[np.searchsorted(self._key, np.minimum(a, b) * self._count + np.maximum(a, b))]


def _split(chain: Polyline, letters: _Letters) -> list[Run]:
    path = np.append(chain.vertices, chain.vertices[0]) if chain.closed else chain.vertices
    names = letters.along(path)
    changes = np.flatnonzero(names[1:] != names[:-1]) + 1
    if chain.closed and len(changes) == 0:
        return [Run(str(names[0]), chain.vertices, True)]
    cuts = [0, *changes.tolist(), len(names)]
    return [Run(str(names[a]), path[a:b + 1], False) for a, b in pairwise(cuts)]

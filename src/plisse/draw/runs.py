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
    ends = np.sort(edges.vertices, axis=1).tolist()
    known = {(a, b): letter for (a, b), letter in zip(ends, letters.tolist(), strict=True)}
    runs = [Run("B", loop, True) for loop in boundary_loops(topology)]
    for chain in (*topology.creases, *topology.rulings):
        runs += [run for run in _split(chain, known) if run.letter != "B"]
    return runs


def _split(chain: Polyline, letters: dict[tuple[int, int], str]) -> list[Run]:
    path = chain.vertices.tolist()
    if chain.closed:
        path = [*path, path[0]]
    names = [letters[min(a, b), max(a, b)] for a, b in pairwise(path)]
    cuts = [0, *(k for k in range(1, len(names)) if names[k] != names[k - 1]), len(names)]
    if chain.closed and len(cuts) == 2:
        return [Run(names[0], chain.vertices, True)]
    return [Run(names[a], np.array(path[a:b + 1]), False) for a, b in pairwise(cuts)]

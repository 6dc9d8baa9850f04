"""The lines of a structure with one letter each: what is drawn in one stroke."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from plisse.measure.folds import assignments
from plisse.structure.chains import boundary_loops
from plisse.structure.incidence import edge_lookup
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
    lookup = edge_lookup(topology)
    runs = [Run("B", loop, True) for loop in boundary_loops(topology)]
    for chain in (*topology.creases, *topology.rulings):
        names = letters[lookup(chain.path[:-1], chain.path[1:])]
        runs += [run for run in _split(chain, names) if run.letter != "B"]
    return runs


def _split(chain: Polyline, names: np.ndarray) -> list[Run]:
    """Runs of a chain with a letter for every edge of its path."""
    changes = np.flatnonzero(names[1:] != names[:-1]) + 1
    if chain.closed and len(changes) == 0:
        return [Run(str(names[0]), chain.vertices, True)]
    cuts = [0, *changes.tolist(), len(names)]
    return [Run(str(names[a]), chain.path[a:b + 1], False) for a, b in pairwise(cuts)]

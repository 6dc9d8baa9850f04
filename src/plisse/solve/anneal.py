"""Relaxation of a zigzag: constraints against displacement fairness whose weight falls step by step."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import numpy as np

from plisse.leastsquares.kernel import Term
from plisse.leastsquares.problem import Problem
from plisse.solve.energies import developability, displacement_fairness, flat_foldability, planarity
from plisse.solve.workspace import Workspace
from plisse.structure.topology import Topology

__all__ = ["SLOWLY", "WEIGHTS", "anneal"]

WEIGHTS = (1e-1, 1e-2, 1e-3)  # lower ones, or more of them, make no more of 120 random grids exact
SLOWLY = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)  # for starts that are far from exact in places, as over whole surfaces
LONGEST_STEP = 0.5


def anneal(topology: Topology, start: np.ndarray, *, rest: np.ndarray | None = None, principal: bool = False,
           weights: Sequence[float] = WEIGHTS, steps: int = 1,
           fairness: Mapping[str, float] = MappingProxyType({}), extra: Sequence[Term] = (),
           workspace: Workspace | None = None) -> np.ndarray:
    """Vertices (3, V) after Gauss–Newton steps from `start`, near the constraints and fair against `rest`.

    Coordinates are in units of the mean edge length. Every weight of the fairness terms gets `steps` steps, each no
    longer than half an edge; `fairness` is passed on to `displacement_fairness`, `extra` terms fade out with it;
    what a `workspace` holds for terms of the same names on the same topology is used again.
    """
    conditions: list[Term] = [planarity(topology), *developability(topology)]
    if principal:
        conditions += flat_foldability(topology)
    fair = [*displacement_fairness(topology, start if rest is None else rest, **fairness), *extra]
    key = np.arange(topology.vertex_count) if topology.ordering is None else topology.ordering
    terms = conditions + fair
    names = tuple(term.name for term in terms)
    problem = (workspace or Workspace()).held(
        ("relaxation", topology, names), lambda: Problem(terms, {"vertices": (3, key)}).prepare())
    blocks = {"vertices": start}
    for weight in weights:
        scaled = [Term(term.name, term.kernel, term.arguments, weight * term.weight, term.data) for term in fair]
        level = problem.with_terms(conditions + scaled)
        for _ in range(steps):
            at = level.linearise(blocks)
            step = -level.factor(at, 0.0).solve(level.gradient(at))
            blocks = level.moved(blocks, step * min(1.0, LONGEST_STEP / max(float(np.abs(step).max()), 1e-300)))
    return blocks["vertices"]

"""The exact conditions of a structure as a sparse system for any solver: residual, Jacobian, J Jᵀ and Jᵀ J."""

from functools import cached_property

import numpy as np
from scipy.sparse import csr_array

from clocks import turns
from plisse.leastsquares import Factor, GramPattern, NotPositiveDefinite, factoriser
from plisse.solve.energies import developability, flat_foldability, planarity
from plisse.structure.pleated import PleatedStructure

__all__ = ["System", "one_factorisation"]

DUAL_DAMPING, PRIMAL_DAMPING = 1e-13, 1e-10


class System:
    """Conditions (N,) on the 3V coordinates of a structure, in units of its mean edge.

    Conditions and coordinates stand in the elimination order of the topology. `x` is a vector (3V,).
    """

    def __init__(self, structure: PleatedStructure, principal: bool = False):
        topology = structure.topology
        self._terms = [planarity(topology), *developability(topology)]
        if principal:
            self._terms += flat_foldability(topology)
        key = np.arange(topology.vertex_count) if topology.ordering is None else topology.ordering
        self._place = _rank(key)
        self._row = _rank(np.concatenate([np.mean([key[rows.index] for rows in term.arguments], axis=0)
                                          for term in self._terms]))
        self.conditions, self.unknowns = len(self._row), 3 * topology.vertex_count
        self.start = np.empty((topology.vertex_count, 3))
        self.start[self._place] = structure.vertices / structure.mean_edge
        self.start, self._unit = self.start.ravel(), structure.mean_edge

    def vertices(self, x: np.ndarray) -> np.ndarray:
        """Vertices (V, 3) in model units."""
        return x.reshape(-1, 3)[self._place] * self._unit

    def residual(self, x: np.ndarray) -> np.ndarray:
        """What should be zero (N,)."""
        out = np.empty(self.conditions)
        out[self._row] = np.concatenate([term.kernel(*points) for term, points in self._gathered(x)])
        return out

    def entries(self, x: np.ndarray) -> np.ndarray:
        """Derivatives (3, E) by the vertices of `layout`."""
        return np.concatenate([gradient for term, points in self._gathered(x)
                               for gradient in term.kernel.gradients(*points)], axis=1)

    def jacobian(self, x: np.ndarray) -> csr_array:
        """J (N, 3V) on a pattern that is kept."""
        gather, indices, indptr = self._compressed
        return csr_array((self.entries(x).ravel()[gather], indices, indptr), shape=(self.conditions, self.unknowns))

    @cached_property
    def layout(self) -> tuple[np.ndarray, np.ndarray]:
        """Condition and place of the vertex of every block of three derivatives (E,)."""
        ends = np.cumsum([term.count for term in self._terms])
        rows = [self._row[end - term.count:end] for end, term in zip(ends, self._terms, strict=True) for _ in term.arguments]
        places = [self._place[argument.index] for term in self._terms for argument in term.arguments]
        return np.concatenate(rows), np.concatenate(places)

    def dual(self) -> tuple[GramPattern, np.ndarray]:
        """Pattern and entries of J Jᵀ + ε."""
        pattern = GramPattern(*self.layout, self.conditions)
        return pattern, _damped(pattern, self.entries(self.start), DUAL_DAMPING)

    def primal(self) -> tuple[GramPattern, np.ndarray]:
        """Pattern and entries of Jᵀ J + ε."""
        rows, places = self.layout
        pattern = GramPattern((3 * places + np.arange(3)[:, None]).ravel(), np.tile(rows, 3), self.unknowns)
        return pattern, _damped(pattern, self.entries(self.start).ravel(), PRIMAL_DAMPING)

    @cached_property
    def _compressed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Which derivative each stored entry of J is, with the indices of its rows."""
        rows, places = self.layout
        number = csr_array((np.arange(1.0, 3 * len(rows) + 1),
                            (np.tile(rows, 3), (3 * places + np.arange(3)[:, None]).ravel())),
                           shape=(self.conditions, self.unknowns))
        return number.data.astype(np.int64) - 1, number.indices, number.indptr

    def _gathered(self, x: np.ndarray):
        vertices = x.reshape(-1, 3)[self._place].T
        return [(term, [vertices[:, rows.index] for rows in term.arguments]) for term in self._terms]


def one_factorisation(structure: PleatedStructure, principal: bool = False, repeats: int = 3) -> float:
    """Processor seconds of one factorisation of J Jᵀ at a structure, by the solver that the library chooses: no method
    that takes even one Newton step on these conditions can be faster."""
    pattern, entries = System(structure, principal).dual()
    solver = factoriser(pattern)
    return turns(repeats, it=lambda: _factor(solver, pattern, entries))["it"]["cpu"]


def _factor(solver, pattern: GramPattern, entries: np.ndarray) -> Factor:
    """A factor; the damping grows where conditions depend on each other, as it does in the library."""
    for attempt in range(10):
        try:
            return solver.factor(entries)
        except NotPositiveDefinite:
            entries = entries.copy()
            entries[pattern.diagonal] += DUAL_DAMPING * 10.0 ** (attempt + 1)
    raise NotPositiveDefinite("no damping helps")


def _damped(pattern: GramPattern, values: np.ndarray, damping: float) -> np.ndarray:
    entries = pattern.assemble(values)
    entries[pattern.diagonal] += damping
    return entries


def _rank(key: np.ndarray) -> np.ndarray:
    rank = np.empty(len(key), np.int64)
    rank[np.argsort(key, kind="stable")] = np.arange(len(key))
    return rank

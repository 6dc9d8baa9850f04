"""The exact conditions of a pleated structure on its 3V coordinates, solved by minimum-norm steps in the dual.

dx = −Jᵀ (J Jᵀ + ε)⁻¹ r moves the vertices least; J Jᵀ has about 2V rows and, on grids, half the bandwidth of JᵀJ.
"""

from functools import cached_property

import numpy as np

from plisse.leastsquares import Factor, GramPattern, damped, factoriser
from plisse.leastsquares.kernel import Term
from plisse.solve.energies import developability, flat_foldability, planarity
from plisse.structure.topology import Topology

__all__ = ["Constraints"]

DAMPING = 1e-13


class Constraints:
    """Planarity of faces, angle sums 2π, and flat-foldability where `principal`, over vertices (3, V).

    Vertices are in units of the mean edge length.
    """

    def __init__(self, topology: Topology, principal: bool = False):
        self.topology = topology
        self.terms: list[Term] = [planarity(topology), *developability(topology)]
        if principal:
            self.terms += flat_foldability(topology)
        self.count = sum(term.count for term in self.terms)

    @cached_property
    def _rank(self) -> np.ndarray:
        """Place of every constraint in the elimination order."""
        if self.topology.ordering is None:
            return np.arange(self.count)
        key = np.concatenate([np.mean([self.topology.ordering[rows.index] for rows in term.arguments], axis=0)
                              for term in self.terms])
        rank = np.empty(self.count, np.int64)
        rank[np.argsort(key, kind="stable")] = np.arange(self.count)
        return rank

    @cached_property
    def _entries(self) -> tuple[np.ndarray, np.ndarray]:
        """Constraint (ranked) and vertex of every block of three Jacobian entries."""
        starts = np.cumsum([0] + [term.count for term in self.terms])
        rows = [self._rank[start:start + term.count] for start, term in zip(starts, self.terms, strict=False)
                for _ in term.arguments]
        vertices = [rows_.index for term in self.terms for rows_ in term.arguments]
        return np.concatenate(rows), np.concatenate(vertices)

    @cached_property
    def _pattern(self) -> GramPattern:
        return GramPattern(*self._entries, self.count)

    @cached_property
    def _factoriser(self):
        return factoriser(self._pattern)

    def residual(self, vertices: np.ndarray) -> np.ndarray:
        """Residuals (N,) in elimination order."""
        out = np.empty(self.count)
        out[self._rank] = np.concatenate([term.kernel(*_gather(term, vertices)) for term in self.terms])
        return out

    def jacobian(self, vertices: np.ndarray) -> np.ndarray:
        """Jacobian entries (3, E)."""
        return np.concatenate([gradient for term in self.terms
                               for gradient in term.kernel.gradients(*_gather(term, vertices))], axis=1)

    def factor(self, jacobian: np.ndarray) -> Factor:
        """Factor of J Jᵀ + ε; ε grows where constraints depend on each other."""
        return damped(self._factoriser, jacobian, DAMPING, attempts=10)

    def pull_back(self, jacobian: np.ndarray, multipliers: np.ndarray) -> np.ndarray:
        """Jᵀy (3, V)."""
        rows, vertices = self._entries
        weighted = jacobian * multipliers.take(rows)
        return np.stack([np.bincount(vertices, component, self.topology.vertex_count) for component in weighted])


def _gather(term: Term, vertices: np.ndarray) -> list[np.ndarray]:
    return [vertices.take(rows.index, axis=1) for rows in term.arguments]

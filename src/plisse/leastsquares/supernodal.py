"""rslab's supernodal factorisation (`plisse[fast]`): a third of SuperLU's time, where it is installed."""

import os

import numpy as np
from scipy.sparse import csc_array

from plisse.leastsquares.factor import Assembled, Factor, NotPositiveDefinite
from plisse.leastsquares.gram import GramPattern
from plisse.leastsquares.sparse import Sparse

__all__ = ["Supernodal"]

BACKWARD_ERROR = 1e-8


class Supernodal(Assembled):
    """LDLᵀ of positive definite matrices: one analysis of the pattern for all of them. It cannot be pickled.

    rslab waits for ever in a process forked from one that has used it, so there SuperLU takes over.
    Raises ImportError without rslab.
    """

    def __init__(self, pattern: GramPattern):
        import rslab

        self.pattern, self._process = pattern, os.getpid()
        self._analysis = rslab.analyze(self._lower(np.ones(len(pattern.rows))), path="ldlt", threads=1, ordering="amf")

    def factor(self, entries: np.ndarray) -> Factor:
        """The factor; raises NotPositiveDefinite for negative or vanishing pivots and where it does not solve."""
        if os.getpid() != self._process:
            return Sparse(self.pattern).factor(entries)
        try:
            factor = self._analysis.factor(entries)
        except RuntimeError as error:
            raise NotPositiveDefinite(str(error)) from None
        if factor.inertia[0] < self.pattern.size or not self._solves(factor, entries):
            raise NotPositiveDefinite("a pivot is not positive, or too small to divide by")
        return factor

    def _solves(self, factor: Factor, entries: np.ndarray) -> bool:
        """Whether a trial solution is finite and leaves no residual: nearly singular matrices go unnoticed otherwise."""
        lower = self._lower(entries)
        trial = np.cos(np.arange(self.pattern.size))
        solution = factor.solve(trial)
        residual = lower @ solution + lower.T @ solution - entries[self.pattern.diagonal] * solution - trial
        size = np.abs(entries).max() * np.abs(solution).max() + 1
        return bool(np.abs(residual).max() <= BACKWARD_ERROR * size)

    def _lower(self, entries: np.ndarray) -> csc_array:
        count = np.bincount(self.pattern.columns, minlength=self.pattern.size)
        starts = np.concatenate([[0], np.cumsum(count)])
        return csc_array((entries, self.pattern.rows, starts), shape=(self.pattern.size, self.pattern.size))

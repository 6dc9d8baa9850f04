"""What a factorisation of symmetric positive definite matrices on a GramPattern offers."""

from typing import Protocol

import numpy as np

from plisse.leastsquares.gram import GramPattern

__all__ = ["Assembled", "Factor", "Factoriser", "NotPositiveDefinite", "damped"]


class NotPositiveDefinite(ArithmeticError):
    """The matrix has no Cholesky factor; more damping gives it one."""


class Factor(Protocol):
    """A factorised matrix."""

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Solution (size,) for a right-hand side (size,)."""


class Factoriser(Protocol):
    """Factorises matrices that share one pattern."""

    def factor(self, entries: np.ndarray) -> Factor:
        """Factor of the matrix with these lower-triangle entries; raises NotPositiveDefinite."""

    def factor_product(self, values: np.ndarray, damping: float) -> Factor:
        """Factor of A Aᵀ + damping for the values of A; raises NotPositiveDefinite."""


class Assembled:
    """Products are assembled entry by entry before they are factorised."""

    pattern: GramPattern

    def factor(self, entries: np.ndarray) -> Factor:
        """Factor of the matrix with these lower-triangle entries; raises NotPositiveDefinite."""
        raise NotImplementedError

    def factor_product(self, values: np.ndarray, damping: float) -> Factor:
        """Factor of A Aᵀ + damping for the values of A; raises NotPositiveDefinite."""
        entries = self.pattern.assemble(values)
        entries[self.pattern.diagonal] += damping
        return self.factor(entries)


def damped(factoriser: Factoriser, values: np.ndarray, damping: float, attempts: int) -> Factor:
    """Factor of A Aᵀ + damping; where it is not positive definite damping grows tenfold, so many times at most."""
    for attempt in range(attempts):
        try:
            return factoriser.factor_product(values, damping * 10.0**attempt)
        except NotPositiveDefinite:
            continue
    raise NotPositiveDefinite("no amount of damping makes the matrix positive definite")

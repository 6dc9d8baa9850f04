"""What a factorisation of symmetric positive definite matrices on a GramPattern offers."""

from typing import Protocol

import numpy as np

__all__ = ["Factor", "Factoriser", "NotPositiveDefinite"]


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

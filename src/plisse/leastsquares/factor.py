"""Factorisations of symmetric positive definite matrices given on a GramPattern."""

from typing import Protocol

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import csc_array, tril
from scipy.sparse.linalg import splu

from plisse.leastsquares.gram import GramPattern

__all__ = ["Factor", "NotPositiveDefinite", "factoriser"]

MAX_BAND_BYTES = 1.2e9


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


def factoriser(pattern: GramPattern) -> Factoriser:
    """The faster of banded and sparse factorisation for a pattern, judged by its bandwidth."""
    band_bytes = 8.0 * pattern.size * (pattern.bandwidth + 1)
    fill = band_bytes / 8 / len(pattern.rows)
    return Banded(pattern) if band_bytes < MAX_BAND_BYTES and fill < 60 else Sparse(pattern)


class Banded:
    """LAPACK's banded Cholesky: on grids it beats every sparse solver."""

    def __init__(self, pattern: GramPattern):
        self._shape = (pattern.size, pattern.bandwidth + 1)
        self._position = pattern.columns * self._shape[1] + pattern.rows - pattern.columns

    def factor(self, entries: np.ndarray) -> "_BandedFactor":
        """Banded Cholesky factor."""
        band = np.zeros(self._shape)
        band.reshape(-1)[self._position] = entries
        factor, info = lapack.dpbtrf(band.T, lower=1, overwrite_ab=1)
        if info != 0:
            raise NotPositiveDefinite(f"leading minor {info} is not positive")
        return _BandedFactor(factor)


class _BandedFactor:
    def __init__(self, factor: np.ndarray):
        self._factor = factor

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Forward and back substitution."""
        return lapack.dpbtrs(self._factor, right[:, None], lower=1)[0].ravel()


class Sparse:
    """SuperLU in its symmetric mode, for topologies without a narrow band."""

    def __init__(self, pattern: GramPattern):
        shape = (pattern.size, pattern.size)
        number = csc_array((np.arange(1.0, len(pattern.rows) + 1), (pattern.rows, pattern.columns)), shape=shape)
        full = csc_array(number + tril(number, -1).T)
        full.sort_indices()
        self._gather = full.data.astype(np.int64) - 1
        self._indices, self._indptr, self._shape = full.indices, full.indptr, shape

    def factor(self, entries: np.ndarray) -> Factor:
        """Sparse LU factor with pivots on the diagonal."""
        matrix = csc_array((entries[self._gather], self._indices, self._indptr), shape=self._shape)
        try:
            return splu(matrix, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        except RuntimeError as error:
            raise NotPositiveDefinite(str(error)) from None

"""LAPACK's banded Cholesky, in the order of a pattern or in a narrower one."""

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import csr_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from plisse.leastsquares.factor import NotPositiveDefinite
from plisse.leastsquares.gram import GramPattern

__all__ = ["Band", "Banded"]


class Band:
    """Where the lower-triangle entries of a pattern lie in a band; `order` (size,) lists rows as they are eliminated."""

    def __init__(self, pattern: GramPattern, order: np.ndarray | None = None):
        rows, columns = pattern.rows, pattern.columns
        if order is not None:
            place = np.empty(pattern.size, np.int64)
            place[order] = np.arange(pattern.size)
            rows, columns = np.maximum(place[rows], place[columns]), np.minimum(place[rows], place[columns])
        self.order, self.size, self.rows, self.columns = order, pattern.size, rows, columns
        self.bandwidth = int((rows - columns).max())

    @classmethod
    def narrow(cls, pattern: GramPattern) -> "Band":
        """The band in reverse Cuthill–McKee order: for sheets about twice as wide as the sheet is at its widest."""
        graph = csr_array((np.ones(len(pattern.rows), np.int8), (pattern.rows, pattern.columns)),
                          shape=(pattern.size, pattern.size))
        return cls(pattern, reverse_cuthill_mckee(csr_array(graph + graph.T), symmetric_mode=True))

    @property
    def bytes(self) -> float:
        """Memory of a matrix stored as this band."""
        return 8.0 * self.size * (self.bandwidth + 1)

    @property
    def operations(self) -> float:
        """Multiplications of a factorisation for every entry of the pattern."""
        return float(self.size) * self.bandwidth**2 / len(self.rows)


class Banded:
    """Banded Cholesky: on grids, and wherever a sheet is narrow, it beats every sparse solver."""

    def __init__(self, band: Band):
        self._shape, self._order = (band.size, band.bandwidth + 1), band.order
        self._position = band.columns * self._shape[1] + band.rows - band.columns

    def factor(self, entries: np.ndarray) -> "_BandedFactor":
        """Banded Cholesky factor."""
        band = np.zeros(self._shape)
        band.reshape(-1)[self._position] = entries
        factor, info = lapack.dpbtrf(band.T, lower=1, overwrite_ab=1)
        if info != 0:
            raise NotPositiveDefinite(f"leading minor {info} is not positive")
        if not np.isfinite(factor[0]).all():
            raise NotPositiveDefinite("the matrix has entries that are not finite numbers")
        return _BandedFactor(factor, self._order)


class _BandedFactor:
    def __init__(self, factor: np.ndarray, order: np.ndarray | None):
        self._factor, self._order = factor, order

    def solve(self, right: np.ndarray) -> np.ndarray:
        """Forward and back substitution."""
        ordered = right if self._order is None else right[self._order]
        solution = lapack.dpbtrs(self._factor, ordered[:, None], lower=1)[0].ravel()
        if self._order is None:
            return solution
        out = np.empty_like(solution)
        out[self._order] = solution
        return out

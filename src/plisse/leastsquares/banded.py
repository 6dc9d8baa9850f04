"""LAPACK's banded Cholesky, in the order of a pattern or in a narrower one."""

import numpy as np
from scipy.linalg import lapack
from scipy.sparse import csr_array
from scipy.sparse.csgraph import reverse_cuthill_mckee

from plisse.leastsquares.factor import NotPositiveDefinite
from plisse.leastsquares.gram import GramPattern

__all__ = ["Band", "Banded"]


class Band:
    """Where the products of a pattern lie in a band; `order` (size,) lists rows as they are eliminated."""

    def __init__(self, pattern: GramPattern, order: np.ndarray | None = None):
        self.pattern, self.order = pattern, order
        self._place: np.ndarray | None = None
        self.bandwidth = pattern.bandwidth
        if order is not None:
            self._place = np.empty(pattern.size, np.int64)
            self._place[order] = np.arange(pattern.size)
            self.bandwidth = int(np.abs(self._place[pattern.high] - self._place[pattern.low]).max())

    @classmethod
    def narrow(cls, pattern: GramPattern) -> "Band":
        """The band in reverse Cuthill–McKee order: for sheets about twice as wide as the sheet is at its widest."""
        graph = csr_array((np.ones(len(pattern.rows), np.int8), (pattern.rows, pattern.columns)),
                          shape=(pattern.size, pattern.size))
        return cls(pattern, reverse_cuthill_mckee(csr_array(graph + graph.T), symmetric_mode=True))

    @property
    def shape(self) -> tuple[int, int]:
        """Columns of the matrix, and entries stored of each: the diagonal first, then what is below."""
        return self.pattern.size, self.bandwidth + 1

    @property
    def bytes(self) -> float:
        """Memory of a matrix stored as this band."""
        return 8.0 * self.shape[0] * self.shape[1]

    @property
    def operations(self) -> float:
        """Multiplications of a factorisation for every entry of the pattern."""
        return float(self.pattern.size) * self.bandwidth**2 / self.pattern.count

    def positions(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """Where entries of the lower triangle, in columns `low` and rows `high`, lie in the band."""
        if self._place is not None:
            low, high = self._place[low], self._place[high]
            low, high = np.minimum(low, high), np.maximum(low, high)
        return low * np.int64(self.bandwidth) + high


class Banded:
    """Banded Cholesky: on grids, and wherever a sheet is narrow, it beats every sparse solver."""

    def __init__(self, band: Band):
        self._pattern, self._band = band.pattern, band
        self._of_products = band.positions(band.pattern.low, band.pattern.high)

    def factor(self, entries: np.ndarray) -> "_BandedFactor":
        """Banded Cholesky factor."""
        band = np.zeros(self._band.shape)
        band.reshape(-1)[self._band.positions(self._pattern.columns, self._pattern.rows)] = entries
        return self._factored(band)

    def factor_product(self, values: np.ndarray, damping: float) -> "_BandedFactor":
        """Banded Cholesky factor of A Aᵀ + damping: products are summed where they lie in the band."""
        columns, depth = self._band.shape
        band: np.ndarray = np.bincount(self._of_products, self._pattern.products(values), columns * depth)
        band[::depth] += damping
        return self._factored(band.reshape(columns, depth))

    def _factored(self, band: np.ndarray) -> "_BandedFactor":
        factor, info = lapack.dpbtrf(band.T, lower=1, overwrite_ab=1)
        if info != 0:
            raise NotPositiveDefinite(f"leading minor {info} is not positive")
        if not np.isfinite(factor[0]).all():
            raise NotPositiveDefinite("the matrix has entries that are not finite numbers")
        return _BandedFactor(factor, self._band.order)


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

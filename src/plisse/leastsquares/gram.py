"""Products A Aᵀ of a sparse matrix with a fixed pattern, assembled without a sort or a search."""

import numpy as np
from scipy.sparse import csc_array

__all__ = ["GramPattern"]


class GramPattern:
    """Lower triangle of G = Σ over pairs of entries that share a column of A, for A given by entries (row, column).

    Built once; `assemble` multiplies entry values pairwise and sums runs. Rows with several components per column
    (vertices with x, y, z) have their components along the first axis of the values.
    """

    def __init__(self, row: np.ndarray, column: np.ndarray, size: int):
        row = row.astype(np.int32, copy=False)
        first, second = _pairs_within(column)
        one, other = row[first], row[second]
        low, high = np.minimum(one, other), np.maximum(one, other)
        order = _counting_order(high, size)
        order = order[_counting_order(low[order], size)]
        self._first, self._second = first[order], second[order]
        low, high = low[order], high[order]
        self._starts = np.flatnonzero(np.r_[True, (high[1:] != high[:-1]) | (low[1:] != low[:-1])])
        self.size = size
        self.columns, self.rows = low[self._starts].astype(np.int64), high[self._starts].astype(np.int64)
        self.diagonal = np.flatnonzero(self.rows == self.columns)

    @property
    def bandwidth(self) -> int:
        """Largest distance of an entry from the diagonal."""
        return int((self.rows - self.columns).max())

    def assemble(self, values: np.ndarray) -> np.ndarray:
        """Entries of the lower triangle, column by column, for values (components, E) or (E,)."""
        values = np.atleast_2d(values)
        product = values[0][self._first] * values[0][self._second]
        for component in values[1:]:
            product += component[self._first] * component[self._second]
        return np.add.reduceat(product, self._starts)


def _pairs_within(group: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of entries (each with itself too) that have the same group."""
    order = np.argsort(group, kind="stable").astype(np.int32)
    count = np.bincount(group)
    start = np.cumsum(count) - count
    first, second = [], []
    for k in range(count.max()):
        having = start[count > k]
        for j in range(k + 1):
            first.append(order[having + k])
            second.append(order[having + j])
    return np.concatenate(first), np.concatenate(second)


def _counting_order(key: np.ndarray, size: int) -> np.ndarray:
    """Stable order by key in linear time: the column → row conversion of a sparse matrix is a counting sort."""
    count = len(key)
    incidence = csc_array((np.ones(count, np.int8), key.astype(np.int32, copy=False), np.arange(count + 1, dtype=np.int32)),
                          shape=(size, count))
    return incidence.tocsr().indices

"""Products A Aᵀ of a sparse matrix with a fixed pattern, assembled without a sort or a search."""

from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_array

__all__ = ["GramPattern"]

SEVERAL_TIMES = 50  # as many places as products: to sort them is faster than to mark them all


class GramPattern:
    """Lower triangle of G = Σ over pairs of entries that share a column of A, for A given by entries (row, column).

    Products of pairs come in an order in which entries of many columns are multiplied at once, `low` and `high` (P,) are
    the places in G where they belong. Who stores G otherwise than entry by entry adds them up himself. Rows with several
    components per column (vertices with x, y, z) have their components along the first axis of the values.
    """

    def __init__(self, row: np.ndarray, column: np.ndarray, size: int):
        self.size, self._groups = size, _groups(column)
        row = row.astype(np.int32, copy=False)
        pairs = [(of_group[layer, :width], of_group[:layer + 1, :width])
                 for of_group, widths in ((row[group.entries], group.widths) for group in self._groups)
                 for layer, width in enumerate(widths)]
        self.low = np.concatenate([np.minimum(one, others).ravel() for one, others in pairs])
        self.high = np.concatenate([np.maximum(one, others).ravel() for one, others in pairs])

    @cached_property
    def bandwidth(self) -> int:
        """Largest distance of an entry from the diagonal."""
        return int((self.high - self.low).max())

    @cached_property
    def count(self) -> int:
        """Number of entries of the lower triangle."""
        places = self.size * (self.bandwidth + 1)
        if places > SEVERAL_TIMES * len(self.low):
            return len(self.rows)
        there = np.zeros(places, bool)
        there[self.low * np.int64(self.bandwidth) + self.high] = True
        return int(np.count_nonzero(there))

    @cached_property
    def _order(self) -> np.ndarray:
        """The order of the products column by column and row by row."""
        order = _counting_order(self.high, self.size)
        return order[_counting_order(self.low[order], self.size)]

    @cached_property
    def _starts(self) -> np.ndarray:
        """Where, in this order, the products of another entry begin."""
        low, high = self.low[self._order], self.high[self._order]
        return np.flatnonzero(np.r_[True, (high[1:] != high[:-1]) | (low[1:] != low[:-1])])

    @cached_property
    def columns(self) -> np.ndarray:
        """Column of every entry of the lower triangle, column by column."""
        return self.low[self._order[self._starts]].astype(np.int64)

    @cached_property
    def rows(self) -> np.ndarray:
        """Row of every entry of the lower triangle, column by column."""
        return self.high[self._order[self._starts]].astype(np.int64)

    @cached_property
    def diagonal(self) -> np.ndarray:
        """Entries on the diagonal."""
        return np.flatnonzero(self.rows == self.columns)

    def products(self, values: np.ndarray) -> np.ndarray:
        """Products (P,) of all pairs for values (components, E) or (E,)."""
        values = np.atleast_2d(values)
        out, start = np.empty(len(self.low)), 0
        for group in self._groups:
            parts = [component.take(group.entries) for component in values]
            for layer, width in enumerate(group.widths):
                product = out[start:start + (layer + 1) * width].reshape(layer + 1, width)
                np.multiply(parts[0][layer, :width], parts[0][:layer + 1, :width], out=product)
                for part in parts[1:]:
                    product += part[layer, :width] * part[:layer + 1, :width]
                start += product.size
        return out

    def assemble(self, values: np.ndarray) -> np.ndarray:
        """Entries of the lower triangle, column by column, for values (components, E) or (E,)."""
        return np.add.reduceat(self.products(values).take(self._order), self._starts)


class _Group(NamedTuple):
    """Columns with about as many entries each, the fullest first: their `entries` (layers, columns).

    A layer goes as far as its width; what is stored beyond it means nothing.
    """

    entries: np.ndarray
    widths: list[int]


def _groups(column: np.ndarray) -> list[_Group]:
    """All columns, in groups in which none has more than twice as many entries as another."""
    order, count = _counting_order(column, int(column.max()) + 1), np.bincount(column)
    fullest_first = _counting_order(count.max() - count, int(count.max()) + 1)
    start, count = (np.cumsum(count) - count)[fullest_first], count[fullest_first]
    groups, first = [], 0
    while first < len(count) and count[first]:
        layers = int(count[first])
        last = len(count) - int(np.searchsorted(count[::-1], (layers + 1) // 2))
        places = start[first:last] + np.arange(layers)[:, None]
        widths = [last - first - int(np.searchsorted(count[first:last][::-1], layer + 1)) for layer in range(layers)]
        groups.append(_Group(order[np.minimum(places, len(order) - 1)], widths))
        first = last
    return groups


def _counting_order(key: np.ndarray, size: int) -> np.ndarray:
    """Stable order by key in linear time: short numbers are sorted by their digits, and the column → row conversion of a
    sparse matrix is a counting sort."""
    if max(len(key), size) <= 2**16:
        return np.argsort(key.astype(np.uint16), kind="stable")
    count = len(key)
    incidence = csc_array((np.ones(count, np.int8), key.astype(np.int32, copy=False), np.arange(count + 1, dtype=np.int32)),
                          shape=(size, count))
    return incidence.tocsr().indices

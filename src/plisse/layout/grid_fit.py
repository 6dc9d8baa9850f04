"""Linear least squares for functions on a grid of rows and columns, banded along its longer side."""

from collections.abc import Sequence

import numpy as np

from plisse.leastsquares import GramPattern, factoriser
from plisse.structure.grid import grid

__all__ = ["GridFit", "across_pairs", "along_pairs", "along_triples", "nodes"]


class GridFit:
    """Equations Σ_k c_k u[node_k] + r = 0 in the sense of least squares, for a function u on rows × columns.

    Every stencil (R, k) lists the nodes of R equations; coefficients may change from step to step, stencils not.
    """

    def __init__(self, shape: tuple[int, int], closed: bool, stencils: Sequence[np.ndarray], is_ring: bool = False):
        self._shape = shape
        ordering = grid(*shape, closed_creases=closed, closed_family=is_ring).ordering
        assert ordering is not None
        rank = np.empty(shape[0] * shape[1], np.int64)
        rank[np.argsort(ordering, kind="stable")] = np.arange(len(rank))
        self._rank = rank
        starts = np.cumsum([0] + [len(stencil) for stencil in stencils])
        self._equation = np.concatenate([np.repeat(start + np.arange(len(stencil)), stencil.shape[1])
                                         for start, stencil in zip(starts, stencils, strict=False)])
        self._unknown = np.concatenate([rank[stencil].ravel() for stencil in stencils])
        self._factoriser = factoriser(GramPattern(self._unknown, self._equation, len(rank)))

    def solve(self, coefficients: Sequence[np.ndarray], residuals: Sequence[np.ndarray]) -> np.ndarray:
        """The function u (rows, columns) for coefficients (R, k) and residuals r (R,) of each stencil."""
        entries = np.concatenate([part.ravel() for part in coefficients])
        right = np.concatenate([part.ravel() for part in residuals])
        gradient = np.bincount(self._unknown, entries * right[self._equation], len(self._rank))
        solution = self._factoriser.factor_product(entries, 0.0).solve(-gradient)
        return solution[self._rank].reshape(self._shape)


def nodes(shape: tuple[int, int]) -> np.ndarray:
    """Every node alone (N, 1)."""
    return np.arange(shape[0] * shape[1])[:, None]


def along_pairs(shape: tuple[int, int], closed: bool) -> np.ndarray:
    """Neighbours (R, 2) along rows."""
    index = nodes(shape).reshape(shape)
    last = np.roll(index, -1, axis=1)
    width = shape[1] if closed else shape[1] - 1
    return np.stack([index[:, :width].ravel(), last[:, :width].ravel()], axis=1)


def across_pairs(shape: tuple[int, int], is_ring: bool = False) -> np.ndarray:
    """Neighbours (R, 2) in the same column of successive rows; in a ring the first row follows the last."""
    index = nodes(shape).reshape(shape)
    count = shape[0] if is_ring else shape[0] - 1
    return np.stack([index[:count].ravel(), np.roll(index, -1, axis=0)[:count].ravel()], axis=1)


def along_triples(shape: tuple[int, int], closed: bool) -> np.ndarray:
    """Previous, own and next node (N, 3) along rows for every node; the ends of open rows take their neighbour's."""
    index = nodes(shape).reshape(shape)
    middle = np.arange(shape[1]) if closed else np.clip(np.arange(shape[1]), 1, shape[1] - 2)
    return np.stack([index[:, (middle + step) % shape[1]].ravel() for step in (-1, 0, 1)], axis=1)

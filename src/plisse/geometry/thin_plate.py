"""Quintic splines over a rectangle that follow scattered heights or points with little energy."""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import BSpline, NdBSpline
from scipy.sparse import csc_array, csr_array, kron
from scipy.sparse.linalg import splu

__all__ = ["smoothing_spline"]

DEGREE = 5


def smoothing_spline(places: np.ndarray, heights: np.ndarray, low: np.ndarray, high: np.ndarray, spacing: float,
                     strength: float, plate: float, periodic: bool = False) -> NdBSpline:
    """The spline z on [low, high] that minimises Σ |z − z_k|² + strength ∫ |∂³z|² + plate |∂²z|².

    `heights` (K,) or (K, 3) belong to the `places` (K, 2). Knots are about `spacing` apart. Far from the places the
    spline becomes linear. If `periodic`, it closes in the first direction.
    """
    one, two = (_Axis(a, b, max(DEGREE + 2 if around else 3, int(np.ceil((b - a) / spacing))), around)
                for a, b, around in zip(low, high, (periodic, False), strict=True))
    rows = _row_products(one.values(places[:, 0]), two.values(places[:, 1]))
    system = csc_array(rows.T @ rows + strength * _energy(one, two, plate))
    factor = splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
    right = rows.T @ heights
    solution = factor.solve(right)
    solution += factor.solve(right - system @ solution)
    coefficients = solution.reshape(one.count, two.count, *heights.shape[1:])
    return NdBSpline((one.knots, two.knots), coefficients[one.folded][:, two.folded], DEGREE, extrapolate=True)


@dataclass(frozen=True)
class _Axis:
    """Uniform B-splines on [low, high] with `cells` knot spans, the last of them the first ones again if `periodic`."""

    low: float
    high: float
    cells: int
    periodic: bool = False

    @property
    def count(self) -> int:
        return self.cells + (0 if self.periodic else DEGREE)

    @property
    def folded(self) -> np.ndarray:
        """Number of the unknown that belongs to each of the cells + 5 splines."""
        return np.arange(self.cells + DEGREE) % self.count

    @property
    def knots(self) -> np.ndarray:
        return self.low + (self.high - self.low) / self.cells * np.arange(-DEGREE, self.cells + DEGREE + 1)

    def values(self, at: np.ndarray) -> csr_array:
        rows = csr_array(BSpline.design_matrix(np.clip(at, self.low, self.high), self.knots, DEGREE))
        return csr_array((rows.data, self.folded[rows.indices], rows.indptr), shape=(len(at), self.count))

    def energies(self) -> list[csr_array]:
        """Gram matrices of the splines and of their derivatives up to the third, by Gauss's rule."""
        node, weight = np.polynomial.legendre.leggauss(DEGREE + 1)
        size = (self.high - self.low) / self.cells
        at = (self.low + size * (np.arange(self.cells)[:, None] + 0.5 * (node + 1))).ravel()
        root = np.sqrt(0.5 * size * np.tile(weight, self.cells))[:, None]
        basis = BSpline(self.knots, np.eye(self.count)[self.folded], DEGREE)
        grams = []
        for order in range(4):
            values = csr_array(root * basis(at, nu=order))
            grams.append(csr_array(values.T @ values))
        return grams


def _energy(one: _Axis, two: _Axis, plate: float) -> csr_array:
    """∫ |∂³z|² + plate |∂²z|² as a quadratic form in the spline coefficients."""
    x, y = one.energies(), two.energies()
    third = kron(x[3], y[0]) + 3 * kron(x[2], y[1]) + 3 * kron(x[1], y[2]) + kron(x[0], y[3])
    second = kron(x[2], y[0]) + 2 * kron(x[1], y[1]) + kron(x[0], y[2])
    return csr_array(third + plate * second)


def _row_products(one: csr_array, two: csr_array) -> csr_array:
    """Rows r of the result are kron(one[r], two[r]); every row has DEGREE + 1 entries."""
    count, width = one.shape[0], DEGREE + 1
    a, b = one.indices.reshape(count, width, 1), two.indices.reshape(count, 1, width)
    values = one.data.reshape(count, width, 1) * two.data.reshape(count, 1, width)
    columns = a.astype(np.int64) * two.shape[1] + b
    return csr_array((values.ravel(), columns.ravel(), np.arange(count + 1) * width**2),
                     shape=(count, one.shape[1] * two.shape[1]))

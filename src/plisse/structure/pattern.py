"""A pattern of guiding curves: M0 of §3.3 with the binormals along which the zigzag leaves it."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline, make_interp_spline

from plisse.geometry.vectors import unit
from plisse.structure.grid import grid
from plisse.structure.topology import Topology

__all__ = ["Pattern"]


@dataclass(frozen=True, eq=False)
class Pattern:
    """Guiding curves `curves` (m, n, 3) with regularised `binormals` (m, n, 3), uniformly parametrised along i.

    `theta` (m,) are inclinations in radians, `widths` (m−1, n) the widths of the strips at the curves' parameters.
    Closed curves do not repeat their first point. In a closed family the last curve is followed by the first: `widths`
    has m rows, and m is even.
    """

    curves: np.ndarray
    binormals: np.ndarray
    theta: np.ndarray
    widths: np.ndarray
    closed: bool = False
    closed_family: bool = False

    @property
    def creases(self) -> int:
        """Number of guiding curves."""
        return self.curves.shape[0]

    @property
    def samples(self) -> int:
        """Number of points on each."""
        return self.curves.shape[1]

    @property
    def parameters(self) -> np.ndarray:
        """Parameter in [0, 1] of every column; 1 is left out on closed curves."""
        return np.linspace(0, 1, self.samples, endpoint=not self.closed)

    @property
    def shape(self) -> tuple[int, int, bool, bool]:
        """Creases, samples, whether creases are closed, whether the family is: what makes the grid."""
        return self.creases, self.samples, self.closed, self.closed_family

    @cached_property
    def topology(self) -> Topology:
        """The obvious quad mesh M0 over the pattern."""
        return grid(self.creases, self.samples, closed_creases=self.closed, closed_family=self.closed_family)

    @cached_property
    def _spline(self):
        """All curves, binormals and widths side by side: (parameters, 7m − 1), or 7m where the family closes."""
        fields = np.concatenate([self.curves, self.binormals], axis=-1)
        columns = [fields.swapaxes(0, 1).reshape(self.samples, -1), self.widths.T]
        return interpolate_along(np.concatenate(columns, axis=1)[None], self.closed)

    @cached_property
    def _resampled(self) -> dict[int, "Pattern"]:
        return {self.samples: self}

    def resampled(self, samples: int) -> "Pattern":
        """The same pattern with another number of points along every curve, by interpolating splines."""
        if samples not in self._resampled:
            values = self._spline(np.linspace(0, 1, samples, endpoint=not self.closed))[:, 0]
            fields = values[:, :6 * self.creases].reshape(samples, -1, 6).swapaxes(0, 1)
            self._resampled[samples] = replace(self, curves=np.ascontiguousarray(fields[..., :3]),
                                               binormals=unit(fields[..., 3:]), widths=values[:, 6 * self.creases:].T)
        return self._resampled[samples]


def interpolate_along(fields: np.ndarray, closed: bool, degree: int = 5):
    """Spline through fields (m, n, …) along their second axis, over [0, 1]; its values are (parameters, m, …)."""
    values = np.moveaxis(fields, 1, 0)
    count = len(values) + closed
    degree = min(degree, 5 if count > 7 else 3 if count > 3 else 1)
    return _periodic(values, degree) if closed else make_interp_spline(np.linspace(0, 1, count), values, k=degree)


def _periodic(values: np.ndarray, degree: int) -> BSpline:
    """The spline of odd degree through values (n, …) at k/n that repeats after 1: its system is circulant."""
    count, reach = len(values), degree // 2
    weights = BSpline.basis_element(np.arange(degree + 2.0))(np.arange(1.0, degree + 1))
    row = np.bincount(np.arange(-reach, reach + 1) % count, weights, count)
    spectrum = np.fft.rfft(row).real.reshape(-1, *[1] * (values.ndim - 1))
    coefficients = np.fft.irfft(np.fft.rfft(values, axis=0) / spectrum, count, axis=0)
    knots, around = np.arange(-degree, count + degree + 1) / count, np.arange(-reach, count + degree - reach) % count
    return BSpline(knots, coefficients[around], degree, extrapolate="periodic")

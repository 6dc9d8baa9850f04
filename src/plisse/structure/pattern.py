"""A pattern of guiding curves: M0 of §3.3 with the binormals along which the zigzag leaves it."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import make_interp_spline

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

    @cached_property
    def topology(self) -> Topology:
        """The obvious quad mesh M0 over the pattern."""
        return grid(self.creases, self.samples, closed_creases=self.closed, closed_family=self.closed_family)

    @cached_property
    def _spline(self):
        fields = np.concatenate([self.curves, self.binormals], axis=-1)
        return interpolate_along(fields, self.closed)

    def resampled(self, samples: int) -> "Pattern":
        """The same pattern with another number of points along every curve, by interpolating splines."""
        if samples == self.samples:
            return self
        parameters = np.linspace(0, 1, samples, endpoint=not self.closed)
        fields = self._spline(parameters).swapaxes(0, 1)
        widths = interpolate_along(self.widths, self.closed)(parameters).T
        return replace(self, curves=np.ascontiguousarray(fields[..., :3]), binormals=unit(fields[..., 3:]), widths=widths)


def interpolate_along(fields: np.ndarray, closed: bool, degree: int = 5):
    """Spline through fields (m, n, …) along their second axis, over [0, 1]; its values are (parameters, m, …)."""
    values = np.moveaxis(fields, 1, 0)
    if closed:
        values = np.concatenate([values, values[:1]])
    degree = min(degree, 5 if len(values) > 7 else 3 if len(values) > 3 else 1)
    return make_interp_spline(np.linspace(0, 1, len(values)), values, k=degree, bc_type="periodic" if closed else None)

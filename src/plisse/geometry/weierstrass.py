"""Minimal surfaces from their Weierstrass data: X = Re ∫ (f (1 − g²)/2, i f (1 + g²)/2, f g) dz (§2.6).

Their asymptotic curves are straight in the coordinate ∫ √(i f g′) dz, and a zero of g′ of order m is a singularity of
index −m/2: what traced curves and located singularities are measured against.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from plisse.errors import InvalidDesign
from plisse.geometry.breaks import broken_place
from plisse.geometry.chart import ChartPoints, in_rectangle
from plisse.geometry.holomorphic import holomorphic

__all__ = ["MinimalSurface"]

PANELS, NODES = 4, 12

Holomorphic = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]


@dataclass(frozen=True)
class MinimalSurface:
    """The minimal surface of holomorphic g and f, expressions in z = x + iy over the rectangle x × y.

    The middle of the rectangle lies in the origin. Raises InvalidDesign for expressions that cannot be read or have
    poles or branch cuts in the rectangle.
    """

    g: str
    f: str
    x: tuple[float, float] = (-1.0, 1.0)
    y: tuple[float, float] = (-1.0, 1.0)

    def __post_init__(self):
        for name, function in (("g", self._g), ("f", self._f)):
            where = broken_place(partial(_partials, function), *self.domain)
            if where is not None:
                raise InvalidDesign(f"surface.weierstrass.{name} has a pole, a jump or no value near "
                                    f"z = {where.real:.4g}{where.imag:+.4g}i; give a function without poles and branch cuts "
                                    "there, or another range of surface.x and surface.y")

    @property
    def domain(self) -> tuple[complex, complex]:
        """Corners of the rectangle."""
        return complex(self.x[0], self.y[0]), complex(self.x[1], self.y[1])

    def positions(self, places: np.ndarray) -> np.ndarray:
        """Points (N, 3) at places z (N,), by Gauss's rule along rays from the middle."""
        node, weight = np.polynomial.legendre.leggauss(NODES)
        along = ((np.arange(PANELS)[:, None] + 0.5 * (node + 1)) / PANELS).ravel()
        middle = 0.5 * sum(self.domain)
        reach = places - middle
        at = (middle + along[:, None] * reach).ravel()
        values = _integrand(self._f(at)[0], self._g(at)[0]).reshape(len(along), len(places), 3)
        return np.real(np.einsum("k,kni->ni", np.tile(0.5 * weight / PANELS, PANELS), values) * reach[:, None])

    def at(self, places: np.ndarray) -> ChartPoints:
        """How the surface runs at places z (N,)."""
        (f, _), (g, derivative) = self._f(places), self._g(places)
        tangent = _integrand(f, g)
        partials = np.stack([tangent.real, -tangent.imag])
        square = np.abs(g) ** 2
        normals = np.stack([2 * g.real, 2 * g.imag, square - 1], axis=1) / (square + 1)[:, None]
        hopf = -f * derivative
        return ChartPoints(partials, normals, np.stack([hopf.real, -hopf.imag, -hopf.real]))

    def inside(self, places: np.ndarray) -> np.ndarray:
        """Mask (N,) of the places in the rectangle."""
        return in_rectangle(places, self.domain)

    @cached_property
    def _f(self) -> Holomorphic:
        return holomorphic(self.f, "surface.weierstrass.f")

    @cached_property
    def _g(self) -> Holomorphic:
        return holomorphic(self.g, "surface.weierstrass.g")


def _partials(function: Holomorphic, places: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Value and partial derivatives by x and y (N,) of a function of z = x + iy."""
    value, derivative = function(places)
    return value, derivative, 1j * derivative


def _integrand(f: np.ndarray, g: np.ndarray) -> np.ndarray:
    """dX/dz (N, 3): twice the derivative of X by z."""
    return np.stack([0.5 * f * (1 - g**2), 0.5j * f * (1 + g**2), f * g], axis=1)

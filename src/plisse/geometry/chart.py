"""Surfaces X(u, v) over a part of the plane, with all that asymptotic directions need (§2.6).

Places in the plane are complex numbers u + iv: directions are angles, and fields of directions turn by angles.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from plisse.geometry.graph import GraphSurface
from plisse.geometry.height_field import HeightField
from plisse.geometry.vectors import dot, unit

__all__ = ["Chart", "ChartPoints", "FormulaChart", "GraphChart"]


@dataclass(frozen=True, eq=False)
class ChartPoints:
    """`positions` (N, 3), first partial derivatives `partials` (2, N, 3), unit `normals` (N, 3) and `second` (3, N).

    `second` holds L, M and N, the second derivatives of X times the normal: a direction (a, b) of the plane is
    asymptotic where L a² + 2M ab + N b² vanishes.
    """

    positions: np.ndarray
    partials: np.ndarray
    normals: np.ndarray
    second: np.ndarray

    @property
    def metric(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """E, F and G of the first fundamental form (N,)."""
        xu, xv = self.partials
        return dot(xu, xu), dot(xu, xv), dot(xv, xv)

    @property
    def curvature(self) -> np.ndarray:
        """Gaussian curvature (N,)."""
        (e, f, g), (one, mixed, two) = self.metric, self.second
        return (one * two - mixed**2) / (e * g - f**2)


class Chart(Protocol):
    """A smooth surface over a part of the plane."""

    @property
    def domain(self) -> tuple[complex, complex]:
        """Lower left and upper right corner of a rectangle that holds the part."""

    def at(self, places: np.ndarray) -> ChartPoints:
        """The surface at places (N,)."""

    def inside(self, places: np.ndarray) -> np.ndarray:
        """Mask (N,) of the places that belong to the part."""


@dataclass(frozen=True)
class FormulaChart:
    """The graph of a height field over its rectangle."""

    field: HeightField

    @property
    def domain(self) -> tuple[complex, complex]:
        """Corners of the rectangle."""
        (left, right), (low, high) = self.field.x, self.field.y
        return complex(left, low), complex(right, high)

    def at(self, places: np.ndarray) -> ChartPoints:
        """The graph over places (N,)."""
        height, zx, zy, *hessian = self.field.derivatives(places.real, places.imag)
        return _graph(places, height, np.stack([zx, zy]), np.stack(hessian))

    def inside(self, places: np.ndarray) -> np.ndarray:
        """Mask (N,) of the places in the rectangle."""
        return in_rectangle(places, self.domain)


@dataclass(frozen=True)
class GraphChart:
    """The smooth graph over the mean plane of a mesh, as far as the mesh reaches."""

    surface: GraphSurface

    @property
    def domain(self) -> tuple[complex, complex]:
        """Corners of the mesh in the mean plane."""
        plane = self.surface.to_plane(self.surface.mesh.vertices)[:, :2]
        return complex(*plane.min(axis=0)), complex(*plane.max(axis=0))

    def at(self, places: np.ndarray) -> ChartPoints:
        """The graph over places (N,), in space as the mesh lies."""
        local = _graph(places, *self.surface.heights(np.stack([places.real, places.imag], axis=1)))
        frame = self.surface.frame
        return ChartPoints(self.surface.to_space(local.positions), local.partials @ frame, local.normals @ frame, local.second)

    def inside(self, places: np.ndarray) -> np.ndarray:
        """Mask (N,) of the places under the mesh."""
        return self.surface.is_over(np.stack([places.real, places.imag], axis=1))


def in_rectangle(places: np.ndarray, corners: tuple[complex, complex]) -> np.ndarray:
    """Mask (N,) of the places between lower left and upper right corner."""
    low, high = corners
    return np.asarray((places.real >= low.real) & (places.real <= high.real)
                      & (places.imag >= low.imag) & (places.imag <= high.imag))


def _graph(places: np.ndarray, height: np.ndarray, slopes: np.ndarray, hessian: np.ndarray) -> ChartPoints:
    zero, one = np.zeros_like(height), np.ones_like(height)
    partials = np.stack([np.stack([one, zero, slopes[0]], axis=1), np.stack([zero, one, slopes[1]], axis=1)])
    normals = unit(np.cross(*partials))
    return ChartPoints(np.stack([places.real, places.imag, height], axis=1), partials, normals, hessian * normals[:, 2])

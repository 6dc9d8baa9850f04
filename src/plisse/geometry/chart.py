"""Surfaces X(u, v) over a part of the plane, with all that asymptotic directions need (§2.6).

Places in the plane are complex numbers u + iv: directions are angles, and fields of directions turn by angles.
"""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

from plisse.errors import InvalidDesign
from plisse.geometry.breaks import broken_place
from plisse.geometry.graph import GraphSurface
from plisse.geometry.height_field import HeightField
from plisse.geometry.vectors import dot, unit

__all__ = ["Chart", "ChartPoints", "FormulaChart", "GraphChart", "in_rectangle"]


@dataclass(frozen=True, eq=False)
class ChartPoints:
    """First partial derivatives `partials` (2, N, 3), unit `normals` (N, 3) and `second` (3, N).

    `second` holds L, M and N, the second derivatives of X times the normal: a direction (a, b) of the plane is
    asymptotic where L a² + 2M ab + N b² vanishes.
    """

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

    def positions(self, places: np.ndarray) -> np.ndarray:
        """Points (N, 3) over places (N,)."""

    def at(self, places: np.ndarray) -> ChartPoints:
        """How the surface runs at places (N,)."""

    def inside(self, places: np.ndarray) -> np.ndarray:
        """Mask (N,) of the places that belong to the part."""


@dataclass(frozen=True)
class FormulaChart:
    """The graph of a height field over its rectangle; raises InvalidDesign for heights with a pole or a jump there."""

    field: HeightField

    def __post_init__(self):
        where = broken_place(lambda places: tuple(self.field.derivatives(places.real, places.imag)[:3]), *self.domain)
        if where is not None:
            raise InvalidDesign(f"the height {self.field.z[:40]!r} has a pole, a jump or no value near "
                                f"x = {where.real:.4g}, y = {where.imag:.4g}; give another range of surface.x and surface.y")

    @property
    def domain(self) -> tuple[complex, complex]:
        """Corners of the rectangle."""
        (left, right), (low, high) = self.field.x, self.field.y
        return complex(left, low), complex(right, high)

    def positions(self, places: np.ndarray) -> np.ndarray:
        """Points (N, 3) of the graph over places (N,)."""
        return np.column_stack([_plane(places), self.field.derivatives(places.real, places.imag)[0]])

    def at(self, places: np.ndarray) -> ChartPoints:
        """How the graph runs over places (N,)."""
        _, zx, zy, *hessian = self.field.derivatives(places.real, places.imag)
        return _graph(np.stack([zx, zy]), np.stack(hessian))

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

    def positions(self, places: np.ndarray) -> np.ndarray:
        """Points (N, 3) of the graph over places (N,), in space as the mesh lies."""
        plane = _plane(places)
        return self.surface.to_space(np.column_stack([plane, self.surface.heights(plane)[0]]))

    def at(self, places: np.ndarray) -> ChartPoints:
        """How the graph runs over places (N,), in space as the mesh lies."""
        local = _graph(*self.surface.heights(_plane(places))[1:])
        frame = self.surface.frame
        return ChartPoints(local.partials @ frame, local.normals @ frame, local.second)

    def inside(self, places: np.ndarray) -> np.ndarray:
        """Mask (N,) of the places under the mesh."""
        return self.surface.is_over(_plane(places))


def in_rectangle(places: np.ndarray, corners: tuple[complex, complex]) -> np.ndarray:
    """Mask (N,) of the places between lower left and upper right corner."""
    low, high = corners
    return np.asarray((places.real >= low.real) & (places.real <= high.real)
                      & (places.imag >= low.imag) & (places.imag <= high.imag))


def _plane(places: np.ndarray) -> np.ndarray:
    return np.stack([places.real, places.imag], axis=1)


def _graph(slopes: np.ndarray, hessian: np.ndarray) -> ChartPoints:
    zero, one = np.zeros_like(slopes[0]), np.ones_like(slopes[0])
    partials = np.stack([np.stack([one, zero, slopes[0]], axis=1), np.stack([zero, one, slopes[1]], axis=1)])
    normals = unit(np.cross(*partials))
    return ChartPoints(partials, normals, hessian * normals[:, 2])

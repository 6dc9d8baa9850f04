"""A chart as a reference surface: closest points by Newton's method, for surfaces that are no graphs over a plane."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.bending import bending
from plisse.geometry.chart import Chart
from plisse.geometry.mesh import ReferenceMesh, grid_lines, grid_mesh
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.vectors import dot

__all__ = ["ChartSurface"]

SAMPLES = 120  # along the longer side of the domain: places from which projections start
ROUNDS = 20


@dataclass(frozen=True, eq=False)
class ChartSurface:
    """The surface of a chart over its whole rectangle."""

    chart: Chart

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box of its samples."""
        return self.mesh().diagonal

    def mesh(self, cells: int = 60) -> ReferenceMesh:
        """Grid with `cells` cells along the longer side."""
        places = self._grid(cells)
        return grid_mesh(self.chart.positions(places.ravel()).reshape(*places.shape, 3))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Closest points to points (N, 3); unknown where they lie on the edge of the rectangle or beyond."""
        low, high = self.chart.domain
        tree, starts = self._seeds
        places = starts[tree.query(points)[1]]
        for _ in range(ROUNDS):
            step = _towards(self.chart, places, points)
            moved = places + step
            moved = np.clip(moved.real, low.real, high.real) + 1j * np.clip(moved.imag, low.imag, high.imag)
            size = np.abs(moved - places).max(initial=0)
            places = moved
            if size < 1e-12 * abs(high - low):
                break
        edge = 1e-9 * abs(high - low)
        inner = (np.minimum(places.real - low.real, high.real - places.real) > edge) \
            & (np.minimum(places.imag - low.imag, high.imag - places.imag) > edge)
        found = self.chart.at(places)
        return SurfacePoints(self.chart.positions(places), found.normals, bending(found.partials, found.second), inner)

    @cached_property
    def _seeds(self) -> tuple[cKDTree, np.ndarray]:
        places = self._grid(SAMPLES).ravel()
        return cKDTree(self.chart.positions(places)), places

    def _grid(self, cells: int) -> np.ndarray:
        low, high = self.chart.domain
        u, v = grid_lines((low.real, high.real), (low.imag, high.imag), cells)
        return u[:, None] + 1j * v


def _towards(chart: Chart, places: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Newton steps (N,) towards the closest points, with the metric alone where the distance is no convex function."""
    at = chart.at(places)
    gap = points - chart.positions(places)
    right = np.array([dot(gap, partial) for partial in at.partials])
    height = dot(gap, at.normals)
    e, f, g = at.metric
    one, mixed, two = e - height * at.second[0], f - height * at.second[1], g - height * at.second[2]
    convex = (one > 0) & (one * two - mixed**2 > 0.1 * (e * g - f**2))
    one, mixed, two = (np.where(convex, full, plain) for full, plain in ((one, e), (mixed, f), (two, g)))
    size = np.maximum(one * two - mixed**2, np.finfo(float).tiny)
    return (two * right[0] - mixed * right[1]) / size + 1j * (one * right[1] - mixed * right[0]) / size

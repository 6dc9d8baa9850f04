"""Inclination fitted to given rows: θ(row, column) for which they are as pseudo-geodesic as can be (§3.1)."""

import numpy as np

from plisse.layout.grid_fit import GridFit, across_pairs, along_pairs, nodes
from plisse.layout.rows import RowGeometry

__all__ = ["CURVATURE_SCALE", "InclinationFit"]

CURVATURE_SCALE = 6.5  # a curvature of 1 / (6.5 widths) counts as much as a gap that is wrong by its own width
SMOOTHNESS = 10.0
PREFERENCE = 0.02
BARRIER = 10.0
LEAST_SLOPE = 0.02


class InclinationFit:
    """Minimises (6.5 s (κ_g sin θ − κ_n cos θ))² + 10 s² |∇θ|² over a grid of rows, with |θ| kept below a limit."""

    def __init__(self, shape: tuple[int, int], closed: bool, width: float, limit: float, preferred: float = 0.0,
                 is_ring: bool = False):
        self._width, self._limit, self._preferred = width, limit, preferred
        self._along, self._across = along_pairs(shape, closed), across_pairs(shape, is_ring)
        self._fit = GridFit(shape, closed, [nodes(shape), nodes(shape), nodes(shape), self._along, self._across],
                            is_ring)

    def improved(self, theta: np.ndarray, geometry: RowGeometry, steps: int = 2) -> np.ndarray:
        """Inclinations (n, m) after Gauss–Newton steps from theta (n, m), in radians."""
        scale = CURVATURE_SCALE * self._width
        share = np.sqrt(geometry.steps / self._width)  # equations weigh as much as the area they stand for
        steep = np.sqrt(SMOOTHNESS) / share.ravel()[self._along].mean(axis=1)
        flat = np.sqrt(SMOOTHNESS) * share.ravel()[self._across].mean(axis=1)
        smooth = [np.outer(steep, [-1.0, 1.0]), np.outer(flat, [-1.0, 1.0])]
        for _ in range(steps):
            sine, cosine = np.sin(theta), np.cos(theta)
            slope = scale * (geometry.geodesic * cosine + geometry.normal * sine)
            slope = np.where(np.abs(slope) < LEAST_SLOPE, LEAST_SLOPE, slope)
            beyond = np.sign(theta) * np.maximum(np.abs(theta) - self._limit, 0.0)
            flats = theta.ravel()
            weight = np.sqrt(PREFERENCE) * share
            coefficients = [share * slope, weight, BARRIER * share * (beyond != 0), *smooth]
            residuals = [share * scale * (geometry.geodesic * sine - geometry.normal * cosine),
                         weight * (theta - self._preferred), BARRIER * share * beyond,
                         steep * np.diff(flats[self._along])[:, 0], flat * np.diff(flats[self._across])[:, 0]]
            step = self._fit.solve(coefficients, residuals)
            theta = theta + step * min(1.0, 0.5 / max(float(np.abs(step).max()), 1e-300))
        return np.clip(theta, -1.1 * self._limit, 1.1 * self._limit)

"""Cubic Bézier pieces end to end: the smooth curve through points, as control points of any dimension."""

import numpy as np
from scipy.interpolate import CubicSpline

from plisse.geometry.polyline import arc_length

__all__ = ["bezier_through", "sampled"]


def bezier_through(points: np.ndarray, closed: bool = False) -> np.ndarray:
    """Control points (3k + 1, d) of the cubic spline through points (N, d), k = N − 1, or N for closed curves.

    Curvature is continuous and every third control point is a given one; parameters are chord lengths. Closed
    curves do not repeat their first point, their last control point does.
    """
    path = np.concatenate([points, points[:1]]) if closed else np.asarray(points, dtype=float)
    parameter = arc_length(path)
    ends = "periodic" if closed else "not-a-knot" if len(path) > 3 else "natural"
    velocity = CubicSpline(parameter, path, bc_type=ends)(parameter, 1)
    third = np.diff(parameter)[:, None] / 3
    controls = np.empty((3 * len(path) - 2, path.shape[1]))
    controls[::3] = path
    controls[1::3] = path[:-1] + third * velocity[:-1]
    controls[2::3] = path[1:] - third * velocity[1:]
    return controls


def sampled(controls: np.ndarray, steps: int) -> np.ndarray:
    """Points (steps · k + 1, d) along k pieces, at equal parameters in each."""
    t = np.arange(steps)[:, None, None] / steps
    a, b, c, d = (controls[k:len(controls) - 3 + k:3] for k in range(4))
    inside = (1 - t) ** 3 * a + 3 * (1 - t) ** 2 * t * b + 3 * (1 - t) * t**2 * c + t**3 * d
    return np.concatenate([inside.swapaxes(0, 1).reshape(-1, controls.shape[1]), controls[-1:]])

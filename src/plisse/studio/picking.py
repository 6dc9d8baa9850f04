"""Where a ray meets a mesh: a click on a surface as a point of it."""

import numpy as np

from plisse.geometry.vectors import dot

__all__ = ["first_hit"]


def first_hit(points: np.ndarray, triangles: np.ndarray, origin: np.ndarray, direction: np.ndarray) -> np.ndarray | None:
    """The nearest point (3,) in which a ray meets triangles (T, 3) over points (N, 3), None where it meets none."""
    a, b, c = (points[triangles[:, k]].astype(float) for k in range(3))
    across = np.cross(direction, c - a)
    size = dot(b - a, across)
    with np.errstate(divide="ignore", invalid="ignore"):
        first = dot(origin - a, across) / size
        turned = np.cross(origin - a, b - a)
        second = turned @ direction / size
        distance = dot(c - a, turned) / size
        meets = (first >= 0) & (second >= 0) & (first + second <= 1) & (distance > 0)
    if not meets.any():
        return None
    return origin + float(distance[meets].min()) * direction

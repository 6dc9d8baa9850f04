"""Whether a flat shape fits a rectangle when it may be turned."""

import numpy as np

__all__ = ["angle_that_fits", "extents"]

SAMPLES = 180


def extents(points: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Width and height (A, 2) of the points (N, 2) turned by each of the angles (A,) in radians."""
    cos, sin = np.cos(angles), np.sin(angles)
    x = points @ np.stack([cos, -sin])
    y = points @ np.stack([sin, cos])
    return np.stack([np.ptp(x, axis=0), np.ptp(y, axis=0)], axis=1)


def angle_that_fits(points: np.ndarray, width: float, height: float) -> float | None:
    """The angle in [0, π) by which the points (N, 2) lie flattest in a rectangle, or None where they do not fit.

    Tried are the directions in which an edge of the hull lies along a side, and every degree.
    """
    hull = _hull(points)
    sides = np.roll(hull, -1, axis=0) - hull
    along = -np.arctan2(sides[:, 1], sides[:, 0])
    angles = np.mod(np.concatenate([along, along + np.pi / 2, np.linspace(0, np.pi, SAMPLES, endpoint=False)]), np.pi)
    size = extents(hull, angles)
    slack = 1e-9 * max(width, height)
    good = np.flatnonzero((size[:, 0] <= width + slack) & (size[:, 1] <= height + slack))
    return float(angles[good[np.argmin(size[good, 1])]]) if len(good) else None


def _hull(points: np.ndarray) -> np.ndarray:
    """Corners (H, 2) of the convex hull."""
    from shapely import MultiPoint, get_coordinates

    return get_coordinates(MultiPoint(points).convex_hull)

"""Convex solids that run into each other, found by separating axes."""

import numpy as np
import shapely

from plisse.geometry.vectors import unit

__all__ = ["ConvexSolids"]

CHUNK = 4000


class ConvexSolids:
    """Prismatic convex solids between `lower` and `upper` (N, k, 3): outlines of equal sense, padded by repeated corners.

    Walls join edge j of the lower outline to edge j of the upper one and are plane.
    """

    def __init__(self, lower: np.ndarray, upper: np.ndarray):
        self._corners = np.concatenate([lower, upper], axis=1)
        along, up = np.roll(lower, -1, axis=1) - lower, upper - lower
        caps = np.cross(lower[:, 2] - lower[:, 0], lower[:, 3] - lower[:, 1])[:, None]
        outer = np.roll(upper, -1, axis=1) - upper
        walls = np.cross(np.where((along**2).sum(-1, keepdims=True) > 0, along, outer), up)
        self._normals = unit(np.concatenate([caps, walls], axis=1))
        self._edges = unit(np.concatenate([along, up], axis=1))

    def near(self) -> np.ndarray:
        """Pairs (P, 2) whose bounding boxes meet."""
        low, high = self._corners.min(axis=1), self._corners.max(axis=1)
        boxes = shapely.box(low[:, 0], low[:, 1], high[:, 0], high[:, 1])
        a, b = shapely.STRtree(boxes).query(boxes)
        keep = (a < b) & (low[a, 2] <= high[b, 2]) & (low[b, 2] <= high[a, 2])
        return np.stack([a[keep], b[keep]], axis=1)

    def overlapping(self, pairs: np.ndarray, tolerance: float) -> np.ndarray:
        """Those of the pairs (P, 2) that penetrate each other by more than `tolerance` along every axis."""
        found = [self._overlapping(pairs[k:k + CHUNK], tolerance) for k in range(0, len(pairs), CHUNK)]
        return np.concatenate([np.empty((0, 2), np.int64), *found])

    def _overlapping(self, pairs: np.ndarray, tolerance: float) -> np.ndarray:
        a, b = pairs.T
        pairs = pairs[self._penetration(a, b, np.concatenate([self._normals[a], self._normals[b]], axis=1)) > tolerance]
        a, b = pairs.T
        first, second = self._edges[a], self._edges[b]
        axes = np.cross(first[:, :, None], second[:, None]).reshape(len(pairs), first.shape[1] * second.shape[1], 3)
        return pairs[self._penetration(a, b, axes) > tolerance]

    def _penetration(self, a: np.ndarray, b: np.ndarray, axes: np.ndarray) -> np.ndarray:
        """Smallest depth (P,) over axes (P, n, 3); axes of parallel edges say nothing."""
        length = np.sqrt((axes**2).sum(-1))
        axes = np.divide(axes, length[..., None], where=length[..., None] > 1e-6, out=np.zeros_like(axes))
        one = self._corners[a] @ axes.swapaxes(1, 2)
        other = self._corners[b] @ axes.swapaxes(1, 2)
        depth = np.minimum(one.max(1) - other.min(1), other.max(1) - one.min(1))
        return np.where(length > 1e-6, depth, np.inf).min(axis=1)

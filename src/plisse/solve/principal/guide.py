"""Guiding polylines: closest points, and distances that ignore sliding along the guide."""

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.components import cross, dot

__all__ = ["Guide", "nearest_on_rulings", "off_tangent"]

_FAR = 1e9


class Guide:
    """A polyline (3, n) whose end edges go on straight, so that longer creases have somewhere to be near."""

    def __init__(self, points: np.ndarray, closed: bool = False):
        self.points = np.concatenate([points[:, -2:], points, points[:, :2]], axis=1) if closed else points
        self._edges = np.diff(self.points, axis=1)
        self._square = dot(self._edges, self._edges)
        self._tree = cKDTree(self.points.T)

    def feet(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Closest points (3, k) and unit directions (3, k) of the guide, on edges at the nearest vertex."""
        _, vertex = self._tree.query(np.nan_to_num(points.T, nan=0.0, posinf=_FAR, neginf=-_FAR))
        last = self._edges.shape[1] - 1
        before = self._on_edge(points, np.clip(vertex - 1, 0, last))
        after = self._on_edge(points, np.clip(vertex, 0, last))
        closer = after[2] < before[2]
        foot, edge = (np.where(closer, a, b) for a, b in zip(after[:2], before[:2], strict=True))
        return foot, edge / np.sqrt(dot(edge, edge))

    def _on_edge(self, points: np.ndarray, edge: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Closest point, direction and squared distance, for one edge per point."""
        start, along = self.points[:, edge], self._edges[:, edge]
        part = dot(points - start, along) / self._square[edge]
        low = np.where(edge == 0, -_FAR, 0.0)
        high = np.where(edge == self._edges.shape[1] - 1, _FAR, 1.0)
        foot = start + np.clip(part, low, high) * along
        return foot, along, dot(points - foot, points - foot)


def off_tangent(points: np.ndarray, foot: np.ndarray, tangent: np.ndarray) -> np.ndarray:
    """Offsets (3, B, n) of points from the straight lines through foot (3, n) along tangent (3, n)."""
    offset = points - foot[:, None]
    return offset - dot(offset, tangent[:, None]) * tangent[:, None]


def nearest_on_rulings(points: np.ndarray, rulings: np.ndarray, foot: np.ndarray,
                       tangent: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Signed distance of each ruling from the line (foot, tangent), and where on it that is: (B, n)."""
    lines = np.broadcast_to(tangent[:, None], rulings.shape)
    normal = cross(rulings, lines)
    square = dot(normal, normal)
    offset = foot[:, None] - points
    return dot(offset, normal) / np.sqrt(square), dot(cross(offset, lines), normal) / square

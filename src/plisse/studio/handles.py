"""Control points of the seed curve as handles: click one, pull its arrows."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from plisse.draw import colours
from plisse.recipe import Points, Recipe, Spline
from plisse.studio.paper import ink_bytes

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["MOST_POINTS", "Handles", "control_points_of", "snapped", "with_point_after", "without_point"]

MOST_POINTS = 40
PLANES = {"xy": 2, "xz": 1, "yz": 0}


def control_points_of(recipe: Recipe) -> np.ndarray | None:
    """The points (N, 3) that can be pulled; None where the curve has none, or so many that it is a measurement."""
    curve = getattr(recipe, "curve", None)
    if not isinstance(curve, Spline | Points) or curve.points is None or len(curve.points) > MOST_POINTS:
        return None
    return np.array(curve.points, dtype=float)


def with_point_after(points: np.ndarray, index: int, closed: bool) -> np.ndarray:
    """The points with one more between number `index` and its follower, or beyond the end of an open curve."""
    if index == len(points) - 1 and not closed:
        return np.concatenate([points, [2 * points[-1] - points[-2]]])
    middle = 0.5 * (points[index] + points[(index + 1) % len(points)])
    return np.insert(points, index + 1, middle, axis=0)


def without_point(points: np.ndarray, index: int) -> np.ndarray:
    """The points without number `index`."""
    return np.delete(points, index, axis=0)


def snapped(points: np.ndarray, plane: str) -> np.ndarray:
    """The points moved into the coordinate plane (xy, xz or yz) through their mean."""
    out, axis = points.copy(), PLANES[plane]
    out[:, axis] = points[:, axis].mean()
    return out


class Handles:
    """Balls on the control points and arrows on the chosen one; `moved(index, position)` is called while it is pulled."""

    def __init__(self, client: ClientHandle, moved: Callable[[int, np.ndarray], None], chosen: Callable[[int], None]):
        self._client, self._moved, self._chosen = client, moved, chosen
        self._balls: list = []
        self.arrows: Any = None
        self._points = np.empty((0, 3))
        self.index = 0
        self.is_pulled = False

    def show(self, points: np.ndarray | None, size: float, visible: bool) -> None:
        """Put balls of a size that fits on the points; None for none."""
        wanted = points if points is not None and visible else np.empty((0, 3))
        with self._client.atomic():
            if len(wanted) != len(self._balls):
                self._make(wanted, size)
            for ball, point in zip(self._balls, wanted, strict=True):
                ball.position = point
            self._points = wanted
            self._place_arrows(size)

    def choose(self, index: int) -> None:
        """Put the arrows on another point."""
        self.index = index
        if self.arrows is not None and index < len(self._points):
            self.arrows.position = self._points[index]

    def _make(self, points: np.ndarray, size: float) -> None:
        for ball in self._balls:
            ball.remove()
        ink = ink_bytes(colours.INK)
        self._balls = []
        for k, point in enumerate(points):
            ball = self._client.scene.add_icosphere(f"/points/{k}", 0.02 * size, ink, position=point, cast_shadow=False)
            ball.on_click(self._clicked(k))
            self._balls.append(ball)

    def _clicked(self, index: int):
        async def clicked(_event) -> None:
            self.choose(index)
            self._chosen(index)

        return clicked

    def _place_arrows(self, size: float) -> None:
        if not len(self._points):
            if self.arrows is not None:
                self.arrows.remove()
                self.arrows = None
            return
        self.index = min(self.index, len(self._points) - 1)
        if self.arrows is None:
            self.arrows = self._client.scene.add_transform_controls(
                "/arrows", scale=0.3 * size, disable_rotations=True, depth_test=False,
                translation_limits=((-1e9, 1e9), (-1e9, 1e9), (-1e9, 1e9)), position=self._points[self.index])
            self.arrows.on_update(self._pulled)
        elif not self.is_pulled:
            self.arrows.position = self._points[self.index]

    async def _pulled(self, event) -> None:
        self.is_pulled = event.phase != "end"
        self._moved(self.index, np.array(event.target.position))

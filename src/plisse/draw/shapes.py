"""What a flat drawing is made of: polylines, splines, arcs and words, in millimetres with y upwards."""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from plisse.geometry.bezier import sampled

__all__ = ["Arc", "Bulged", "Line", "Shape", "Spline", "Text", "straight_controls"]


@dataclass(frozen=True, eq=False)
class Line:
    """Points (N, 2) in millimetres; closed lines do not repeat the first."""

    points: np.ndarray
    closed: bool = False

    @property
    def path(self) -> np.ndarray:
        """The points with the first repeated at the end of closed lines."""
        return np.concatenate([self.points, self.points[:1]]) if self.closed else self.points

    @property
    def length(self) -> float:
        """Length in millimetres."""
        return _length(self.path)


@dataclass(frozen=True, eq=False)
class Spline:
    """Cubic Bézier pieces end to end: `controls` (3k + 1, 2) in millimetres, every third one a joint.

    A closed spline ends in its first control point.
    """

    controls: np.ndarray
    closed: bool = False

    @property
    def path(self) -> np.ndarray:
        """Points (16k + 1, 2) along the curve."""
        return sampled(self.controls, 16)

    @property
    def length(self) -> float:
        """Length in millimetres, to about 1e-6 of it."""
        return _length(sampled(self.controls, 64))


@dataclass(frozen=True, eq=False)
class Arc:
    """A circular arc counterclockwise from angle `start` to `end` (radians, start < end ≤ start + 2π)."""

    centre: tuple[float, float]
    radius: float
    start: float
    end: float

    @property
    def is_circle(self) -> bool:
        """Whether the arc goes all the way round."""
        return self.end - self.start >= 2 * np.pi - 1e-12

    @property
    def controls(self) -> np.ndarray:
        """The arc as cubic Bézier pieces of at most 10 degrees (3k + 1, 2): 1e-9 radii from it."""
        pieces = max(1, int(np.ceil((self.end - self.start) / np.radians(10))))
        angle = np.linspace(self.start, self.end, pieces + 1)
        reach = 4 / 3 * np.tan((self.end - self.start) / pieces / 4)
        radial = np.stack([np.cos(angle), np.sin(angle)], axis=1)
        along = reach * np.stack([-np.sin(angle), np.cos(angle)], axis=1)
        controls = np.empty((3 * pieces + 1, 2))
        controls[::3] = radial
        controls[1::3], controls[2::3] = radial[:-1] + along[:-1], radial[1:] - along[1:]
        return np.array(self.centre) + self.radius * controls

    @property
    def path(self) -> np.ndarray:
        """Points (N, 2) along the arc, one every 3 degrees or closer."""
        return sampled(self.controls, 4)

    @property
    def length(self) -> float:
        """Length in millimetres."""
        return self.radius * (self.end - self.start)


@dataclass(frozen=True, eq=False)
class Bulged:
    """A closed line of arcs and straight stretches: from each of the points (N, 2) to the next one, the last to the first.

    `bulges` (N,) are tangents of a quarter of what stretches turn by, positive to the left and 0 for straight ones.
    """

    points: np.ndarray
    bulges: np.ndarray
    closed = True

    @property
    def radii(self) -> np.ndarray:
        """Radius (N,) of every stretch in millimetres; infinite for straight ones."""
        chord = np.hypot(*(np.roll(self.points, -1, axis=0) - self.points).T)
        sine = np.abs(np.sin(2 * np.arctan(self.bulges)))
        return np.divide(chord, 2 * sine, where=sine > 0, out=np.full(len(chord), np.inf))

    @property
    def controls(self) -> np.ndarray:
        """The line as cubic Bézier pieces (3k + 1, 2), of at most 10 degrees each on arcs."""
        ends = np.roll(self.points, -1, axis=0)
        pieces = [self._stretch(*stretch) for stretch in zip(self.points, ends, self.bulges, self.radii, strict=True)]
        return np.concatenate([self.points[:1], *(piece[1:] for piece in pieces)])

    @property
    def path(self) -> np.ndarray:
        """Points (N, 2) along the line, on arcs one every 3 degrees or closer; the first is repeated at the end."""
        return sampled(self.controls, 4)

    @property
    def length(self) -> float:
        """Length in millimetres."""
        chord = np.hypot(*(np.roll(self.points, -1, axis=0) - self.points).T)
        half = 2 * np.arctan(np.abs(self.bulges))
        return float((chord / np.sinc(half / np.pi)).sum())

    @staticmethod
    def _stretch(a: np.ndarray, b: np.ndarray, bulge: float, radius: float) -> np.ndarray:
        """Controls (3k + 1, 2) of one stretch."""
        if bulge == 0:
            return straight_controls(np.array([a, b]))
        chord = b - a
        centre = (a + b) / 2 + (1 - bulge**2) / (4 * bulge) * np.array([-chord[1], chord[0]])
        first = a if bulge > 0 else b
        start = float(np.arctan2(*(first - centre)[::-1]))
        controls = Arc((float(centre[0]), float(centre[1])), radius, start, start + 4 * abs(np.arctan(bulge))).controls
        return controls if bulge > 0 else controls[::-1]


@dataclass(frozen=True)
class Text:
    """Words whose capitals are `height` millimetres high, turned by `angle` radians about their anchor `at`."""

    words: str
    at: tuple[float, float]
    height: float = 3.0
    angle: float = 0.0
    anchor: Literal["start", "middle", "end"] = "start"

    @property
    def font_size(self) -> float:
        """Size in millimetres of a sans-serif font with capitals of that height."""
        return self.height / 0.718


Shape = Line | Spline | Arc | Bulged


def straight_controls(points: np.ndarray) -> np.ndarray:
    """A polyline (N, 2) as straight Bézier pieces (3N − 2, 2)."""
    step = np.diff(points, axis=0)[:, None]
    along = points[:-1, None] + step * np.array([0.0, 1 / 3, 2 / 3])[:, None]
    return np.concatenate([along.reshape(-1, 2), points[-1:]])


def _length(path: np.ndarray) -> float:
    return float(np.hypot(*np.diff(path, axis=0).T).sum())

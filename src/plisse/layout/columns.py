"""Columns across rows along orthogonal trajectories, and the zigzag over the net of both (§3.3, Fig. 11)."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.interpolate import CubicSpline

from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.rows import ChartedSurface, Rows, along, following, lifted, preceding

__all__ = ["Net", "woven"]

FEWEST, MOST = 24, 400
NEWTON_STEPS = 5


@dataclass(frozen=True, eq=False)
class Net:
    """Rows crossed with columns on a surface: `points`, `normals`, `outward` (n, m, 3), inclinations `theta` (n, m).

    `gaps` (n−1, m) are the distances between rows along columns; in a ring, where the first row follows the last, (n, m).
    The points are the reference of the structure: the zigzag leaves them by the amplitude, the first crease `above` or
    below.
    """

    points: np.ndarray
    normals: np.ndarray
    outward: np.ndarray
    theta: np.ndarray
    gaps: np.ndarray
    closed: bool
    above: bool = False
    is_ring: bool = False

    @property
    def shape(self) -> tuple[int, int]:
        """Creases and columns."""
        return self.theta.shape[0], self.theta.shape[1]

    def shifted(self, surface: ChartedSurface, amplitude: float) -> "Net":
        """The net with every row moved by a quarter of s1 − s2, so that strips mirror in their creases (Fig. 11)."""
        shift = self._sides * mirror_shift(self._row_gaps(), self.theta, amplitude)
        moved = self.points + shift[..., None] * self.outward
        points = surface.project(moved.reshape(-1, 3))
        positions, normals = (part.reshape(*self.shape, 3) for part in (points.positions, points.normals))
        outward = _outward(positions, normals, self.closed, self.outward)
        return replace(self, points=positions, normals=normals, outward=outward)

    def zigzag(self, amplitude: float) -> np.ndarray:
        """Crease points (n, m, 3): rows moved off the surface in turn, by ±d (cos θ n + sin θ m)."""
        cosine, sine = np.cos(self.theta)[..., None], np.sin(self.theta)[..., None]
        direction = cosine * self.normals + sine * self.outward
        return self.points + amplitude * self._sides[..., None] * direction

    @property
    def _sides(self) -> np.ndarray:
        """−1 and +1 in turn (n, 1)."""
        return np.where((np.arange(len(self.theta)) + self.above) % 2, 1.0, -1.0)[:, None]

    def _row_gaps(self) -> np.ndarray:
        """Mean distance (n, m) from each row to its neighbours."""
        first, last = (self.gaps[-1:], self.gaps[:0]) if self.is_ring else (self.gaps[:1], self.gaps[-1:])
        padded = np.concatenate([first, self.gaps, last])
        return 0.5 * (padded[1:] + padded[:-1])


def mirror_shift(gaps: np.ndarray, theta: np.ndarray, amplitude: float) -> np.ndarray:
    """(s1 − s2) / 4 for strips with mean width s and sin θ = d (1/s2 − 1/s1); its sign is that of θ."""
    slope = np.abs(np.sin(theta)) / amplitude
    slope = np.maximum(slope, 1e-9 / amplitude)
    falling = (slope * gaps + 1 - np.sqrt((slope * gaps) ** 2 + 1)) / slope
    return np.sign(theta) * (gaps - falling) / 2


def woven(rows: Rows, theta: np.ndarray, surface: ChartedSurface, spacing: float,
          weight: np.ndarray | None = None) -> Net:
    """The net of rows with inclinations theta (n, m) and their orthogonal trajectories, about `spacing` apart.

    Trajectories start evenly spaced on the middle row; `weight` (n,) says how much of each row matters, which moves
    the middle.
    """
    geometry = lifted(surface, rows.places).positions.reshape(*rows.radii.shape, 3)
    fields = np.concatenate([geometry, rows.places - rows.trend(rows.angles), theta[..., None]], axis=-1)
    splines = [_spline(rows, field) for field in fields]
    if rows.is_ring:
        parameters = _around(rows, splines, spacing)
    else:
        parameters = _trajectories(rows, splines, _middle(len(theta), weight), spacing)
    values = np.stack([spline(at) for spline, at in zip(splines, parameters, strict=True)])
    points = lifted(surface, values[..., 3:5] + rows.trend(parameters))
    positions, normals = (part.reshape(*parameters.shape, 3) for part in (points.positions, points.normals))
    radial = np.gradient(positions, axis=0)
    outward = np.cross(along(positions, rows.closed), normals)
    outward = _outward(positions, normals, rows.closed, np.sign(np.median(dot(outward, radial))) * outward)
    gaps = norm(following(positions, rows.is_ring) - preceding(positions, rows.is_ring))
    return Net(positions, normals, outward, values[..., 5], gaps, rows.closed, is_ring=rows.is_ring)


def _outward(positions: np.ndarray, normals: np.ndarray, closed: bool, like: np.ndarray) -> np.ndarray:
    """Unit tangents (n, m, 3) across the rows, on the same side as others."""
    velocity = along(positions, closed)
    outward = unit(np.cross(velocity - dot(velocity, normals)[..., None] * normals, normals))
    return outward * np.sign(np.median(dot(outward, like)))


def _spline(rows: Rows, values: np.ndarray) -> CubicSpline:
    if rows.closed:
        angles = np.append(rows.angles, rows.angles[0] + rows.period)
        return CubicSpline(angles, np.concatenate([values, values[:1]]), bc_type="periodic")
    return CubicSpline(rows.angles, values, bc_type="natural")


def _middle(count: int, weight: np.ndarray | None) -> int:
    if weight is None or weight.sum() == 0:
        return count // 2
    return int(np.clip(np.searchsorted(np.cumsum(weight), 0.5 * weight.sum()), 1, count - 2))


def _trajectories(rows: Rows, splines: list[CubicSpline], middle: int, spacing: float) -> np.ndarray:
    """Angles (n, m') at which orthogonal trajectories meet the rows."""
    end = rows.angles[0] + rows.period if rows.closed else rows.angles[-1]
    dense = np.linspace(rows.angles[0], end, 8 * len(rows.angles) + 1)
    length = np.concatenate([[0.0], np.cumsum(norm(np.diff(splines[middle](dense)[:, :3], axis=0)))])
    count = int(np.clip(length[-1] / spacing, FEWEST, MOST))
    start = np.interp(np.linspace(0, length[-1], count, endpoint=not rows.closed), length, dense)
    longest = 1.5 * float(rows.angles[1] - rows.angles[0])
    angles = np.empty((len(splines), count))
    angles[middle] = start
    for towards in (1, -1):
        row = middle
        while 0 <= row + towards < len(splines):
            angles[row + towards] = _opposite(splines[row], splines[row + towards], angles[row], longest)
            row += towards
    return angles


def _around(rows: Rows, splines: list[CubicSpline], spacing: float) -> np.ndarray:
    """Angles (n, m') of columns around a ring: trajectories from its first row, moved evenly so that they meet again."""
    open_ended = _trajectories(rows, [*splines, splines[0]], 0, spacing)
    fraction = np.linspace(0, 1, len(open_ended))[:, None]
    return (open_ended - fraction * (open_ended[-1] - open_ended[0]))[:-1]


def _opposite(row: CubicSpline, neighbour: CubicSpline, angles: np.ndarray, longest: float) -> np.ndarray:
    """Angles on a neighbouring row whose chords to given points make equal angles with both rows."""
    origin, tangent = row(angles)[:, :3], unit(row(angles, 1)[:, :3])
    found = angles.copy()
    for _ in range(NEWTON_STEPS):
        velocity = neighbour(found, 1)[:, :3]
        speed = norm(velocity)
        both = tangent + velocity / speed[:, None]
        error = dot(neighbour(found)[:, :3] - origin, both)
        found = found - np.clip(error / np.maximum(dot(velocity, both), 0.2 * speed), -longest, longest)
    return found

"""Rows over a surface, as radii about a centre in its chart: where the creases of a whole surface start."""

from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np
from scipy.ndimage import gaussian_filter1d

from plisse.geometry.surface import Surface, SurfacePoints
from plisse.geometry.vectors import dot, norm, unit

__all__ = ["ChartedSurface", "RowGeometry", "Rows", "circles", "column_count", "lifted", "rows_between"]

SECTORS = 72
FEWEST_COLUMNS, MOST_COLUMNS = 32, 120
COLUMN_SPACING = 1.1  # columns while rows are relaxed, in widths


class ChartedSurface(Surface, Protocol):
    """A surface with a chart, continued beyond its boundary."""

    def at(self, places: np.ndarray) -> SurfacePoints:
        """The surface at chart coordinates (N, 2)."""

    def to_plane(self, points: np.ndarray) -> np.ndarray:
        """Chart coordinates and height (N, 3) of points (N, 3)."""

    def to_space(self, coordinates: np.ndarray) -> np.ndarray:
        """Points (N, 3) with given chart coordinates and heights (N, 3)."""


def lifted(surface: ChartedSurface, places: np.ndarray) -> SurfacePoints:
    """The surface at chart coordinates (…, 2), flattened to (N, …)."""
    return surface.at(places.reshape(-1, 2))


@dataclass(frozen=True, eq=False)
class Rows:
    """Curves around `centre` (2,) with `radii` (n, m) at `angles` (m,), in the chart; outward is away from it.

    `spacing` (m,) is the gap wanted between rows at every angle, where that is not the width.
    """

    centre: np.ndarray
    angles: np.ndarray
    radii: np.ndarray
    closed: bool
    spacing: np.ndarray | None = None

    @property
    def places(self) -> np.ndarray:
        """Chart coordinates (n, m, 2)."""
        direction = np.stack([np.cos(self.angles), np.sin(self.angles)], axis=-1)
        return self.centre + self.radii[..., None] * direction

    @property
    def period(self) -> float:
        """After how much angle closed rows come back."""
        return 2 * np.pi

    @property
    def is_ring(self) -> bool:
        """Whether the last row is followed by the first."""
        return False

    def trend(self, angles: np.ndarray) -> np.ndarray:
        """The part of the places (…, 2) that grows steadily along rows: none."""
        return np.zeros((*angles.shape, 2))

    def with_radii(self, radii: np.ndarray) -> Self:
        """The same rays with other radii."""
        return replace(self, radii=radii)

    def moved(self, move: np.ndarray, least: float) -> "Rows":
        """Rows with radii changed by `move` (n, m), the first not below `least`, and no two nearer than that."""
        floor = least * np.arange(len(self.radii))[:, None]
        return self.with_radii(np.maximum.accumulate(np.maximum(self.radii + move - floor, least), axis=0) + floor)


@dataclass(frozen=True, eq=False)
class RowGeometry:
    """How rows (n, m) lie on a surface: `positions`, unit `tangents`, `normals`, `outward` (n, m, 3).

    `geodesic` curvature counts as positive where a row bends towards the centre, `normal` where it bends towards
    the surface normal; `steps` are lengths between columns, `stretch` lengths per unit of radius, across the row.
    """

    positions: np.ndarray
    tangents: np.ndarray
    normals: np.ndarray
    outward: np.ndarray
    geodesic: np.ndarray
    normal: np.ndarray
    steps: np.ndarray
    stretch: np.ndarray
    is_ring: bool = False

    @classmethod
    def of(cls, rows: Rows, surface: ChartedSurface) -> "RowGeometry":
        """The geometry of rows on a surface, by differences along and across them."""
        shape = rows.radii.shape
        points = lifted(surface, rows.places)
        positions, normals = points.positions.reshape(*shape, 3), points.normals.reshape(*shape, 3)
        velocity, acceleration = along(positions, rows.closed), along_twice(positions, rows.closed)
        steps = norm(velocity)
        tangents = unit(velocity - dot(velocity, normals)[..., None] * normals)
        radial = np.gradient(positions, axis=0) / np.gradient(rows.radii, axis=0)[..., None]
        outward = np.cross(tangents, normals)
        outward *= np.sign(np.median(dot(outward, radial)))
        bend = acceleration / np.maximum(steps, 1e-300)[..., None] ** 2
        bending = points.bending.reshape(*shape, 3, 3)
        normal = np.einsum("...i,...ij,...j->...", tangents, bending, tangents)
        return cls(positions, tangents, normals, outward, -dot(bend, outward), normal, steps, dot(radial, outward),
                   rows.is_ring)

    @property
    def gaps(self) -> np.ndarray:
        """Distances (n−1, m) between neighbouring rows, across them; in a ring (n, m)."""
        across = unit(following(self.outward, self.is_ring) + preceding(self.outward, self.is_ring))
        return dot(following(self.positions, self.is_ring) - preceding(self.positions, self.is_ring), across)


def preceding(values: np.ndarray, is_ring: bool) -> np.ndarray:
    """Values (n, …) of the first row of every strip."""
    return values if is_ring else values[:-1]


def following(values: np.ndarray, is_ring: bool) -> np.ndarray:
    """Values (n, …) of the second row of every strip."""
    return np.roll(values, -1, axis=0) if is_ring else values[1:]


def along(values: np.ndarray, closed: bool) -> np.ndarray:
    """First differences along rows, central where possible."""
    if closed:
        return 0.5 * (np.roll(values, -1, axis=1) - np.roll(values, 1, axis=1))
    return np.gradient(values, axis=1)


def along_twice(values: np.ndarray, closed: bool) -> np.ndarray:
    """Second differences along rows; the ends of open rows repeat their neighbours'."""
    middle = np.arange(values.shape[1]) if closed else np.clip(np.arange(values.shape[1]), 1, values.shape[1] - 2)
    count = values.shape[1]
    return values[:, (middle + 1) % count] - 2 * values[:, middle % count] + values[:, (middle - 1) % count]


def circles(surface: ChartedSurface, places: np.ndarray, centre: np.ndarray, width: float, *, pad: float = 2.0,
            hole: float = 2.5) -> Rows:
    """Concentric circles about a centre, `width` apart on average, that cover places (N, 2) and `pad` widths more.

    They close where the places surround the centre, leaving out a disk of `hole` widths.
    """
    offset = places - centre
    radius, angle = np.hypot(*offset.T), np.arctan2(offset[:, 1], offset[:, 0])
    seen = np.bincount(((angle + np.pi) / (2 * np.pi) * SECTORS).astype(int) % SECTORS, minlength=SECTORS) > 0
    closed = bool(seen.all())
    low = max(radius.min() - pad * width, (hole if closed else 0.5) * width)
    high = radius.max() + pad * width
    mean = float(radius.mean())
    if closed:
        columns = column_count(2 * np.pi * mean / width)
        angles = np.arange(columns) * (2 * np.pi / columns) - np.pi
    else:
        first, last = _span(angle, seen)
        first, last = first - pad * width / mean, last + pad * width / mean
        last = min(last, first + 2 * np.pi - 0.02)
        angles = np.linspace(first, last, column_count((last - first) * mean / width))
    inner, outer = np.full(len(angles), low), np.full(len(angles), high)
    return _filled(surface, places, centre, angles, inner, outer, width, closed)


def rows_between(surface: ChartedSurface, inner: np.ndarray, outer: np.ndarray, centre: np.ndarray, width: float, *,
                 parallel: bool = False) -> Rows:
    """Closed rows between two loops (N, 2), (N', 2) in the chart, both seen once around from a centre.

    Rows are interpolated, as many as the mean distance asks for, or `parallel` to the inner loop, going on beyond
    the outer one until it is covered everywhere.
    """
    columns = column_count(2 * np.pi * float(norm(inner - centre).mean() + norm(outer - centre).mean()) / 2 / width)
    angles = np.arange(columns) * (2 * np.pi / columns) - np.pi
    low, high = (gaussian_filter1d(_radii_of(loop - centre, angles), columns / 45, mode="wrap")
                 for loop in (inner, outer))
    reach = 2.5 if parallel else 1.0
    rays = Rows(centre, angles, low + np.linspace(0, reach, 200)[:, None] * (high - low), True)
    lengths = norm(np.diff(lifted(surface, rays.places).positions.reshape(200, -1, 3), axis=0))
    lengths = np.concatenate([np.zeros((1, columns)), np.cumsum(lengths, axis=0)])
    if parallel:
        across = np.array([np.interp(high[k], rays.radii[:, k], lengths[:, k]) for k in range(columns)])
        spacing = np.full(columns, width)
        count = max(int(np.ceil(across.max() / width)) + 1, 5)
    else:
        count = max(round(float(lengths[-1].mean()) / width) + 1, 5)
        spacing = lengths[-1] / (count - 1)
    radii = np.stack([_continued(np.arange(count) * spacing[k], lengths[:, k], rays.radii[:, k])
                      for k in range(columns)], axis=1)
    return Rows(centre, angles, radii, True, spacing)


def _continued(at: np.ndarray, lengths: np.ndarray, radii: np.ndarray) -> np.ndarray:
    """Radii at given lengths along a ray, going on straight beyond its end."""
    return np.interp(at, lengths, radii) + np.maximum(at - lengths[-1], 0.0)


def column_count(widths: float) -> int:
    """How many columns rows get while they are relaxed, for a length in widths."""
    return int(np.clip(widths / COLUMN_SPACING, FEWEST_COLUMNS, MOST_COLUMNS))


def _span(angle: np.ndarray, seen: np.ndarray) -> tuple[float, float]:
    """First and last angle when the circle is cut in the middle of its longest unseen arc."""
    twice = np.tile(~seen, 2)
    run = np.zeros(len(twice), int)
    for k in range(len(twice)):
        run[k] = run[k - 1] + 1 if twice[k] else 0
    end = int(np.argmax(run))
    cut = (end + 1 - run[end] / 2) / SECTORS * 2 * np.pi - np.pi
    turned = (angle - cut) % (2 * np.pi)
    return float(turned.min() + cut), float(turned.max() + cut)


def _radii_of(loop: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Radii (m,) of a loop (N, 2) around the origin at given angles."""
    at = np.arctan2(loop[:, 1], loop[:, 0])
    order = np.argsort(at)
    return np.interp(angles, at[order], np.hypot(*loop[order].T), period=2 * np.pi)


def _filled(surface: ChartedSurface, places: np.ndarray, centre: np.ndarray, angles: np.ndarray, inner: np.ndarray,
            outer: np.ndarray, width: float, closed: bool) -> Rows:
    """Rows between two radii per ray, evenly spaced along the rays, as many as the mean ray asks for."""
    fraction = np.linspace(0, 1, 120)[:, None]
    rays = Rows(centre, angles, inner + fraction * (outer - inner), closed)
    inside = np.clip(rays.places, places.min(axis=0), places.max(axis=0))
    positions = lifted(surface, inside).positions.reshape(len(fraction), -1, 3)
    # where rays leave the box of the places the chart measures them
    lengths = np.maximum(norm(np.diff(positions, axis=0)), norm(np.diff(rays.places, axis=0)))
    mean = np.concatenate([[0.0], np.cumsum(lengths.mean(axis=1))])
    count = max(int(mean[-1] / width) + 1, 5)
    level = np.interp(np.arange(count) * min(width, mean[-1] / (count - 1)), mean, fraction[:, 0])[:, None]
    return rays.with_radii(inner + level * (outer - inner))

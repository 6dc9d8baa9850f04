"""Rows that start straight in a chart: across sheets in any direction, around tubes, or up a tube and all around it."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.parametric import ParametricSurface
from plisse.geometry.vectors import norm
from plisse.layout.automatic import OVERHANG_LIMIT, Sizes, centres
from plisse.layout.rows import RowGeometry, Rows, column_count, lifted

__all__ = ["Straight", "StraightRows", "directions", "straight_and_round"]

PAD = 2.0  # widths by which rows go on beyond the rim
SAMPLES = 100
TURNS = (90, 0, 45, 135, 67.5, 112.5, 22.5, 157.5)  # degrees between rows and the long axis of a sheet
SLANTS = (90, 70, 110, 50, 130)  # degrees between rows going up a tube and its circumference


@dataclass(frozen=True, eq=False)
class StraightRows(Rows):
    """Rows centre + angle · `course` + radius · `across` (2,) in the chart; closed ones close after `circumference`.

    `ring` is the radius after which the family repeats itself, None for open families.
    """

    course: np.ndarray = field(default_factory=lambda: np.array([1.0, 0.0]))
    across: np.ndarray = field(default_factory=lambda: np.array([0.0, 1.0]))
    circumference: float = np.inf
    ring: float | None = None

    @property
    def places(self) -> np.ndarray:
        """Chart coordinates (n, m, 2)."""
        return self.centre + self.trend(self.angles) + self.radii[..., None] * self.across

    @property
    def period(self) -> float:
        """After how much angle closed rows come back."""
        return self.circumference

    @property
    def is_ring(self) -> bool:
        """Whether the last row is followed by the first."""
        return self.ring is not None

    def trend(self, angles: np.ndarray) -> np.ndarray:
        """The part of the places (…, 2) that grows steadily along rows."""
        return angles[..., None] * self.course

    def moved(self, move: np.ndarray, least: float) -> "StraightRows":
        """Rows with other radii; there is no centre to keep away from."""
        return replace(self, radii=self.radii + move)


@dataclass(frozen=True)
class Straight:
    """Rows at an `angle` in radians to the first axis of the chart; 0 goes around tubes."""

    angle: float

    def label(self, surface: ParametricSurface) -> str:
        """What to call such a layout."""
        if surface.period is None:
            return f"straight rows at {np.degrees(self.angle):.4g}° to the long axis"
        if self.angle == 0:
            return "creases around the tube"
        return f"creases up the tube at {np.degrees(self.angle):.4g}°"

    def rows(self, surface: ParametricSurface, width: float, *, inside: bool = False) -> StraightRows:
        """Rows about `width` apart that cover the surface and, unless `inside`, go on beyond its rim."""
        pad = 0.0 if inside else PAD * width
        if surface.period is not None and self.angle != 0:
            return self._up(surface, width, pad)
        course = np.array([np.cos(self.angle), np.sin(self.angle)])
        across = np.array([-course[1], course[0]])
        centre = surface.places.mean(axis=0)
        start, end = _reach(surface.places - centre, course, pad)
        low, high = _reach(surface.places - centre, across, pad)
        if surface.period is not None:
            start, end = 0.0, surface.period
        columns = column_count((end - start) / width)
        angles = np.linspace(start, end, columns, endpoint=surface.period is None)
        rows = StraightRows(centre, angles, np.empty((0, columns)), surface.period is not None, course=course, across=across,
                            circumference=surface.period or np.inf)
        rows = _filled(rows, surface, low, high, width)
        return rows if surface.period is None else _evenly(rows, surface)

    def _up(self, surface: ParametricSurface, width: float, pad: float) -> StraightRows:
        """Rows from one rim to the other, an even number all around."""
        assert surface.period is not None
        low, high = _reach(surface.places, np.array([0.0, 1.0]), pad)
        angles = np.linspace(low, high, column_count((high - low) / np.sin(self.angle) / width))
        course = np.array([1 / np.tan(self.angle), 1.0])
        rows = StraightRows(np.zeros(2), angles, np.zeros((1, len(angles))), False, course=course,
                            across=np.array([1.0, 0.0]), ring=surface.period)
        spacing = surface.period * np.sin(self.angle) / width  # in the chart, whose area is true
        count = max(2 * round(spacing / 2), 6)
        radii = np.arange(count) * (surface.period / count)
        return _evenly(rows.with_radii(np.broadcast_to(radii[:, None], (count, len(angles))).copy()), surface)


def directions(surface: ParametricSurface) -> Iterator[Straight]:
    """Straight rows to try: along and across a sheet and in between; up a tube, steep ones first."""
    for degrees in TURNS if surface.period is None else SLANTS:
        yield Straight(float(np.radians(degrees)))


def straight_and_round(mesh: ReferenceMesh, surface: ParametricSurface, sizes: Sizes,
                       count: int) -> Sequence[tuple[Straight | np.ndarray, Sizes]]:
    """At most `count` ways to start: straight rows over a sheet, then centres; up and around a tube, of several sizes."""
    straight = list(directions(surface))
    if surface.period is None:
        starts: list[Straight | np.ndarray] = [*straight, *centres(mesh, surface, count)]
        return [(start, sizes) for start in starts[:count]]
    return [(start, replace(sizes, width=sizes.width * size, amplitude=sizes.amplitude * size * height, limit=limit))
            for size, height, limit in ((1.0, 1.0, sizes.limit), (1.0, 1.5, OVERHANG_LIMIT), (0.8, 1.5, OVERHANG_LIMIT))
            for start in (*straight, Straight(0.0))][:count]


def _reach(places: np.ndarray, direction: np.ndarray, pad: float) -> tuple[float, float]:
    along = places @ direction
    return float(along.min()) - pad, float(along.max()) + pad


def _filled(rows: StraightRows, surface: ParametricSurface, low: float, high: float, width: float) -> StraightRows:
    """Rows from low to high, `width` apart where that is measured across the middle of the surface."""
    rays = rows.with_radii(np.broadcast_to(np.linspace(low, high, SAMPLES)[:, None], (SAMPLES, len(rows.angles))))
    lengths = norm(np.diff(lifted(surface, rays.places).positions.reshape(SAMPLES, -1, 3), axis=0))
    met = _met(rays, surface)[1:]
    mean = np.where(met.any(axis=1), (lengths * met).sum(axis=1) / np.maximum(met.sum(axis=1), 1), np.diff(rays.radii[:, 0]))
    position = np.concatenate([[0.0], np.cumsum(mean)])
    count = max(int(position[-1] / width) + 1, 5)
    radii = np.interp(np.linspace(0, position[-1], count), position, rays.radii[:, 0])
    return rows.with_radii(np.broadcast_to(radii[:, None], (count, len(rows.angles))).copy())


def _met(rows: StraightRows, surface: ParametricSurface) -> np.ndarray:
    """Where rows lie on the surface itself and not on its continuation (n, m)."""
    return surface.at(rows.places.reshape(-1, 2)).known.reshape(rows.radii.shape)


def _evenly(rows: StraightRows, surface: ParametricSurface) -> StraightRows:
    """The rows, wanting everywhere the mean gap of their column."""
    return replace(rows, spacing=RowGeometry.of(rows, surface).gaps.mean(axis=0))

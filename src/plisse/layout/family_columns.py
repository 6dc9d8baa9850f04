"""From a family of curves to a pattern: columns across it, cropped to a rectangle (§3.3)."""

from dataclasses import replace

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.crossing import Crossing, end_to_end, trajectories
from plisse.layout.family import Family
from plisse.layout.rectangle import GAPS, PROBES, usable_rectangle
from plisse.layout.rows import along
from plisse.layout.stops import Stop
from plisse.structure.pattern import Pattern, interpolate_along

__all__ = ["pattern_of", "placed"]


def pattern_of(family: Family, surface: Surface, amplitude: float, samples: int, *, crop: bool = True,
               gaps: tuple[float, float] = GAPS, ends: bool = False) -> Pattern:
    """Curves with offset directions cos θ n + sin θ m on the largest usable rectangle of a family.

    Without `crop` all curves must be used, and only the columns are chosen. `gaps` are the smallest and the largest
    usable distance between curves, relative to the width of their strip at the guide. With `ends` every curve runs from
    one end on the boundary to the other. Raises Infeasible where too little of the family is usable.
    """
    if ends:
        rows = _rows_between_boundaries(family, gaps, crop)
        part = _part(family, rows)
        crossing = end_to_end(part, samples)
    else:
        rows, start, window = usable_rectangle(family, crop, gaps)
        part = _part(family, rows)
        at = np.linspace(*window, samples, endpoint=not family.closed_curves)
        crossing = trajectories(part, start - rows.start, at)
    points, normals, across = placed(part, surface, crossing, amplitude, rows.start)
    binormals = np.cos(family.theta) * normals + np.sin(family.theta) * across
    if (rows.start + family.above) % 2:  # the first crease of a pattern lies below, this one above: upside down
        binormals = -binormals
    following = np.roll(points, -1, axis=0) if family.closed else points[1:]
    widths = norm(following - points[:len(following)])
    return Pattern(points, binormals, np.full(len(points), family.theta), widths, family.closed_curves, family.closed)


def placed(family: Family, surface: Surface, crossing: Crossing, amplitude: float, first: int = 0,
           smooth: bool = True) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points, normals and directions across (m, n, 3) of a family's curves, the first of which was number `first`.

    Curves are shifted across themselves where local gaps differ from those at the guide, so that strips mirror in their
    creases everywhere. Their directions come from splines, or from differences if they are not `smooth`.
    """
    closed, shape = family.closed_curves, crossing.points.shape
    side = np.where((np.arange(len(crossing.at)) + first + family.above) % 2, 1.0, -1.0)
    shift = side[:, None] * _local_shift(crossing.gaps, side[0], family, amplitude)
    normals = surface.project(crossing.points.reshape(-1, 3)).normals.reshape(shape)
    across = family.side * _across(crossing.points, normals, closed, smooth)
    shifted = surface.project((crossing.points + shift[..., None] * across).reshape(-1, 3))
    points, normals = (field.reshape(shape) for field in (shifted.positions, shifted.normals))
    return points, normals, family.side * _across(points, normals, closed, smooth)


def _part(family: Family, rows: slice) -> Family:
    spacing = family.spacing if family.closed else family.spacing[rows.start:rows.stop - 1]
    return replace(family, curves=family.curves[rows], spacing=spacing, turns=family.turns[rows])


def _rows_between_boundaries(family: Family, gaps: tuple[float, float], crop: bool) -> slice:
    """The longest run of usable curves that end on the boundary on both sides."""
    count = len(family.curves)
    ends = [curve.stop is Stop.BOUNDARY and curve.first_stop in (Stop.BOUNDARY, None) for curve in family.curves]
    relative = end_to_end(family, PROBES).gaps / family.spacing[:, None]
    usable = ((relative > gaps[0]) & (relative < gaps[1])).all(axis=1)
    following = (np.arange(len(usable)) + 1) % count
    usable &= np.array(ends)[:len(usable)] & np.array(ends)[following]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], usable, [False]]).astype(int))).reshape(-1, 2)
    first, last = max(edges.tolist(), key=lambda run: run[1] - run[0], default=(0, 0))
    whole = family.closed or not crop
    if last - first < (len(usable) if whole else 2):
        bad = int(np.argmin(usable))
        stop = next((str(family.curves[k].stop) for k in (bad, following[bad]) if not ends[k]), "their gaps vary too much")
        raise Infeasible(f"curves {bad + 1} and {following[bad] + 1} of {count} cannot be kept from boundary to boundary "
                         f"({stop}); set surface.boundary = false")
    return slice(0, count) if whole else slice(first, last + 1)


def _across(points: np.ndarray, normals: np.ndarray, closed: bool, smooth: bool) -> np.ndarray:
    """Unit tangents m = t × n (m, n, 3) across curves."""
    if smooth:
        parameters = np.linspace(0, 1, points.shape[1], endpoint=not closed)
        velocity = interpolate_along(points, closed)(parameters, 1).swapaxes(0, 1)
    else:
        velocity = along(points, closed)
    return unit(np.cross(velocity - dot(velocity, normals)[..., None] * normals, normals))


def _local_shift(gaps: np.ndarray, first_side: float, family: Family, amplitude: float) -> np.ndarray:
    """Half of what (s1 − s2)/2 lacks (m, n) at every curve, s1 and s2 the strips beside it."""
    if family.closed:
        before, after = np.roll(gaps, 1, axis=0), gaps
    else:
        before, after = np.concatenate([gaps[1:2], gaps]), np.concatenate([gaps, gaps[-2:-1]])
    side = first_side * np.where(np.arange(len(before)) % 2, -1.0, 1.0)[:, None]
    mean, half = 0.5 * (before + after), 0.5 * side * (before - after)  # below (side −1) the strip after it climbs
    slope = max(np.sin(family.theta) / amplitude, 1e-9)
    wanted = (np.sqrt((slope * mean) ** 2 + 1) - 1) / slope
    return 0.5 * (wanted - half)

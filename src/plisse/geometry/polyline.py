"""Polylines: arc length, even sampling, closest points."""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.spatial import cKDTree

from plisse.geometry.vectors import dot, norm, unit

__all__ = ["arc_length", "closest_on_polyline", "closest_on_polylines", "distance_to_polyline", "distance_to_polylines",
           "even_sampler", "interpolating_spline", "sample_evenly", "segments", "tangents"]


def arc_length(points: np.ndarray, closed: bool = False) -> np.ndarray:
    """Length along the polyline at every point (N,), or (N+1,) for closed ones: the last entry is the total."""
    steps = np.diff(np.concatenate([points, points[:1]]) if closed else points, axis=0)
    return np.concatenate([[0.0], np.cumsum(norm(steps))])


def interpolating_spline(points: np.ndarray, closed: bool = False):
    """Quintic spline through the points over [0, 1], parametrised so that its curvature varies least.

    Even parameters suit points that were sampled from a smooth curve, chord lengths suit uneven points; both and
    the compromise between them are tried.
    """
    values = np.concatenate([points, points[:1]]) if closed else points
    chords = norm(np.diff(values, axis=0))
    candidates = []
    for power in (0.0, 0.5, 1.0):
        parameter = np.concatenate([[0.0], np.cumsum(chords**power)])
        candidates.append(_quintic(parameter / parameter[-1], values, closed))
    return min(candidates, key=_curvature_variation)


def _quintic(parameter: np.ndarray, values: np.ndarray, closed: bool):
    if closed:
        return make_interp_spline(parameter, values, k=5 if len(values) > 6 else 3, bc_type="periodic")
    degree = 5 if len(values) > 5 else 3 if len(values) > 3 else len(values) - 1
    return make_interp_spline(parameter, values, k=degree)


def _curvature_variation(spline) -> float:
    """∫ |dκ/ds|² ds along the spline, scale-free."""
    parameter = np.linspace(0, 1, 2001)
    velocity, bend = spline(parameter, 1), spline(parameter, 2)
    speed = norm(velocity)
    curvature = np.cross(velocity, bend) / speed[:, None] ** 3
    step = 0.5 * (speed[1:] + speed[:-1]) * np.diff(parameter)
    return float((dot(d := np.diff(curvature, axis=0), d) / step).sum() * step.sum() ** 3)


def sample_evenly(points: np.ndarray, count: int, closed: bool = False) -> np.ndarray:
    """Points (count, 3) at equal arc lengths along the interpolating spline; closed ones leave out the last."""
    return even_sampler(points, closed)(count)


def even_sampler(points: np.ndarray, closed: bool = False) -> Callable[[int], np.ndarray]:
    """`sample_evenly` of these points for any count, on one spline."""
    spline = interpolating_spline(points, closed)

    @lru_cache(maxsize=2)
    def lengths(steps: int) -> tuple[np.ndarray, np.ndarray]:
        fine = np.linspace(0, 1, steps)
        return fine, arc_length(spline(fine))

    def sampled(count: int) -> np.ndarray:
        fine, length = lengths(max(4000, 10 * count))
        return spline(np.interp(np.linspace(0, length[-1], count, endpoint=not closed), length, fine))

    return sampled


def closest_on_polylines(points: np.ndarray, lines: np.ndarray, closed: bool = False,
                         extended: bool = False) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Start and end (m, n) of the segment of its own line closest to each point (m, n, 3), and the foot's fraction in it.

    Lines are (m, k, 3). Only the two segments at the nearest vertex are tried. `extended` lets feet lie beyond the ends
    of open lines.
    """
    count = lines.shape[1]
    nearest = _nearest(points, lines)
    options = []
    for first in (nearest - 1, nearest):
        start = first % count if closed else np.clip(first, 0, count - 2)
        end = (start + 1) % count
        origin = _picked(lines, start)
        along, offset = _picked(lines, end) - origin, points - origin
        low = np.where((start == 0) & extended & (not closed), -np.inf, 0.0)
        high = np.where((start == count - 2) & extended & (not closed), np.inf, 1.0)
        fraction = np.clip(dot(offset, along) / dot(along, along), low, high)
        gap = offset - fraction[..., None] * along
        options.append((start, end, fraction, dot(gap, gap)))
    nearer = options[0][3] < options[1][3]
    start, end, fraction = (np.where(nearer, a, b) for a, b in zip(options[0][:3], options[1][:3], strict=True))
    return start, end, fraction


def closest_on_polyline(points: np.ndarray, line: np.ndarray, closed: bool = False) -> tuple[np.ndarray, ...]:
    """Start and end (N,) of the segment of one line (k, 3) closest to each point (N, 3), and the foot's fraction in it."""
    return tuple(part[0] for part in closest_on_polylines(points[None], line[None], closed))


def distance_to_polylines(points: np.ndarray, lines: np.ndarray, closed: bool = False) -> np.ndarray:
    """Distances (m, n) of points (m, n, 3) from their own polylines (m, k, 3), open ends extended by their tangents."""
    start, end, fraction = closest_on_polylines(points, lines, closed, extended=True)
    origin = _picked(lines, start)
    return norm(points - origin - fraction[..., None] * (_picked(lines, end) - origin))


def distance_to_polyline(points: np.ndarray, line: np.ndarray, closed: bool = False) -> np.ndarray:
    """Distances (N,) of points (N, 3) from one polyline (k, 3) whose open ends are extended by their tangents."""
    return distance_to_polylines(points[None], line[None], closed)[0]


def _nearest(points: np.ndarray, lines: np.ndarray) -> np.ndarray:
    """Nearest vertex (m, n) of its own line for each point: one tree, lines kept apart along a fourth axis."""
    apart = 4 * (1 + float(max(np.abs(points).max(), np.abs(lines).max())))
    levels = apart * np.arange(len(lines))[:, None, None]
    lifted = [np.concatenate([part, np.broadcast_to(levels, (*part.shape[:2], 1))], axis=2).reshape(-1, 4)
              for part in (points, lines)]
    found = cKDTree(lifted[1], balanced_tree=False, compact_nodes=False).query(lifted[0])[1]
    return found.reshape(points.shape[:2]) % lines.shape[1]


def _picked(lines: np.ndarray, index: np.ndarray) -> np.ndarray:
    """Vertices (m, n, 3) of lines (m, k, 3), each from its own line."""
    return np.take_along_axis(lines, index[..., None], axis=1)


def tangents(points: np.ndarray, closed: bool = False) -> np.ndarray:
    """Unit tangents (…, N, 3) of the circles through three successive points; at open ends those of the end circles."""
    before, after = segments(points, closed)
    inner = unit(before / dot(before, before)[..., None] + after / dot(after, after)[..., None])
    if closed:
        return inner
    rims, ends = unit(np.stack([before[..., 0, :], after[..., -1, :]])), np.stack([inner[..., 0, :], inner[..., -1, :]])
    first, last = (2 * dot(ends, rims)[..., None] * rims - ends)[..., None, :]
    return np.concatenate([first, inner, last], axis=-2)


def segments(points: np.ndarray, closed: bool) -> tuple[np.ndarray, np.ndarray]:
    """Edges (…, N, 3) before and after every point (closed), or every inner point (open)."""
    if closed:
        after = np.roll(points, -1, axis=-2) - points
        return np.roll(after, 1, axis=-2), after
    steps = np.diff(points, axis=-2)
    return steps[..., :-1, :], steps[..., 1:, :]

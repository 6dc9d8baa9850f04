"""Plane polylines as few circular arcs, each within a tolerance of its stretch."""

from typing import NamedTuple

import numpy as np

from plisse.geometry.vectors import cross_flat, norm

__all__ = ["Stretch", "arcs_along", "circle_through"]

STRAIGHTEST = 1e5


class Stretch(NamedTuple):
    """Points `first` to `last` of a polyline as one arc about `centre` of signed `radius` (positive turns left).

    A straight stretch has radius infinity. `deviation` is the largest distance of its vertices and edge middles.
    """

    first: int
    last: int
    centre: np.ndarray
    radius: float
    deviation: float


def circle_through(a: np.ndarray, b: np.ndarray, c: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Centres (…, 2) and signed radii (…) of circles through three points (…, 2) each; infinite where they are in line."""
    u, v = b - a, c - a
    doubled = 2 * cross_flat(u, v)
    size = np.maximum(norm(u), norm(v))
    straight = np.abs(doubled) * STRAIGHTEST <= size**2 * 4
    safe = np.where(straight, 1.0, doubled)[..., None]
    offset = (norm(u)[..., None]**2 * np.stack([v[..., 1], -v[..., 0]], -1)
              - norm(v)[..., None]**2 * np.stack([u[..., 1], -u[..., 0]], -1)) / safe
    return a + offset, np.where(straight, np.inf, np.sign(doubled) * norm(offset))


def arcs_along(points: np.ndarray, tolerance: float) -> list[Stretch]:
    """Stretches that follow a polyline (N, 2) from end to end, each as long as the tolerance allows.

    Vertices and middles of edges are within the tolerance; where no arc is, single edges stay straight.
    """
    out, at = [], 0
    while at < len(points) - 1:
        best = Stretch(at, at + 1, points[at], np.inf, 0.0)
        step = 1
        while step:
            last = min(best.last + step, len(points) - 1)
            trial = _stretch(points, at, last) if last > best.last else None
            if trial is not None and trial.deviation <= tolerance:
                best, step = trial, 2 * step
            else:
                step //= 2
        out.append(best)
        at = best.last
    return out


def _stretch(points: np.ndarray, first: int, last: int) -> Stretch:
    """The arc or line through both ends and the middle of a stretch."""
    part = points[first:last + 1]
    middle = part[len(part) // 2] if len(part) > 2 else part.mean(axis=0)
    centre, radius = circle_through(part[0], middle, part[-1])
    probes = np.concatenate([part, (part[1:] + part[:-1]) / 2])
    chord = part[-1] - part[0]
    if np.isinf(radius):
        if norm(chord) == 0:
            return Stretch(first, last, centre, np.inf, np.inf)
        away = np.abs(cross_flat(probes - part[0], chord)) / norm(chord)
    else:
        away = np.abs(norm(probes - centre) - abs(radius))
        turn = np.diff(np.unwrap(np.arctan2(*(part - centre).T[::-1])))
        if (np.sign(turn) != np.sign(radius)).any() or np.abs(turn.sum()) > 1.9 * np.pi:
            return Stretch(first, last, centre, float(radius), np.inf)
    return Stretch(first, last, centre, float(radius), float(away.max()))

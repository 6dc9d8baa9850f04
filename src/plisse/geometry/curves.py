"""Seed curves of every kind a design can name, sampled at equal arc lengths."""

from collections.abc import Callable
from functools import lru_cache, singledispatch

import numpy as np

from plisse.errors import InvalidDesign
from plisse.geometry.frames import curvature
from plisse.geometry.polyline import arc_length, even_sampler
from plisse.geometry.smooth import smoothed_polyline
from plisse.recipe import Arc, Ellipse, Helix, Points, Spline, TorusKnot

__all__ = ["seed_curve", "seed_sampler"]

FINE = 600


def seed_curve(curve, count: int) -> np.ndarray:
    """Points (count, 3) at equal arc lengths; closed curves leave out the last.

    Raises InvalidDesign for straight curves: without curvature there is no side to evolve to.
    """
    return seed_sampler(curve)(count)


def seed_sampler(curve) -> Callable[[int], np.ndarray]:
    """`seed_curve` of one curve for any count."""
    points = np.ascontiguousarray(control_points(curve), dtype=float)
    evenly = _sampler(points.tobytes(), points.shape, curve.closed)

    def sampled(count: int) -> np.ndarray:
        points = evenly(count)
        turn = curvature(points, curve.closed).mean() * arc_length(points, curve.closed)[-1]
        if turn < 1e-4:
            raise InvalidDesign(f"the seed curve turns by {np.degrees(turn):.2g}° in all, so it is practically straight; "
                                "give a curve that bends, for pleats follow its principal normals")
        return points

    return sampled


@lru_cache(maxsize=4)
def _sampler(points: bytes, shape: tuple[int, ...], closed: bool) -> Callable[[int], np.ndarray]:
    """The last few curves are kept: who changes an angle or a width leaves the curve as it is."""
    return even_sampler(np.frombuffer(points).reshape(shape), closed)


@singledispatch
def control_points(curve) -> np.ndarray:
    """Points (N, 3) through which the seed runs."""
    raise TypeError(f"no seed curve of type {type(curve).__name__}")


@control_points.register
def _(curve: Arc) -> np.ndarray:
    half = np.radians(curve.angle) / 2
    angle = np.linspace(-half, half, FINE, endpoint=not curve.closed)
    return curve.radius * np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


@control_points.register
def _(curve: Helix) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi * curve.turns, int(np.ceil(FINE * max(1, curve.turns))))
    return np.stack([curve.radius * np.cos(angle), curve.radius * np.sin(angle),
                     curve.pitch * angle / (2 * np.pi)], axis=1)


@control_points.register
def _(curve: Ellipse) -> np.ndarray:
    half = np.radians(curve.angle) / 2
    angle = np.linspace(-half, half, FINE, endpoint=not curve.closed)
    return np.stack([curve.a * np.cos(angle), curve.b * np.sin(angle), 0 * angle], axis=1)


@control_points.register
def _(curve: TorusKnot) -> np.ndarray:
    angle = np.linspace(0, 2 * np.pi, FINE * max(curve.p, curve.q), endpoint=not curve.closed)
    around, tube = curve.p * angle, curve.q * angle
    ring = curve.R + curve.r * np.cos(tube)
    height = curve.r if curve.rz is None else curve.rz
    return np.stack([ring * np.cos(around), ring * np.sin(around), height * np.sin(tube)], axis=1)


@control_points.register
def _(curve: Spline) -> np.ndarray:
    return _without_repeated_end(curve)


@control_points.register
def _(curve: Points) -> np.ndarray:
    return smoothed_polyline(_without_repeated_end(curve), curve.smooth, curve.closed)


def _without_repeated_end(curve: Spline | Points) -> np.ndarray:
    points = np.array(curve.points, dtype=float)
    return points[:-1] if curve.closed and np.array_equal(points[0], points[-1]) else points

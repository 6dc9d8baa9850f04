"""Evolution of pseudo-geodesics from a seed curve (§3.2, Figs 14, 16 and 27).

Seen from far, a small change w of the curve along its binormal obeys w_t = cosθ · w″ / κ: evolution is parabolic.
Explicit steps therefore need a binormal that is smooth over a length that does not depend on the resolution.
"""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.frames import curvature, regularised_frame
from plisse.geometry.polyline import arc_length
from plisse.geometry.vectors import dot, norm
from plisse.structure.pattern import Pattern

__all__ = ["default_smoothing", "evolution_nodes", "evolve", "refuse_collapse"]

STEPS_PER_STRIP = 8
SMALLEST_STRETCH = 0.005


def evolve(seed: np.ndarray, theta: np.ndarray, widths: np.ndarray, *, closed: bool = False,
           smoothing: float | None = None, steps: int | None = None) -> Pattern:
    """Pattern of m pseudo-geodesics that starts with the seed (n, 3), inclined by θ (m,) in radians.

    `widths` (m−1, n) are distances between successive curves, `smoothing` the length ℓ of the binormals in units
    of the seed's length. Midpoint steps of ∂v/∂t = cosθ e2 + sinθ e3, the formula of Fig. 14.
    Raises Infeasible with crease, place and remedy where the pattern collapses.
    """
    length = arc_length(seed, closed)[-1]
    if not curvature(seed, closed).max() * length > 1e-9:
        raise Infeasible("the seed curve is straight and has no side to evolve to; start from a bent curve")
    smooth = (default_smoothing(seed, closed) if smoothing is None else smoothing) * length
    curves, binormals = [seed], [regularised_frame(seed, closed, smooth).binormal]
    points = seed
    for strip, width in enumerate(widths):
        count = steps or _step_count(points, width, closed)
        for k in range(count):
            inclination = theta[strip] + (k + 0.5) / count * (theta[strip + 1] - theta[strip])
            before, points = points, _midpoint_step(points, width / count, inclination, closed, smooth)
            refuse_collapse(points, before, seed, strip + 1, closed)
        curves.append(points)
        binormals.append(regularised_frame(points, closed, smooth).binormal)
    return Pattern(np.array(curves), np.array(binormals), np.asarray(theta, float), widths, closed)


def default_smoothing(seed: np.ndarray, closed: bool) -> float:
    """Length over which binormals are smoothed, as a fraction of the seed's length."""
    total_turn = curvature(seed, closed).mean() * arc_length(seed, closed)[-1]
    return float(min(0.15, 0.5 / total_turn))


def evolution_nodes(seed: np.ndarray, closed: bool) -> int:
    """Number of points that resolve the evolution of a seed, whatever number is sampled afterwards."""
    total_turn = curvature(seed, closed).mean() * arc_length(seed, closed)[-1]
    return int(np.clip(10 * total_turn, 60, 400))


def _step_count(points: np.ndarray, width: np.ndarray, closed: bool) -> int:
    return int(np.clip(np.ceil(40 * (width * curvature(points, closed)).max()), STEPS_PER_STRIP, 80))


def _midpoint_step(points, width, theta, closed, smoothing):
    half = points + 0.5 * width[:, None] * _velocity(points, theta, closed, smoothing)
    return points + width[:, None] * _velocity(half, theta, closed, smoothing)


def _velocity(points: np.ndarray, theta: float, closed: bool, smoothing: float) -> np.ndarray:
    frame = regularised_frame(points, closed, smoothing)
    return np.cos(theta) * frame.principal_normal + np.sin(theta) * frame.binormal


def refuse_collapse(points: np.ndarray, before: np.ndarray, seed: np.ndarray, crease: int, closed: bool) -> None:
    """Raise Infeasible where edges shrink to nothing or turn round: the focal set of the pattern."""
    edges, previous, original = (_edges(curve, closed) for curve in (points, before, seed))
    stretch = np.where(np.isfinite(edges).all(axis=1), dot(edges, previous) / norm(previous) / norm(original), -1.0)
    if stretch.min() < SMALLEST_STRETCH:
        place = 100 * (int(np.argmin(stretch)) + 0.5) / len(edges)
        advice = f"keep pattern.creases to {crease - 1} or less, " if crease > 3 else ""
        raise Infeasible(
            f"the guiding curves run into their centre of curvature: crease {crease + 1} collapses near {place:.0f} % "
            f"of its length; {advice}lower pattern.width, or start from a flatter seed curve")


def _edges(points: np.ndarray, closed: bool) -> np.ndarray:
    return np.roll(points, -1, axis=0) - points if closed else np.diff(points, axis=0)

"""Evolution of pseudo-geodesics from a seed curve (§3.2, Figs 14, 16 and 27).

Seen from far, a small change w of the curve along its binormal obeys w_t = cosθ · w″ / κ: evolution is parabolic.
Explicit steps therefore need a binormal that is smooth over a length that does not depend on the resolution.
"""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry import components
from plisse.geometry.frames import curvature, tangents_and_binormals
from plisse.geometry.polyline import arc_length
from plisse.structure.pattern import Pattern

__all__ = ["default_smoothing", "evolution_nodes", "evolve", "refuse_collapse"]

STEPS_PER_TURN, MOST_STEPS = 5, 80  # patterns are accurate to about 1e-5 amplitudes
SMALLEST_STRETCH = 0.005
MIDDLE = np.array([0.0, 0.5, 1.0])


def evolve(seed: np.ndarray, theta: np.ndarray, widths: np.ndarray, *, closed: bool = False,
           smoothing: float | None = None, steps: int | None = None) -> Pattern:
    """Pattern of m pseudo-geodesics that starts with the seed (n, 3), inclined by θ (m,) in radians.

    `widths` (m−1, n) are distances between successive curves, `smoothing` the length ℓ of the binormals in units
    of the seed's length. Runge–Kutta steps of ∂v/∂t = cosθ e2 + sinθ e3, the formula of Fig. 14.
    Raises Infeasible with crease, place and remedy where the pattern collapses.
    """
    length = arc_length(seed, closed)[-1]
    if not curvature(seed, closed).max() * length > 1e-9:
        raise Infeasible("the seed curve is straight and has no side to evolve to; start from a bent curve")
    smooth = (default_smoothing(seed, closed) if smoothing is None else smoothing) * length
    points = np.ascontiguousarray(seed.T, dtype=float)
    frame = tangents_and_binormals(points, closed, smooth)
    curves, binormals = [points], [frame[1]]
    for strip, width in enumerate(widths):
        count = steps or _step_count(width, frame[2])
        for k in range(count):
            inclinations = theta[strip] + (k + MIDDLE) / count * (theta[strip + 1] - theta[strip])
            try:
                following = _step(points, frame, width / count, inclinations, closed, smooth)
            except Infeasible:  # on the way: the direction at its beginning shows where
                straight = points + width / count * _velocity(frame, inclinations[0])
                refuse_collapse(straight, points, curves[0], strip + 1, closed)
                raise
            refuse_collapse(following, points, curves[0], strip + 1, closed)
            points = following
            frame = tangents_and_binormals(points, closed, smooth)
        curves.append(points)
        binormals.append(frame[1])
    lines, normals = (np.ascontiguousarray(np.array(fields).swapaxes(1, 2)) for fields in (curves, binormals))
    return Pattern(lines, normals, np.asarray(theta, float), widths, closed)


def default_smoothing(seed: np.ndarray, closed: bool) -> float:
    """Length over which binormals are smoothed, as a fraction of the seed's length."""
    total_turn = curvature(seed, closed).mean() * arc_length(seed, closed)[-1]
    return float(min(0.15, 0.5 / total_turn))


def evolution_nodes(seed: np.ndarray, closed: bool) -> int:
    """Number of points that resolve the evolution of a seed, whatever number is sampled afterwards."""
    total_turn = curvature(seed, closed).mean() * arc_length(seed, closed)[-1]
    return int(np.clip(10 * total_turn, 60, 400))


def _step_count(width: np.ndarray, squared_curvature: np.ndarray) -> int:
    """Number of steps across a strip: more where it comes near the centre of curvature and bends more and more."""
    turn = float((width * np.sqrt(squared_curvature)).max())
    return int(np.clip(np.ceil(STEPS_PER_TURN * turn / max(1 - turn, 1 / STEPS_PER_TURN)), 1, MOST_STEPS))


def _step(points: np.ndarray, frame: tuple[np.ndarray, ...], width: np.ndarray, theta: np.ndarray, closed: bool,
          smoothing: float) -> np.ndarray:
    """Points (3, n) after one classical Runge–Kutta step, for the inclinations at its beginning, middle and end."""
    rate = total = _velocity(frame, theta[0])
    for part, angle, weight in ((0.5, theta[1], 2), (0.5, theta[1], 2), (1.0, theta[2], 1)):
        rate = _velocity(tangents_and_binormals(points + part * width * rate, closed, smoothing), angle)
        total = total + weight * rate
    return points + width / 6 * total


def _velocity(frame: tuple[np.ndarray, ...], theta: float) -> np.ndarray:
    tangent, binormal, _ = frame
    return np.cos(theta) * components.cross(binormal, tangent) + np.sin(theta) * binormal


def refuse_collapse(points: np.ndarray, before: np.ndarray, seed: np.ndarray, crease: int, closed: bool) -> None:
    """Raise Infeasible where edges of points (3, n) shrink to nothing or turn round: the focal set of the pattern."""
    edges, previous, original = (_edges(curve, closed) for curve in (points, before, seed))
    least = np.sqrt(components.dot(previous, previous) * components.dot(original, original)) * SMALLEST_STRETCH
    excess = components.dot(edges, previous) - least
    if not (excess >= 0).all():
        place = 100 * (int(np.argmin(excess)) + 0.5) / len(excess)
        advice = f"keep pattern.creases to {crease - 1} or less, " if crease > 3 else ""
        raise Infeasible(
            f"the guiding curves run into their centre of curvature: crease {crease + 1} collapses near {place:.0f} % "
            f"of its length; {advice}lower pattern.width, or start from a flatter seed curve")


def _edges(points: np.ndarray, closed: bool) -> np.ndarray:
    return np.roll(points, -1, axis=1) - points if closed else points[:, 1:] - points[:, :-1]

"""Families of pseudo-geodesics of constant inclination, shot from regularly spaced points of a guide (§3.1, Figs 2, 20).

The guide runs along the unit vectors m, curves leave it at an angle (90°: along n × m) to both sides. Their pleats lean
along m: creases are moved off the surface by ±d (cos θ n + sin θ m), so reversing a guide lets them lean the other way.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.polyline import arc_length
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.guides import Guide
from plisse.layout.positions import crease_positions
from plisse.layout.stops import Trace
from plisse.layout.trace import trace

__all__ = ["Family", "fan", "shoot"]

LARGEST_TURN = np.radians(12.0)
TUNING_STEPS = 3
PROBES = 33
NUDGE = 1e-3


@dataclass(frozen=True, eq=False)
class Family:
    """Neighbouring `curves` of inclination `theta` with the widths `spacing` of the strips between them at the guide.

    `closed`: the last curve is followed by the first, and `spacing` has as many entries as there are curves. `turns`
    are the angles in radians by which the starting directions were turned. Curves follow each other along
    side · t × n; the first crease lies `above` the surface or below.
    """

    curves: tuple[Trace, ...]
    theta: float
    spacing: np.ndarray
    closed: bool
    turns: np.ndarray
    side: float = 1.0
    above: bool = False

    @property
    def closed_curves(self) -> bool:
        """Whether every curve returned to where it began."""
        return all(curve.closed for curve in self.curves)

    @cached_property
    def splines(self) -> tuple[CubicSpline, ...]:
        """Curves by their arc length from the guide, periodic where all are closed."""
        return tuple(_spline(curve, self.closed_curves) for curve in self.curves)

    @property
    def ranges(self) -> np.ndarray:
        """First and last arc length (m, 2) of every curve."""
        return np.array([spline.x[[0, -1]] for spline in self.splines])


def shoot(surface: Surface, guide: Guide, *, theta: float, width: float, amplitude: float, creases: int | None = None,
          angle: float = np.pi / 2, tuned: bool = True, length: float | None = None, step: float | None = None,
          beyond: bool = False, above: bool = False) -> Family:
    """The family of inclination theta (radians) that leaves the guide at an angle, at most `length` to each side.

    With `tuned` every starting direction is turned by up to 12° so that gaps along neighbouring curves stay even.
    """
    _check(theta)
    positions, spacing = crease_positions(guide.length, guide.closed, theta=theta, width=width, amplitude=amplitude,
                                          creases=creases, above=above)
    starts, tangents = guide.at(positions)
    at = surface.project(starts)
    along = unit(tangents - dot(tangents, at.normals)[:, None] * at.normals)
    across = np.cross(at.normals, along)
    length = 2 * surface.diagonal if length is None else length
    step = surface.diagonal / 150 if step is None else step

    def traced(turns: np.ndarray, step: float = 2 * step) -> tuple[Trace, ...]:
        c, s = np.cos(angle + turns)[:, None], np.sin(angle + turns)[:, None]
        curves = trace(surface, at.positions, c * along + s * across, theta, length=length, step=step,
                       both=not guide.one_sided, beyond=beyond)
        for index, curve in enumerate(curves):
            if len(curve.points) < 3:
                raise Infeasible(f"curve {index + 1} of {len(curves)} ends at the guide ({curve.stop}): change theta, or "
                                 "cross the surface with another guide")
        return curves

    turns = _tuned(traced, len(starts), spacing, guide.closed) if tuned else np.zeros(len(starts))
    return Family(traced(turns, step), theta, spacing, guide.closed, turns, above=above)


def fan(surface: Surface, point, *, theta: float, creases: int, radius: float, sector: tuple[float, float] | None = None,
        towards=None, side: float = 1.0, length: float | None = None, step: float | None = None,
        beyond: bool = False, above: bool = False) -> Family:
    """Curves of inclination theta (radians) that leave a point in all directions, or in those of a sector (radians).

    Angles are counted about the normal from the direction `towards`. Pleats lean clockwise, seen from above, for the
    side +1, otherwise counterclockwise. Widths are nominal at the distance `radius` from
    the point, where a disk would have them. A full fan is a closed family and needs an even number of creases.
    """
    _check(theta)
    if sector is None and (creases % 2 or creases < 4):
        raise Infeasible(f"a closed family needs an even number of creases, at least 4, not {creases}")
    at = surface.project(np.asarray(point, dtype=float)[None])
    normal = at.normals[0]
    first = np.eye(3)[np.argmin(np.abs(normal))] if towards is None else np.asarray(towards, dtype=float)
    x = unit(first - (first @ normal) * normal)
    low, high = (0.0, 2 * np.pi) if sector is None else sector
    angle = np.linspace(low, high, creases, endpoint=sector is not None)
    angle = angle if side < 0 else angle[::-1]
    directions = np.cos(angle)[:, None] * x + np.sin(angle)[:, None] * np.cross(normal, x)
    curves = trace(surface, np.repeat(at.positions, creases, axis=0), directions, theta, side, both=False,
                   length=2 * surface.diagonal if length is None else length,
                   step=radius / 40 if step is None else step, beyond=beyond)
    strips = creases if sector is None else creases - 1
    spacing = np.full(strips, radius * (high - low) / strips)
    return Family(curves, theta, spacing, sector is None, np.zeros(creases), side, above)


def _check(theta: float) -> None:
    if not 0 < theta < np.pi / 2:
        raise InvalidDesign(f"pattern.theta is {np.degrees(theta):g}; creases guided on a surface need an inclination above "
                            "0 and below 90 degrees")


def _tuned(traced: Callable[[np.ndarray], tuple[Trace, ...]], count: int, spacing: np.ndarray,
           closed: bool) -> np.ndarray:
    """Turns (m,) after Gauss–Newton steps towards gaps that do not change along the strips; the best seen."""
    turns = np.zeros(count)
    curves = traced(turns)
    if all(curve.closed for curve in curves):
        return turns
    best = _unevenness(_gaps(curves, spacing, closed)), turns
    for _ in range(TUNING_STEPS):
        nudged = traced(turns + NUDGE)
        step = _even_step(curves, nudged, spacing, closed)
        turns = np.clip(turns + step, -LARGEST_TURN, LARGEST_TURN)
        curves = traced(turns)
        unevenness = _unevenness(_gaps(curves, spacing, closed))
        if not unevenness < 0.95 * best[0]:
            break
        best = unevenness, turns
    return best[1]


def _even_step(curves, nudged, spacing: np.ndarray, closed: bool) -> np.ndarray:
    """Turns (m,) that make relative gaps even to first order; differences between neighbours are held down."""
    count, strips = len(curves), len(spacing)
    gaps = _gaps(curves, spacing, closed)
    sensitivity = []
    for parity in (0, 1, 2):  # strips see at most two neighbours: three colours tell all derivatives apart
        mixed = tuple(n if k % 3 == parity else c for k, (c, n) in enumerate(zip(curves, nudged, strict=True)))
        sensitivity.append((_gaps(mixed, spacing, closed) - gaps) / NUDGE)
    rows, right = [], []
    for strip in range(strips):
        first, second = strip, (strip + 1) % count
        if first % 3 == second % 3:  # the seam of a closed family whose count is 1 modulo 3
            continue
        good = np.isfinite(gaps[strip])
        for parity in {first % 3, second % 3}:
            good &= np.isfinite(sensitivity[parity][strip])
        block = np.zeros((int(good.sum()), count))
        for curve in (first, second):
            block[:, curve] = sensitivity[curve % 3][strip, good]
        rows.append(block)
        right.append(1 - gaps[strip, good])
    smooth = np.eye(count) - np.roll(np.eye(count), 1, axis=1)
    held = 0.3 * np.eye(count)
    rows += [3.0 * (smooth if closed else smooth[:-1]), held]
    right += [np.zeros(len(rows[-2])), np.zeros(count)]
    return np.linalg.lstsq(np.concatenate(rows), np.concatenate(right), rcond=None)[0]


def _gaps(curves: tuple[Trace, ...], spacing: np.ndarray, closed: bool) -> np.ndarray:
    """Gaps (strips, PROBES) between neighbours at equal arc lengths over their widths at the guide; nan past an end."""
    splines = [_spline(curve, False) for curve in curves]
    low = float(np.median([spline.x[0] for spline in splines]))
    high = float(np.median([spline.x[-1] for spline in splines]))
    at = 0.99 * np.linspace(low, high, PROBES)
    points, tangents = np.empty((len(curves), PROBES, 3)), np.empty((len(curves), PROBES, 3))
    for index, spline in enumerate(splines):
        points[index], tangents[index] = spline(at), unit(spline(at, 1))
        points[index, (at < spline.x[0]) | (at > spline.x[-1])] = np.nan
    following = np.roll(np.arange(len(curves)), -1)[:len(spacing)]
    first = np.arange(len(spacing))
    across = points[following] - points[first]
    along = unit(tangents[first] + tangents[following])
    return norm(across - dot(across, along)[..., None] * along) / spacing[:, None]


def _unevenness(gaps: np.ndarray) -> float:
    """Mean square of the relative gaps' distance from 1; missing ends count as 1."""
    return float(np.mean(np.where(np.isfinite(gaps), (gaps - 1) ** 2, 1.0)))


def _spline(curve: Trace, periodic: bool) -> CubicSpline:
    along = arc_length(curve.points, periodic)
    points = np.concatenate([curve.points, curve.points[:1]]) if periodic else curve.points
    if len(points) < 4:
        return CubicSpline(along - along[curve.start], points, bc_type="natural")
    return CubicSpline(along - along[curve.start], points, bc_type="periodic" if periodic else "not-a-knot")

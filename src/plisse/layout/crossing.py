"""Columns across a family of curves: orthogonal trajectories, or from one end of every curve to the other (§3.3).

Trajectories start on one curve and cross to the next so that their chord makes equal angles with both. Around a closed
family they do not come back to where they began; the miss is spread evenly over all steps, so that columns close.
"""

from dataclasses import dataclass

import numpy as np
from scipy.interpolate import CubicSpline

from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.family import Family

__all__ = ["Crossing", "end_to_end", "trajectories"]

NEWTON_STEPS = 6
CONVERGED = 1e-9  # step, in mean distances of two curves, after which nothing but round-off is left
CLOSING_STEPS = 12


@dataclass(frozen=True, eq=False)
class Crossing:
    """Columns across a family: arc lengths (m, n) on every curve, nan past its end, and `points` (m, n, 3).

    `gaps` (strips, n) are the distances between neighbouring curves along columns.
    """

    at: np.ndarray
    points: np.ndarray
    gaps: np.ndarray

    def usable(self, family: Family, limits: tuple[float, float]) -> np.ndarray:
        """Mask (strips, n − 1 or n) of the cells whose corners exist, in order, with gaps within limits of nominal."""
        count = len(family.curves)
        relative = self.gaps / family.spacing[:, None]
        with np.errstate(invalid="ignore"):
            good = (relative > limits[0]) & (relative < limits[1])
            steps = np.diff(self.at, axis=1)
            rising = steps > 0.1 * np.nanmedian(steps)
        following = (np.arange(len(good)) + 1) % count
        if family.closed_curves:
            return good & np.roll(good, -1, axis=1)
        return good[:, 1:] & good[:, :-1] & rising[:len(good)] & rising[following]


def trajectories(family: Family, start: int, at: np.ndarray, *, past_ends: bool = False) -> Crossing:
    """Orthogonal trajectories from arc lengths (n,) on the curve number `start`.

    With `past_ends` the curves of open families go on straight, and no arc length is nan.
    """
    count = len(family.curves)
    if family.closed:
        return _crossing(family, np.roll(_closed(family, start, at), start, axis=0))
    rows: dict[int, np.ndarray] = {start: at}
    for towards in (1, -1):
        row = start
        while 0 <= row + towards < count:
            rows[row + towards] = _opposite(family, row, row + towards, rows[row], past_ends)
            row += towards
    return _crossing(family, np.stack([rows[row] for row in range(count)]))


def end_to_end(family: Family, columns: int) -> Crossing:
    """Columns at equal fractions of every curve: the first and the last one join the curves' ends."""
    low, high = family.ranges.T[..., None]
    return _crossing(family, low + np.linspace(0, 1, columns) * (high - low))


def _crossing(family: Family, at: np.ndarray) -> Crossing:
    points = np.stack([_on(spline, row, family.closed_curves)[0] for spline, row in zip(family.splines, at, strict=True)])
    following = np.roll(points, -1, axis=0)[:len(family.spacing)]
    return Crossing(at, points, norm(following - points[:len(following)]))


def _closed(family: Family, start: int, at: np.ndarray) -> np.ndarray:
    """Arc lengths (m, n) on the curves from `start` on, once around: steps are slanted so that columns close.

    The slant, the same at every step of a column, is found by the secant method.
    """
    count = len(family.curves)
    order = (start + np.arange(count + 1)) % count
    share = family.spacing[order[:-1]] / family.spacing.sum()

    def around(slant: np.ndarray) -> np.ndarray:
        rows = [at]
        for step in range(count):
            rows.append(_opposite(family, order[step], order[step + 1], rows[-1]) - share[step] * slant)
        return np.stack(rows)

    # a family with rotational symmetry has columns at equal distances from the guide
    slant = np.sum([_opposite(family, order[step], order[step + 1], at) - at for step in range(count)], axis=0)
    before, rows = slant + 1e-3 * family.spacing.sum(), around(slant)
    miss, missed = rows[-1] - at, around(before)[-1] - at
    for _ in range(CLOSING_STEPS):
        if not np.nanmax(np.abs(miss), initial=0) > 1e-9 * family.spacing.sum():
            break
        slope = (miss - missed) / np.where(slant == before, np.nan, slant - before)
        step = np.nan_to_num(miss / np.where(np.abs(slope) > 1e-3 * share.max(), slope, np.nan))
        before, missed, slant = slant, miss, slant - step
        rows = around(slant)
        miss = rows[-1] - at
    rows[:, ~(np.abs(miss) < 1e-3 * family.spacing.mean())] = np.nan
    return rows[:-1]


def _on(spline: CubicSpline, at: np.ndarray, closed: bool) -> tuple[np.ndarray, np.ndarray]:
    """Points and velocities (N, 3) at arc lengths (N,) of a curve that goes on straight beyond its ends."""
    if closed:
        return spline(at), spline(at, 1)
    held = np.clip(at, *spline.x[[0, -1]])
    velocity = spline(held, 1)
    return spline(held) + (at - held)[:, None] * velocity, velocity


def _opposite(family: Family, row: int, following: int, at: np.ndarray, past_ends: bool = False) -> np.ndarray:
    """Arc lengths on a neighbouring curve whose chords make equal angles with both; nan past its ends if not wanted."""
    spline, neighbour = family.splines[row], family.splines[following]
    origin, tangent = _on(spline, at, family.closed_curves)
    tangent = unit(tangent)
    low, high = neighbour.x[[0, -1]]
    slack = 0.0 if family.closed_curves else 1e-9 * (high - low)
    longest = 2 * float(family.spacing.mean())
    found = at.copy()
    for _ in range(NEWTON_STEPS):
        point, velocity = _on(neighbour, found, family.closed_curves)
        both = tangent + unit(velocity)
        error = dot(point - origin, both)
        step = np.clip(error / np.maximum(dot(velocity, both), 0.4), -longest, longest)
        found = found - step
        if not np.nanmax(np.abs(step), initial=0) > CONVERGED * longest:  # Newton doubles the digits
            break
    if family.closed_curves or past_ends:
        return found
    with np.errstate(invalid="ignore"):
        return np.where((found >= low - slack) & (found <= high + slack), found, np.nan)

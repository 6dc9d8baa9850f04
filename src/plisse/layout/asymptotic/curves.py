"""Asymptotic curves and their orthogonal trajectories, traced in the plane of a chart (§2.6)."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.chart import ChartPoints
from plisse.layout.asymptotic.directions import Directions, Field
from plisse.layout.asymptotic.leaf import Leaf, Steps
from plisse.layout.stops import Stop

__all__ = ["Limits", "trace_both_ways", "trace_leaves"]

SMALLEST_STEP = 1 / 16  # of the step asked for, at a boundary


@dataclass(frozen=True)
class Limits:
    """How far curves run: `length` in the plane in steps of `step`; through patches with K ≥ 0 at most `patch`."""

    length: float
    step: float
    patch: float = 0.0


def trace_leaves(directions: Directions, starts: np.ndarray, ahead: np.ndarray, field: Field,
                 limits: Limits) -> tuple[Leaf, ...]:
    """Curves from places (N,) towards directions (N,): classical Runge–Kutta steps, all curves at once.

    A field keeps its sense by continuity, so that the two families never mix. Steps become smaller at a boundary.
    """
    place = np.array(starts, complex)
    sense = directions.at(place, np.array(ahead, complex), field)
    march = _March(directions, field, limits, place, sense)
    while march.is_going:
        march.step()
    return march.leaves()


def trace_both_ways(directions: Directions, starts: np.ndarray, field: Field, limits: Limits) -> tuple[Leaf, ...]:
    """Curves through places (N,), traced forwards and backwards.

    None closes: the indices of the singularities inside a closed curve sum to 1, and where K ≤ 0 they are negative.
    """
    starts = np.atleast_1d(np.asarray(starts, complex))
    if not len(starts):
        return ()
    ahead = directions.at(starts, np.ones(len(starts), complex), field)
    halves = trace_leaves(directions, np.tile(starts, 2), np.concatenate([ahead, -ahead]), field, limits)
    return tuple(Leaf(backward.steps.turned().followed_by(forward.steps),
                      np.concatenate([backward.points[:0:-1], forward.points]), forward.stop, backward.stop)
                 for forward, backward in zip(halves[:len(starts)], halves[len(starts):], strict=True))


class _March:
    """Curves on their way: where they are, how they go on, and why some have ended."""

    def __init__(self, directions: Directions, field: Field, limits: Limits, place: np.ndarray, sense: np.ndarray):
        self.directions, self.field, self.limits = directions, field, limits
        self.starts, self.first = place, sense
        self.place, self.sense = place.copy(), sense.copy()
        count = len(place)
        self.size = np.full(count, limits.step)
        self.left = np.full(count, float(limits.length))
        self.lost = np.zeros(count)
        self.stop: list[Stop | None] = [None] * count
        self.active = np.ones(count, bool)
        self.path: list[tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]] = []

    @property
    def is_going(self) -> bool:
        return bool(self.active.any())

    def step(self) -> None:
        """One step of all active curves; those that may not take it try smaller ones or end."""
        at = np.flatnonzero(self.active)
        size = np.minimum(self.size[at], self.left[at])
        after, ahead = _runge_kutta(self.directions, self.place[at], self.sense[at], self.field, size)
        points = self.directions.chart.at(after)
        turned = self.directions.along(points, ahead, self.field)
        blocked, left_domain = self._blocked(at, after, size, points)
        smaller = left_domain & (size > SMALLEST_STEP * self.limits.step)
        self.size[at[smaller]] *= 0.5
        for k in np.flatnonzero(blocked & ~smaller):
            self._end(at[k], Stop.BOUNDARY if left_domain[k] else Stop.PARABOLIC)
        goes = at[~blocked]
        taken = ~blocked
        self.path.append((goes, size[taken], after[taken], turned[taken]))
        self.place[goes], self.sense[goes] = after[taken], turned[taken]
        self.left[goes] -= size[taken]
        for k in goes[self.left[goes] < 1e-9 * self.limits.step]:
            self._end(k, Stop.LENGTH)

    def _blocked(self, at: np.ndarray, after: np.ndarray, size: np.ndarray,
                 points: ChartPoints) -> tuple[np.ndarray, np.ndarray]:
        """Masks (N,) of the curves that may not take their step, and of those that would leave the domain."""
        one, mixed, two = points.second
        left_domain = ~(self.directions.chart.inside(after) & np.isfinite(one))
        self.lost[at] = np.where(mixed**2 > one * two, 0.0, self.lost[at] + size)
        return left_domain | (self.lost[at] > self.limits.patch), left_domain

    def _end(self, curve: int, stop: Stop) -> None:
        self.active[curve], self.stop[curve] = False, stop

    def leaves(self) -> tuple[Leaf, ...]:
        """The curves so far."""
        owner = np.concatenate([step[0] for step in self.path])
        size, after, turned = (np.concatenate([step[k] for step in self.path]) for k in (1, 2, 3))
        lines = []
        for curve in range(len(self.starts)):
            mine = owner == curve
            lines.append(Steps(np.append(self.starts[curve], after[mine]), np.append(self.first[curve], turned[mine]),
                               size[mine]))
        positions = self.directions.chart.positions(np.concatenate([line.samples for line in lines]))
        parts = np.split(positions, np.cumsum([len(line.samples) for line in lines])[:-1])
        return tuple(Leaf(line, part, stop or Stop.LENGTH) for line, part, stop in zip(lines, parts, self.stop, strict=True))


def _runge_kutta(directions: Directions, place: np.ndarray, sense: np.ndarray, field: Field,
                 step: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    one = sense
    two = directions.at(place + 0.5 * step * one, one, field)
    three = directions.at(place + 0.5 * step * two, two, field)
    four = directions.at(place + step * three, three, field)
    return place + step / 6 * (one + 2 * two + 2 * three + four), four

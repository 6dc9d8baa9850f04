"""Asymptotic curves and their orthogonal trajectories, traced in the plane of a chart (§2.6)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.chart import ChartPoints
from plisse.layout.asymptotic.directions import Directions, Field
from plisse.layout.stops import Stop

__all__ = ["Leaf", "Limits", "trace_both_ways", "trace_leaves"]

FEWEST_BEFORE_CLOSING = 8  # steps
BETWEEN = 8  # pieces into which every step is divided by a cubic
SMALLEST_STEP = 1 / 16  # of the step asked for, at a boundary


@dataclass(frozen=True)
class Limits:
    """How far curves run: `length` in the plane in steps of `step`; through patches with K ≥ 0 at most `patch`.

    A curve that comes within `near` of one of the `hubs` ends there.
    """

    length: float
    step: float
    patch: float = 0.0
    hubs: tuple[complex, ...] = ()
    near: float = 0.0


@dataclass(frozen=True, eq=False)
class Leaf:
    """A curve on a surface: `places` (K,) in the plane, `points` (K, 3), and why it ends at either end."""

    places: np.ndarray
    points: np.ndarray
    stop: Stop
    first_stop: Stop | None = None

    @cached_property
    def arc(self) -> np.ndarray:
        """Length (K,) in space from the first point."""
        return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(self.points, axis=0), axis=1))])

    @property
    def length(self) -> float:
        """Length in space."""
        return float(self.arc[-1])

    def place_at(self, arc: np.ndarray) -> np.ndarray:
        """Places (N,) at lengths (N,) in space."""
        return np.interp(arc, self.arc, self.places.real) + 1j * np.interp(arc, self.arc, self.places.imag)


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
    """Curves through places (N,), traced forwards and backwards; closed ones do not repeat their first point."""
    starts = np.atleast_1d(np.asarray(starts, complex))
    if not len(starts):
        return ()
    ahead = directions.at(starts, np.ones(len(starts), complex), field)
    halves = trace_leaves(directions, np.tile(starts, 2), np.concatenate([ahead, -ahead]), field, limits)
    return tuple(forward if forward.stop is Stop.CLOSED else
                 Leaf(np.concatenate([backward.places[:0:-1], forward.places]),
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
            self._end(at[k], Stop.BOUNDARY if left_domain[k] else
                      Stop.SINGULARITY if self.lost[at[k]] <= self.limits.patch else Stop.PARABOLIC)
        goes = at[~blocked]
        taken = ~blocked
        self.path.append((goes, size[taken], after[taken], turned[taken]))
        self.place[goes], self.sense[goes] = after[taken], turned[taken]
        self.left[goes] -= size[taken]
        self._finish(goes)

    def _blocked(self, at: np.ndarray, after: np.ndarray, size: np.ndarray,
                 points: ChartPoints) -> tuple[np.ndarray, np.ndarray]:
        """Masks (N,) of the curves that may not take their step, and of those that would leave the domain."""
        limits, (one, mixed, two) = self.limits, points.second
        left_domain = ~(self.directions.chart.inside(after) & np.isfinite(one))
        self.lost[at] = np.where(mixed**2 > one * two, 0.0, self.lost[at] + size)
        near = np.zeros(len(at), bool)
        for hub in limits.hubs:
            near |= np.abs(after - hub) < limits.near
        return left_domain | near | (self.lost[at] > limits.patch), left_domain

    def _finish(self, goes: np.ndarray) -> None:
        """Ends curves that are as long as was asked for, or that have come back to their start."""
        limits = self.limits
        back = (np.abs(self.place[goes] - self.starts[goes]) < 0.6 * limits.step) \
            & ((self.sense[goes] * np.conj(self.first[goes])).real > 0.9)
        back &= limits.length - self.left[goes] > FEWEST_BEFORE_CLOSING * limits.step
        for k in goes[back]:
            self._end(k, Stop.CLOSED)
        for k in goes[(self.left[goes] < 1e-9 * limits.step) & ~back]:
            self._end(k, Stop.LENGTH)

    def _end(self, curve: int, stop: Stop) -> None:
        self.active[curve], self.stop[curve] = False, stop

    def leaves(self) -> tuple[Leaf, ...]:
        """The curves, with cubics between their steps."""
        owner = np.concatenate([step[0] for step in self.path])
        size, after, turned = (np.concatenate([step[k] for step in self.path]) for k in (1, 2, 3))
        lines = []
        for curve, start in enumerate(self.starts):
            mine = owner == curve
            lines.append(_cubic(np.concatenate([[start], after[mine]]), np.concatenate([[self.first[curve]], turned[mine]]),
                                size[mine]))
        positions = self.directions.chart.positions(np.concatenate(lines))
        parts = np.split(positions, np.cumsum([len(line) for line in lines])[:-1])
        return tuple(Leaf(line, part, stop or Stop.LENGTH) for line, part, stop in zip(lines, parts, self.stop, strict=True))


def _runge_kutta(directions: Directions, place: np.ndarray, sense: np.ndarray, field: Field,
                 step: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    one = sense
    two = directions.at(place + 0.5 * step * one, one, field)
    three = directions.at(place + 0.5 * step * two, two, field)
    four = directions.at(place + step * three, three, field)
    return place + step / 6 * (one + 2 * two + 2 * three + four), four


def _cubic(places: np.ndarray, tangents: np.ndarray, size: np.ndarray) -> np.ndarray:
    """Hermite's cubics through places with unit tangents, sampled between."""
    t = np.arange(BETWEEN) / BETWEEN
    a, b = places[:-1, None], places[1:, None]
    u, v = (tangents[:-1] * size)[:, None], (tangents[1:] * size)[:, None]
    inner = (a * (1 + 2 * t) * (1 - t) ** 2 + u * t * (1 - t) ** 2 + b * t**2 * (3 - 2 * t) - v * t**2 * (1 - t))
    return np.append(inner.ravel(), places[-1])



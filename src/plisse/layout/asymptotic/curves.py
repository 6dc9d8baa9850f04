"""Asymptotic curves and their orthogonal trajectories, traced in the plane of a chart (§2.6)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.chart import Chart
from plisse.layout.asymptotic.directions import Directions, Field
from plisse.layout.stops import Stop

__all__ = ["Leaf", "Limits", "trace_both_ways", "trace_leaves"]

FEWEST_BEFORE_CLOSING = 8  # steps


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

    A field keeps its sense by continuity, so that the two families never mix.
    """
    chart, step = directions.chart, limits.step
    starts = place = np.array(starts, complex)
    sense = directions.at(place, np.array(ahead, complex), field)
    count = len(place)
    stop = np.full(count, Stop.LENGTH, object)
    active, lost = np.ones(count, bool), np.zeros(count)
    first = sense
    path, steps = [place], np.zeros(count, int)
    for k in range(max(1, round(limits.length / step))):
        at = np.flatnonzero(active)
        after, turned = _step(directions, place[at], sense[at], field, step)
        ended = _ended(chart, after, lost, at, limits)
        back = np.abs(after - starts[at]) < 0.6 * step
        if k >= FEWEST_BEFORE_CLOSING:
            ended[back & ((turned * np.conj(first[at])).real > 0.9)] = Stop.CLOSED
        stop[at[ended != None]] = ended[ended != None]  # noqa: E711  (element by element)
        goes = at[ended == None]  # noqa: E711
        active[:] = False
        active[goes] = True
        if not len(goes):
            break
        place, sense = place.copy(), sense.copy()
        place[goes], sense[goes] = after[active[at]], turned[active[at]]
        steps[goes] += 1
        path.append(place)
    lines = np.array(path)
    return _leaves(chart, [lines[:last + 1, n] for n, last in enumerate(steps)], stop)


def trace_both_ways(directions: Directions, starts: np.ndarray, field: Field, limits: Limits) -> tuple[Leaf, ...]:
    """Curves through places (N,), traced forwards and backwards; closed ones do not repeat their first point."""
    starts = np.atleast_1d(np.asarray(starts, complex))
    if not len(starts):
        return ()
    ahead = directions.at(starts, np.ones(len(starts), complex), field)
    both = zip(trace_leaves(directions, starts, -ahead, field, limits), trace_leaves(directions, starts, ahead, field, limits),
               strict=True)
    return tuple(forward if forward.stop is Stop.CLOSED else
                 Leaf(np.concatenate([backward.places[:0:-1], forward.places]),
                      np.concatenate([backward.points[:0:-1], forward.points]), forward.stop, backward.stop)
                 for backward, forward in both)


def _step(directions: Directions, place: np.ndarray, sense: np.ndarray, field: Field,
          step: float) -> tuple[np.ndarray, np.ndarray]:
    one = directions.at(place, sense, field)
    two = directions.at(place + 0.5 * step * one, one, field)
    three = directions.at(place + 0.5 * step * two, two, field)
    four = directions.at(place + step * three, three, field)
    return place + step / 6 * (one + 2 * two + 2 * three + four), four


def _ended(chart: Chart, after: np.ndarray, lost: np.ndarray, at: np.ndarray, limits: Limits) -> np.ndarray:
    """Stops (N,) of curves that may not take a step, None for the others; `lost` counts lengths without directions."""
    ended = np.full(len(after), None, object)
    one, mixed, two = chart.at(after).second
    lost[at] = np.where(mixed**2 <= one * two, lost[at] + limits.step, 0.0)
    ended[lost[at] > limits.patch] = Stop.PARABOLIC
    for hub in limits.hubs:
        ended[np.abs(after - hub) < limits.near] = Stop.SINGULARITY
    ended[~(chart.inside(after) & np.isfinite(one))] = Stop.BOUNDARY
    return ended


def _leaves(chart: Chart, lines: list[np.ndarray], stops: np.ndarray) -> tuple[Leaf, ...]:
    positions = chart.at(np.concatenate(lines)).positions
    parts = np.split(positions, np.cumsum([len(line) for line in lines])[:-1])
    return tuple(Leaf(line, part, stop) for line, part, stop in zip(lines, parts, stops, strict=True))

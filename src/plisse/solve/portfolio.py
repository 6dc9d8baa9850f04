"""Several ways to an exact structure, tried in order, judged alike; the best and the others' reasons are kept."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from plisse.measure.deviation import crease_deviation
from plisse.measure.shape import Shape
from plisse.measure.verdict import Verdict, judge
from plisse.solve.attempt import Attempt, Start
from plisse.solve.coarse_to_fine import CoarseToFine
from plisse.solve.explicit import constructed

__all__ = ["CONSTRUCTED_ONLY", "GENERAL", "GUIDED", "GUIDED_PRINCIPAL", "PRINCIPAL", "SECOND_CHANCE", "Judged", "Outcome",
           "solve"]

Way = Callable[[Start], Attempt]

FEW = 20  # columns (60 of closed creases) on which nearer structures are sought: fewer of them stay nearer to the guides

SMOOTH = {"along": 1.0, "same_side": 0.09, "across": 0.03}

OPTIMISED = CoarseToFine("optimised")
GENTLE = CoarseToFine("optimised in small steps", columns=60, steps=2, fairness=SMOOTH)
# over a given surface a coarse look leads to as many exact structures as a fine one, in half the time
SKETCHED = CoarseToFine("optimised from few columns", columns=FEW, steps=2, fairness=SMOOTH, sufficient=1e-4, chords=0)
STIFF = CoarseToFine("optimised with stiff strips", columns=60, steps=2,
                     fairness={"along": 1.0, "same_side": 0.3, "across": 0.1})
STIFFER = CoarseToFine("optimised with stiffer strips", columns=60, steps=3,
                       fairness={"along": 1.0, "same_side": 1.0, "across": 0.3})

GENERAL: tuple[Way, ...] = (OPTIMISED, GENTLE)
PRINCIPAL: tuple[Way, ...] = (OPTIMISED, constructed, GENTLE)
OPTIMISED_ONLY: tuple[Way, ...] = (OPTIMISED,)
CONSTRUCTED_ONLY: tuple[Way, ...] = (constructed,)
SECOND_CHANCE: tuple[Way, ...] = (OPTIMISED, GENTLE, STIFF)
GUIDED: tuple[Way, ...] = (SKETCHED, *SECOND_CHANCE)
GUIDED_PRINCIPAL: tuple[Way, ...] = (GENTLE, STIFF, STIFFER)


@dataclass(frozen=True, eq=False)
class Judged:
    """An attempt with the start it was made from, its shape, how far its vertices (m, n) are from the guides in amplitudes,
    and the verdict on it; None where there are no vertices."""

    start: Start
    attempt: Attempt
    shape: Shape | None = None
    astray: np.ndarray | None = None
    verdict: Verdict | None = None

    @property
    def rank(self) -> tuple:
        """Sort key; attempts without vertices come last."""
        return (self.verdict is not None, *(self.verdict.rank if self.verdict else ()))

    @property
    def is_comfortable(self) -> bool:
        """Whether nothing more needs to be tried."""
        return self.verdict is not None and self.verdict.is_comfortable


@dataclass(frozen=True, eq=False)
class Outcome:
    """The best attempt and all attempts in the order in which they were made."""

    best: Judged
    tried: tuple[Judged, ...]


def solve(plans: Iterable[tuple[Start, tuple[Way, ...]]]) -> Outcome:
    """The best of all planned ways on all starts; stops at the first that is comfortable."""
    tried: list[Judged] = []
    for judged in _attempts(plans):
        tried.append(judged)
        if judged.is_comfortable:
            break
    return Outcome(max(tried, key=lambda judged: judged.rank), tuple(tried))


def _attempts(plans: Iterable[tuple[Start, tuple[Way, ...]]]) -> Iterator[Judged]:
    best: Judged | None = None
    for start, ways in plans:
        for way in ways:
            judged = _judged(start, _attempt(way, start, best.verdict if best else None))
            best = judged if best is None or judged.rank > best.rank else best
            yield judged
        if best and best.verdict and best.verdict.is_good:  # other starts are for designs that nothing has solved yet
            return


def _attempt(way: Way, start: Start, best: Verdict | None) -> Attempt:
    """What comes of a way; beside a sound structure it is followed only where few columns promise a better one."""
    if best is None or not best.is_sound or not isinstance(way, CoarseToFine):
        return way(start)
    glance = replace(way, columns=min(way.columns, FEW)) if best.has_wide_sectors else way
    return glance(start, lambda samples, vertices: _measured(start, samples, vertices)[2].promises_more_than(best))


def _judged(start: Start, attempt: Attempt) -> Judged:
    if attempt.vertices is None:
        return Judged(start, attempt)
    return Judged(start, attempt, *_measured(start, start.samples, attempt.vertices))


def _measured(start: Start, samples: int, vertices: np.ndarray) -> tuple[Shape, np.ndarray, Verdict]:
    """Shape, distances from the guides in amplitudes, and the verdict, for vertices (V, 3) with so many samples."""
    guides, shape = start.guides(samples), Shape(start.grid(samples), vertices)
    astray = crease_deviation(vertices.reshape(guides.shape), guides, start.pattern.closed) / start.amplitude
    return shape, astray, judge(shape, principal=start.principal, deviation=float(astray.max()))

"""Several ways to an exact structure, tried in order, judged alike; the best and the others' reasons are kept."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from plisse.measure.deviation import crease_deviation
from plisse.measure.shape import Shape
from plisse.measure.verdict import Verdict, judge
from plisse.solve.attempt import Attempt, Start
from plisse.solve.coarse_to_fine import CoarseToFine
from plisse.solve.explicit import constructed

__all__ = ["CONSTRUCTED_ONLY", "GENERAL", "GUIDED_PRINCIPAL", "PRINCIPAL", "SECOND_CHANCE", "Judged", "Outcome", "solve"]

Way = Callable[[Start], Attempt]

OPTIMISED = CoarseToFine("optimised")
GENTLE = CoarseToFine("optimised in small steps", columns=60, steps=2,
                      fairness={"along": 1.0, "same_side": 0.09, "across": 0.03})
STIFF = CoarseToFine("optimised with stiff strips", columns=60, steps=2,
                     fairness={"along": 1.0, "same_side": 0.3, "across": 0.1})
STIFFER = CoarseToFine("optimised with stiffer strips", columns=60, steps=3,
                       fairness={"along": 1.0, "same_side": 1.0, "across": 0.3})

GENERAL: tuple[Way, ...] = (OPTIMISED, GENTLE)
PRINCIPAL: tuple[Way, ...] = (OPTIMISED, constructed, GENTLE)
OPTIMISED_ONLY: tuple[Way, ...] = (OPTIMISED,)
CONSTRUCTED_ONLY: tuple[Way, ...] = (constructed,)
SECOND_CHANCE: tuple[Way, ...] = (OPTIMISED, GENTLE, STIFF)
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
    good = False
    for start, ways in plans:
        if good:  # other starts are for designs that nothing has solved yet
            return
        for way in ways:
            judged = _judged(start, way(start))
            good = good or (judged.verdict is not None and judged.verdict.is_good)
            yield judged


def _judged(start: Start, attempt: Attempt) -> Judged:
    if attempt.vertices is None:
        return Judged(start, attempt)
    guides, shape = start.guides(start.samples), Shape(start.topology, attempt.vertices)
    astray = crease_deviation(attempt.vertices.reshape(guides.shape), guides, start.pattern.closed) / start.amplitude
    return Judged(start, attempt, shape, astray,
                  judge(shape, principal=start.principal, deviation=float(astray.max())))

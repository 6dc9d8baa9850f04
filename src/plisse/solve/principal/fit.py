"""Principal structures along given guiding creases: attempts of increasing expense, the first good one or the best.

A principal structure has about as many conditions as unknowns, so optimising its vertices stalls; fitting the numbers
of the explicit construction does not, and every attempt is exact.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.solve.principal.greedy import greedy_fit, opened
from plisse.solve.principal.joint import joint_fit
from plisse.solve.principal.judge import Regularity, regularity
from plisse.solve.principal.numbers import PrincipalNumbers, start, with_terms
from plisse.solve.principal.progressive import progressive_fit
from plisse.solve.principal.realise import crease_deviation, realise
from plisse.solve.principal.target import Target, aim

__all__ = ["PrincipalFit", "fit_candidates", "fit_principal"]

_ACCEPTED = 1.0  # amplitudes
_LADDER = (61, 121)  # samples per crease at which the numbers are fitted first
_DRIFT = 0.02  # amplitudes by which the deviation may grow from one resolution to the next without a new fit
_OPEN_TERMS, _CLOSED_TERMS = 8, 9


@dataclass(frozen=True)
class PrincipalFit:
    """An exact principal structure with vertices (m, n, 3) whose crease l follows guide l.

    Deviations of the creases from the guides (extended tangentially) are in amplitudes; `message` says why the result
    is poor and is empty for a regular structure near its guides.
    """

    vertices: np.ndarray
    deviation: float
    mean_deviation: float
    numbers: PrincipalNumbers
    regularity: Regularity
    message: str

    @property
    def is_good(self) -> bool:
        """Regular and closer to the guides than an amplitude."""
        return not self.message

    @property
    def badness(self) -> tuple[bool, float]:
        """Sort key: regular structures first, near ones before far ones."""
        return bool(self.regularity.message), self.deviation if np.isfinite(self.deviation) else np.inf


def fit_principal(guides: np.ndarray, amplitude: float, *, closed: bool = False, **options) -> PrincipalFit:
    """The first attempt that is regular and within an amplitude of guides (m, n, 3), else the best one.

    Raises `Infeasible` for closed creases with an even number of samples whose rectifying planes do not close.
    """
    best = None
    for attempt in fit_candidates(guides, amplitude, closed=closed, **options):
        if best is None or attempt.badness < best.badness:
            best = attempt
        if best.is_good:
            break
    if best is None:
        raise Infeasible("no principal structure could be constructed along these guides")
    return best


def fit_candidates(guides: np.ndarray, amplitude: float, *, closed: bool = False, terms: int | None = None,
                   stiffness: float = 0.02) -> Iterator[PrincipalFit]:
    """Exact attempts along guides (m, n, 3), cheap ones first: other seeds, then progressively from the middle.

    `terms` is the number of displacement coefficients of the seed per normal, `stiffness` holds them small.
    """
    guides = _checked(guides)
    centre = guides.mean(axis=(0, 1))
    terms = terms or (_CLOSED_TERMS if closed else _OPEN_TERMS)
    for seed, strategy in _strategies(len(guides), closed):
        target = aim(np.moveaxis(guides - centre, 2, 1), amplitude, seed, closed)
        fitted, numbers = _up_the_ladder(target, partial(strategy, terms=terms, stiffness=stiffness), stiffness)
        yield _result(fitted, numbers, centre)


Strategy = Callable[..., PrincipalNumbers]


def _strategies(creases: int, closed: bool) -> Iterator[tuple[int, Strategy]]:
    """Seed crease and first fit of each attempt."""
    middle = creases // 2
    plain = _closed_fit if closed else _plain_fit
    yield middle, plain
    yield middle, partial(progressive_fit, windows=(1.0,))
    if creases >= 6:
        yield creases // 3, plain
        yield 2 * creases // 3, plain
    yield middle, partial(progressive_fit, windows=(0.4, 0.7, 1.0))


def _plain_fit(target: Target, terms: int, stiffness: float) -> PrincipalNumbers:
    """Greedy, then all numbers together, then with a displaced seed."""
    numbers = greedy_fit(target, opened(target, start(target)))
    numbers, _ = joint_fit(target, numbers, 20)
    return joint_fit(target, with_terms(numbers, terms), 25, stiffness)[0]


def _closed_fit(target: Target, terms: int, stiffness: float) -> PrincipalNumbers:
    numbers, _ = joint_fit(target, start(target), 20)
    return joint_fit(target, with_terms(numbers, terms), 25, stiffness)[0]


def _up_the_ladder(target: Target, first_fit: Strategy, stiffness: float) -> tuple[Target, PrincipalNumbers]:
    """Fit coarsely, then refine the numbers where finer samples call for it."""
    rungs = [samples for samples in _LADDER if 1.5 * samples < target.samples] + [target.samples]
    coarse = target.at(rungs[0])
    numbers = first_fit(coarse)
    deviation = _largest(coarse, numbers)
    for samples in rungs[1:]:
        fine = target.at(samples)
        if not _largest(fine, numbers) < deviation + _DRIFT:
            numbers, _ = joint_fit(fine, numbers, 12, stiffness)
        deviation = _largest(fine, numbers)
    return target, numbers


def _largest(target: Target, numbers: PrincipalNumbers) -> float:
    return float(crease_deviation(target, realise(target, numbers)).max())


def _result(target: Target, numbers: PrincipalNumbers, centre: np.ndarray) -> PrincipalFit:
    creases = realise(target, numbers)
    deviation = crease_deviation(target, creases)
    verdict = regularity(creases, target.closed)
    message = verdict.message
    if not message and not deviation.max() < _ACCEPTED:
        crease = int(deviation.max(axis=1).argmax())
        message = f"crease {crease} is {deviation.max():.1f} amplitudes away from its guide"
    vertices = np.moveaxis(creases, 1, 2) + centre
    return PrincipalFit(vertices, float(deviation.max()), float(deviation.mean()), numbers, verdict, message)


def _checked(guides: np.ndarray) -> np.ndarray:
    guides = np.asarray(guides, dtype=float)
    if guides.ndim != 3 or guides.shape[2] != 3 or guides.shape[0] < 3 or guides.shape[1] < 12:
        raise InvalidDesign(f"guides need shape (creases ≥ 3, samples ≥ 12, 3), not {guides.shape}")
    if not np.isfinite(guides).all():
        raise Infeasible("the guiding creases are not finite")
    return guides

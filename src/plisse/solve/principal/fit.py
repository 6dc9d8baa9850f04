"""Principal structures along guiding creases: attempts of increasing expense, the first good one or the best.

A principal structure has about as many conditions as unknowns, so optimising its vertices stalls; fitting
the numbers of the explicit construction does not, and every attempt is exact.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import NamedTuple

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.solve.principal.direct import direct_fit
from plisse.solve.principal.joint import joint_fit
from plisse.solve.principal.judge import Regularity, regularity
from plisse.solve.principal.numbers import PrincipalNumbers
from plisse.solve.principal.progressive import progressive_fit
from plisse.solve.principal.realise import crease_deviation, realise
from plisse.solve.principal.target import Target, aim

__all__ = ["PrincipalFit", "fit_candidates", "fit_principal"]

_ACCEPTED = 1.0  # amplitudes
_ENOUGH = 2  # attempts after which a regular structure is taken although it is farther off
_HOPELESS = 4.0  # amplitudes: an irregular coarse fit farther off is given up
_LADDER = (61, 121)  # samples per crease at which the numbers are fitted first
_DRIFT = 0.05  # amplitudes by which the deviation may grow from one resolution to the next without a new fit


@dataclass(frozen=True)
class PrincipalFit:
    """An exact principal structure with vertices (m, n, 3) whose crease l follows guide l.

    Deviations of the creases from the guides (extended tangentially) are in amplitudes; `message` says
    why the result is poor and is empty for a regular structure near its guides.
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
        return bool(self.regularity.message), self.deviation if self.deviation < np.inf else np.inf


def fit_principal(guides: np.ndarray, amplitude: float, *, closed: bool = False) -> PrincipalFit:
    """The first attempt that is regular and within an amplitude of guides (m, n, 3), else the best one.

    Raises `Infeasible` for closed creases with an even number of samples whose rectifying planes do not
    close.
    """
    best: PrincipalFit | None = None
    for tried, attempt in enumerate(fit_candidates(guides, amplitude, closed=closed), start=1):
        if best is None or attempt.badness < best.badness:
            best = attempt
        if best.is_good or (tried >= _ENOUGH and not best.regularity.message):
            break
    assert best is not None
    return best


def fit_candidates(guides: np.ndarray, amplitude: float, *, closed: bool = False) -> Iterator[PrincipalFit]:
    """Exact attempts along guides (m, n, 3), cheap ones first: directly, progressively, from other seeds.

    Attempts that are hopeless on few samples are not refined; if all are, the least bad one is the only candidate.
    """
    guides = _checked(guides)
    centre = guides.mean(axis=(0, 1))
    hopeless: list[PrincipalFit] = []
    any_better = False
    for plan in _plans(len(guides), closed):
        target = aim(np.moveaxis(guides - centre, 2, 1), amplitude, plan.seed, closed)
        coarse = target.at(min(_LADDER[0], target.samples))
        attempt = _result(coarse, plan.fit(coarse, terms=plan.terms, stiffness=plan.stiffness), centre)
        if attempt.badness > (True, _HOPELESS):
            hopeless.append(_result(target, attempt.numbers, centre))
        else:
            any_better = True
            yield _result(target, _refined(target, coarse, attempt.numbers, plan.stiffness), centre)
    if not any_better:
        yield min(hopeless, key=lambda attempt: attempt.badness)


class _Plan(NamedTuple):
    """An attempt: seed crease, first fit, displacement coefficients of the seed per normal and their stiffness."""

    seed: int
    fit: Callable[..., PrincipalNumbers]
    terms: int
    stiffness: float


def _plans(creases: int, closed: bool) -> Iterator[_Plan]:
    """Cheap ones first; displacements of many terms, softly held, reach farther and take longer."""
    middle = creases // 2
    gradually = partial(progressive_fit, windows=(1.0,))
    soft = (9 if closed else 12, 0.002)
    yield _Plan(middle, direct_fit, 9 if closed else 8, 0.02)
    yield _Plan(middle, gradually, *soft)
    if not closed:
        yield _Plan(middle, direct_fit, *soft)
    if creases >= 6:
        yield _Plan(creases // 3, gradually, *soft)
        yield _Plan(2 * creases // 3, gradually, *soft)
    if not closed:
        yield _Plan(middle, partial(progressive_fit, windows=(0.4, 0.7, 1.0)), *soft)


def _refined(target: Target, coarse: Target, numbers: PrincipalNumbers, stiffness: float) -> PrincipalNumbers:
    """Numbers for all samples: fitted again only where finer samples show new faults."""
    for samples in [*(rung for rung in _LADDER[1:] if 1.5 * rung < target.samples), target.samples]:
        fine = target.at(samples)
        if _is_worse(fine, coarse, numbers):
            numbers, _ = joint_fit(fine, numbers, 8, stiffness)
        coarse = fine
    return numbers


def _is_worse(fine: Target, coarse: Target, numbers: PrincipalNumbers) -> bool:
    """Irregular, or farther from the guides than on fewer samples."""
    creases = realise(fine, numbers)
    allowed = crease_deviation(coarse, realise(coarse, numbers)).max() + _DRIFT
    if regularity(creases, fine.closed).message:
        return True
    return not crease_deviation(fine, creases).max() < allowed


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

"""Levenberg–Marquardt: small damped Gauss–Newton steps that never make things worse."""

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum

import numpy as np

from plisse.leastsquares import NotPositiveDefinite
from plisse.leastsquares.problem import Blocks, Linearisation, Problem

__all__ = ["Minimum", "Status", "levenberg_marquardt"]

LEAST_DAMPING, MOST_DAMPING = 1e-14, 1e12
VANISHING = 1e-28  # cost per residual that is nothing but round-off, residuals being of size 1


class Status(Enum):
    """Why the iteration ended; the value is a sentence for people."""

    CONVERGED = "the cost has reached its minimum"
    EXHAUSTED = "all iterations were used up while the cost was still falling"
    STALLED = "no damping makes the cost fall any more"
    NOT_FINITE = "the start has residuals or derivatives that are not finite numbers"


@dataclass(frozen=True, eq=False)
class Minimum:
    """Blocks at the end, the cost at the start and after every step, and what the way there took."""

    blocks: Blocks
    history: tuple[float, ...]
    status: Status
    factorisations: int

    @property
    def iterations(self) -> int:
        """Steps that were taken; rejected trials count as factorisations only."""
        return len(self.history) - 1


@dataclass(frozen=True, eq=False)
class _Step:
    """An accepted step with the damping for the next one; `blocks` is None where none was found."""

    blocks: Blocks | None
    cost: float
    damping: float
    trials: int


def levenberg_marquardt(problem: Problem, blocks: Blocks, *, iterations: int = 20, damping: float = 1e-3,
                        tolerance: float = 1e-12,
                        renew: Callable[[Blocks], Problem] | None = None) -> Minimum:
    """Minimise Σ weight · residual² from blocks, for unknowns and residuals whose natural size is about 1.

    One accepted step is one iteration. It ends when a step gains less than `tolerance` of the cost. `renew`
    returns the problem with data frozen at the given blocks; it is asked before each step.
    """
    history: list[float] = []
    factorisations, status = 0, Status.EXHAUSTED
    for _ in range(iterations):
        problem = problem if renew is None else renew(blocks)
        at = problem.linearise(blocks)
        if not history:
            history.append(at.cost)
        if not (np.isfinite(at.cost) and np.isfinite(at.entries).all()):
            status = Status.NOT_FINITE
            break
        if at.cost <= VANISHING * len(at.residual):
            status = Status.CONVERGED
            break
        step = _step(problem, blocks, at, damping, tolerance)
        factorisations, damping = factorisations + step.trials, step.damping
        if step.blocks is None:
            status = Status.CONVERGED if damping < MOST_DAMPING else Status.STALLED
            break
        blocks = step.blocks
        history.append(step.cost)
        if at.cost - step.cost <= tolerance * at.cost:
            status = Status.CONVERGED
            break
    return Minimum(blocks, tuple(history), status, factorisations)


def _step(problem: Problem, blocks: Blocks, at: Linearisation, damping: float, tolerance: float) -> _Step:
    """The first trial that lowers the cost; damping grows faster and faster until there is one."""
    gradient = problem.gradient(at)
    growth, trials = 4.0, 0
    while damping < MOST_DAMPING:
        trials += 1
        step = _solution(problem, at, gradient, damping)
        predicted = damping * step @ step - gradient @ step
        if np.isfinite(predicted):
            if predicted <= 1e-3 * tolerance * at.cost:
                return _Step(None, at.cost, damping, trials)
            trial = problem.moved(blocks, step)
            residual = problem.residual(trial)
            cost = float(residual @ residual)
            if cost < at.cost:
                return _Step(trial, cost, _adapted(damping, (at.cost - cost) / predicted), trials)
        damping, growth = damping * growth, 2 * growth
    return _Step(None, at.cost, MOST_DAMPING, trials)


def _solution(problem: Problem, at: Linearisation, gradient: np.ndarray, damping: float) -> np.ndarray:
    """The damped Gauss–Newton step, not finite where no factorisation exists."""
    try:
        return -problem.factor(at, damping).solve(gradient)
    except NotPositiveDefinite:
        return np.full(len(gradient), np.nan)


def _adapted(damping: float, gain: float) -> float:
    """Less damping where the linear model was right, more where it promised too much (Nielsen's rule)."""
    return max(damping * max(1 / 3, 1 - (2 * gain - 1) ** 3), LEAST_DAMPING)

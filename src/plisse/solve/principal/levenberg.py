"""Levenberg–Marquardt on normal equations that are accumulated block by block."""

from collections.abc import Callable

import numpy as np

__all__ = ["DIFFERENCE", "NormalEquations", "minimise"]

DIFFERENCE = 1e-6  # forward differences in unknowns of order 1
_HOPELESS = 1e3  # stands for residuals that are not finite
_LONGEST = 0.3  # largest change of an unknown per step
_TRIALS = 8


class NormalEquations:
    """H = Jᵀ J, g = Jᵀ r and the cost r·r of residual blocks; `numbers` is where they were evaluated.

    A block (B, k) has the residuals in its first row and, in the others, those with one unknown displaced
    by DIFFERENCE.
    """

    def __init__(self, numbers: np.ndarray):
        self.numbers = np.array(numbers, dtype=float)
        self.matrix = np.zeros((len(numbers), len(numbers)))
        self.gradient = np.zeros(len(numbers))
        self.cost = 0.0

    def add(self, block: np.ndarray, columns: np.ndarray, robust: bool = False) -> None:
        """Add a block whose rows 1, 2, … belong to `columns`; robust: 2 (√(1 + r²) − 1) in place of r²."""
        block = np.nan_to_num(block, nan=_HOPELESS, posinf=_HOPELESS, neginf=-_HOPELESS)
        block = np.clip(block, -_HOPELESS, _HOPELESS)
        residual = block[0]
        root = np.sqrt(1 + residual**2)
        weight = 1 / root if robust else np.ones_like(residual)
        self.cost += float((2 * (root - 1)).sum() if robust else residual @ residual)
        if len(block) > 1:
            slopes = (block[1:] - residual) / DIFFERENCE
            weighted = slopes * weight
            self.matrix[np.ix_(columns, columns)] += weighted @ slopes.T
            self.gradient[columns] += weighted @ residual

    def add_quadratic(self, stiffness: np.ndarray) -> None:
        """Add Σ stiffness x² for the diagonal stiffness (size,)."""
        self.cost += float(stiffness @ self.numbers**2)
        self.matrix += np.diag(stiffness)
        self.gradient += stiffness * self.numbers

    def step(self, damping: float) -> np.ndarray:
        """The damped step, shortened so that no unknown changes by more than 0.3."""
        diagonal = np.diag(self.matrix)
        floor = 1e-9 * (1 + diagonal.mean())
        step = -np.linalg.solve(self.matrix + np.diag(damping * diagonal + floor), self.gradient)
        return step * min(1.0, _LONGEST / max(np.abs(step).max(), 1e-300))


Evaluate = Callable[[np.ndarray, bool], NormalEquations]


def minimise(evaluate: Evaluate, start: np.ndarray, iterations: int, tolerance: float = 1e-3,
             damping: float = 1e-4) -> tuple[np.ndarray, float]:
    """Numbers and cost after at most `iterations` steps, fewer if one gains less than `tolerance` of it.

    `evaluate(numbers, slopes)` may return equations with corrected numbers (closed creases solve for some
    of them).
    """
    numbers, cost = np.array(start, dtype=float), np.inf
    for _ in range(iterations):
        here = evaluate(numbers, True)
        numbers, cost = here.numbers, here.cost
        trial = here
        for _ in range(_TRIALS):
            trial = evaluate(numbers + here.step(damping), False)
            if trial.cost < cost:
                break
            damping = max(6 * damping, 1e-8)
        else:
            break
        gain, numbers, cost = (cost - trial.cost) / cost, trial.numbers, trial.cost
        damping = max(0.15 * damping, 1e-10)
        if gain < tolerance:
            break
    return numbers, cost

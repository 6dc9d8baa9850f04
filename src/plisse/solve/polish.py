"""Minimum-norm Newton steps onto the exact conditions: from a regular near-solution to round-off."""

from dataclasses import dataclass

import numpy as np

from plisse.leastsquares import Factor, NotPositiveDefinite
from plisse.solve.constraints import Constraints

__all__ = ["TOLERANCE", "Polished", "polish"]

TOLERANCE = 2e-13
LONGEST_STEP = 0.5
PATIENCE = 5


@dataclass(frozen=True, eq=False)
class Polished:
    """Vertices (3, V), the largest residual after every step, and the number of factorisations."""

    vertices: np.ndarray
    history: tuple[float, ...]
    factorisations: int

    @property
    def defect(self) -> float:
        """Largest residual left."""
        return self.history[-1]


def polish(constraints: Constraints, vertices: np.ndarray, *, steps: int = 10, chord: bool = False,
           tolerance: float = TOLERANCE) -> Polished:
    """The nearest solution of the constraints to vertices (3, V), in units of the mean edge length.

    Steps are cut to half an edge, and end where no residual exceeds `tolerance`. With `chord` one factorisation (and its
    Jacobian) serves as long as each step gains a factor of three. The best vertices seen are returned, so a diverging
    polish costs nothing.
    """
    best = current = vertices
    history: list[float] = []
    factor: Factor | None = None
    jacobian = np.empty(0)
    factorisations = waited = 0
    least = np.inf
    for _ in range(steps + 1):
        residual = constraints.residual(current)
        defect = float(np.abs(residual).max(initial=0.0))
        stale = bool(history) and defect > 0.3 * history[-1]
        history.append(defect if np.isfinite(defect) else np.inf)
        if not np.isfinite(defect):
            break
        if defect < least:
            best, least, waited = current, defect, 0
        else:
            waited += 1
        floor = 6 * np.finfo(float).eps * np.abs(current).max()
        if defect < max(tolerance, floor) or (stale and defect < 50 * floor) or waited > PATIENCE \
                or len(history) > steps:
            break
        if factor is None or stale or not chord:
            jacobian = constraints.jacobian(current)
            try:
                factor = constraints.factor(jacobian)
            except NotPositiveDefinite:
                break
            factorisations += 1
        step = -constraints.pull_back(jacobian, factor.solve(residual))
        current = current + step * min(1.0, LONGEST_STEP / max(float(np.abs(step).max()), 1e-300))
    return Polished(best, (*history, least), factorisations)

"""The numbers that determine a principal structure, and their order in a vector of unknowns."""

from dataclasses import dataclass, replace

import numpy as np

from plisse.solve.principal.target import Target

__all__ = ["PrincipalNumbers", "pack", "seed_columns", "start", "trio_columns", "unpack", "with_terms"]


@dataclass(frozen=True)
class PrincipalNumbers:
    """A principal structure with m creases in 1 + 2 K + 3 (m − 3) numbers, independent of the resolution.

    Crease `seed` is the smooth curve through its guide, displaced by `displacement` (2, K) amplitudes
    along its two normals and opened by 2 `half_opening`. Row l of `creases` (m, 3) has distance t,
    direction β and signed fold angle φ of crease l, in the middle of open creases, at vertex 0 of closed
    ones; rows of the seed and the rims are unused.
    """

    seed: int
    half_opening: float
    displacement: np.ndarray
    creases: np.ndarray


def start(target: Target) -> PrincipalNumbers:
    """What the guides suggest: typical widths, directions along the seed, and their fold angles."""
    creases = np.stack([target.widths, np.full_like(target.widths, np.pi / 2), target.folds], axis=1)
    return PrincipalNumbers(target.seed, target.half_opening, np.zeros((2, 0)), creases)


def with_terms(numbers: PrincipalNumbers, terms: int) -> PrincipalNumbers:
    """The same structure with `terms` displacement coefficients per normal."""
    displacement = np.zeros((2, terms))
    kept = min(terms, numbers.displacement.shape[1])
    displacement[:, :kept] = numbers.displacement[:, :kept]
    return replace(numbers, displacement=displacement)


def pack(target: Target, numbers: PrincipalNumbers) -> np.ndarray:
    """Unknowns of order 1: half opening, displacement, then (t / width, β, φ) of every crease."""
    creases = numbers.creases / _scale(target)
    return np.concatenate([[numbers.half_opening], numbers.displacement.ravel(), creases.ravel()])


def unpack(target: Target, unknowns: np.ndarray) -> PrincipalNumbers:
    """The inverse of `pack`."""
    count = 3 * len(target.widths)
    creases = unknowns[-count:].reshape(-1, 3) * _scale(target)
    return PrincipalNumbers(target.seed, float(unknowns[0]), unknowns[1:-count].reshape(2, -1), creases)


def _scale(target: Target) -> np.ndarray:
    """Units (m, 3) of (t, β, φ)."""
    return np.stack([target.widths, *np.ones((2, len(target.widths)))], axis=1)


def seed_columns(target: Target, unknowns: np.ndarray) -> np.ndarray:
    """Where the numbers of the seed are."""
    return np.arange(len(unknowns) - 3 * len(target.widths))


def trio_columns(target: Target, unknowns: np.ndarray, crease: int) -> np.ndarray:
    """Where (t / width, β, φ) of a crease are."""
    return len(unknowns) - 3 * (len(target.widths) - crease) + np.arange(3)

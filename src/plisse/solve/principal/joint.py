"""All numbers at once: normal equations of a whole march by batched differences.

The batch of a strip has one member per unknown that can have changed it, so it grows by three with every
crease.
"""

import numpy as np

from plisse.solve.principal.closed import close_crease, closed_crease, closing_gaps, follow
from plisse.solve.principal.levenberg import DIFFERENCE, NormalEquations, minimise
from plisse.solve.principal.march import Crease, next_crease
from plisse.solve.principal.numbers import PrincipalNumbers, pack, seed_columns, trio_columns, unpack
from plisse.solve.principal.residuals import off_guide, regularity_hinges, rim_hinges, rim_miss
from plisse.solve.principal.strip import Strip
from plisse.solve.principal.target import Target

__all__ = ["joint_equations", "joint_fit", "seed_batch"]


def joint_fit(target: Target, numbers: PrincipalNumbers, iterations: int, stiffness: float = 0.02,
              tolerance: float = 1e-3) -> tuple[PrincipalNumbers, float]:
    """Least squares for all numbers of the target's creases; `stiffness` holds the seed in place."""
    unknowns, cost = minimise(lambda x, slopes: joint_equations(target, x, slopes, stiffness),
                              pack(target, numbers), iterations, tolerance)
    return unpack(target, unknowns), cost


def joint_equations(target: Target, unknowns: np.ndarray, slopes: bool, stiffness: float) -> NormalEquations:
    """Distances from all guides and all hinges at packed unknowns (size,), with derivatives if `slopes`."""
    equations = NormalEquations(unknowns)
    columns = seed_columns(target, unknowns) if slopes else np.arange(0)
    with np.errstate(all="ignore"):
        points, strips = seed_batch(target, _displaced(unknowns, columns))
        equations.add(off_guide(target, target.seed, points), columns)
        for strip, side in zip(strips, target.sides(), strict=True):
            _march_side(target, equations, strip, list(side), columns, slopes)
    equations.add_quadratic(_stiffness(target, unknowns, stiffness))
    return equations


def seed_batch(target: Target, unknowns: np.ndarray) -> tuple[np.ndarray, tuple[Strip, Strip]]:
    """Seed polylines (3, B, n) and both strips for a batch of packed unknowns (B, size)."""
    numbers = [unpack(target, row) for row in unknowns]
    displacement = np.stack([row.displacement for row in numbers])
    half_opening = np.array([row.half_opening for row in numbers])
    return target.seed_points(displacement), target.seed_strips(displacement, half_opening)


def _march_side(target: Target, equations: NormalEquations, strip: Strip, side: list[int],
                columns: np.ndarray, slopes: bool) -> None:
    """Add all creases of one side; the last one is a free rim."""
    if not side:
        return
    for crease in side[:-1]:
        trio = trio_columns(target, equations.numbers, crease)
        if target.closed:
            _close(target, equations.numbers, strip, crease, trio)
        own = (trio[:1] if target.closed else trio) if slopes else trio[:0]
        strip, columns = _widened(strip, len(own)), np.concatenate([columns, own])
        found = _found(target, equations.numbers, strip, crease, trio, own)
        equations.add(off_guide(target, crease, found.beyond.points), columns)
        for hinge in regularity_hinges(target, crease, strip, found):
            equations.add(hinge, columns)
        strip = found.beyond
    miss, reach = rim_miss(target, side[-1], strip)
    for block in (miss, *rim_hinges(target, side[-1], strip, reach)):
        equations.add(block, columns)


def _close(target: Target, unknowns: np.ndarray, strip: Strip, crease: int, trio: np.ndarray) -> None:
    """Write the (β, φ) that close a crease at its distance into the unknowns."""
    distance = unknowns[trio[:1]] * target.widths[crease]
    unknowns[trio[1:]] = close_crease(strip.column(slice(1)), distance, unknowns[trio[1:]][None])[0][0]


def _found(target: Target, unknowns: np.ndarray, strip: Strip, crease: int, trio: np.ndarray,
           own: np.ndarray) -> Crease:
    """The crease for the strip's whole batch; the last members have its own numbers displaced."""
    numbers = np.repeat(unknowns[trio][None], strip.points.shape[1], axis=0)
    numbers[len(numbers) - len(own):, :len(own)] += DIFFERENCE * np.eye(len(own))
    distance = numbers[:, 0] * target.widths[crease]
    if not target.closed:
        return next_crease(strip, distance, numbers[:, 1], numbers[:, 2])
    _, slopes = closing_gaps(strip.column(slice(1)), distance[:1], numbers[:1, 1:])
    numbers[1:, 1:] = follow(strip.column(slice(1, None)), distance[1:], numbers[0, 1:], slopes[0])
    return closed_crease(strip, distance, numbers[:, 1], numbers[:, 2])


def _widened(strip: Strip, members: int) -> Strip:
    """The batch with `members` more copies of its first member."""
    copies = (np.repeat(array[:, :1], members, axis=1) for array in strip)
    return Strip(*(np.concatenate(pair, axis=1) for pair in zip(strip, copies, strict=True)))


def _displaced(unknowns: np.ndarray, columns: np.ndarray) -> np.ndarray:
    """The unknowns, followed by copies with one of the columns displaced."""
    return unknowns + DIFFERENCE * np.eye(len(unknowns))[np.concatenate([[0], columns])] * (
        np.arange(len(columns) + 1) > 0)[:, None]


def _stiffness(target: Target, unknowns: np.ndarray, stiffness: float) -> np.ndarray:
    """Diagonal that keeps displacement coefficients small, high orders more than low ones."""
    terms = (len(seed_columns(target, unknowns)) - 1) // 2
    order = np.arange(terms)
    growth = 1 + ((order + 1) // 2) ** 4 / 20 if target.closed else 1 + order**4 / 20
    diagonal = np.zeros(len(unknowns))
    if terms:
        diagonal[1:1 + 2 * terms] = np.tile(stiffness * target.samples / terms * growth, 2)
    return diagonal

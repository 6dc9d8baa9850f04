"""First numbers, crease by crease outwards from the seed: each near its guide, looking one guide ahead."""

from dataclasses import replace
from itertools import pairwise

import numpy as np

from plisse.solve.principal.levenberg import DIFFERENCE, NormalEquations, minimise
from plisse.solve.principal.march import next_crease
from plisse.solve.principal.numbers import PrincipalNumbers
from plisse.solve.principal.residuals import off_guide, regularity_hinges, rim_miss, rim_reach
from plisse.solve.principal.strip import Strip
from plisse.solve.principal.target import Target

__all__ = ["greedy_fit", "opened"]

_LOOK_AHEAD = 0.3  # weight of the distance between rulings and the next guide
_ITERATIONS = 12
_OPENINGS = np.linspace(-0.35, 0.35, 15)
_DIRECTIONS = (0.5, 2.6)


def opened(target: Target, numbers: PrincipalNumbers) -> PrincipalNumbers:
    """The half opening whose rulings, on both sides of the seed, pass nearest to the neighbouring guides."""
    halves = numbers.half_opening + _OPENINGS
    displacement = np.repeat(numbers.displacement[None], len(halves), axis=0)
    cost = np.zeros(len(halves))
    with np.errstate(all="ignore"):
        for strip, side in zip(target.seed_strips(displacement, halves), target.sides(), strict=True):
            if side:
                miss, reach = _each_rim(target, side[0], strip)
                cost += np.nan_to_num(np.minimum(np.abs(miss), 3) + (reach < 0), nan=4.0).sum(axis=-1)
    return replace(numbers, half_opening=float(halves[np.argmin(cost)]))


def greedy_fit(target: Target, numbers: PrincipalNumbers,
               known: frozenset[int] = frozenset()) -> PrincipalNumbers:
    """Fit every inner crease of the target that is not `known`, in the order of the march."""
    creases = numbers.creases.copy()
    half, displacement = np.array([numbers.half_opening]), numbers.displacement[None]
    with np.errstate(all="ignore"):
        for strip, side in zip(target.seed_strips(displacement, half), target.sides(), strict=True):
            for crease, following in pairwise(side):
                if crease not in known:
                    creases[crease] = _fit_crease(target, crease, following, strip, creases[crease, 2])
                strip = next_crease(strip, *creases[crease][:, None]).beyond
    return replace(numbers, creases=creases)


def _each_rim(target: Target, crease: int, strip: Strip) -> tuple[np.ndarray, np.ndarray]:
    """`rim_miss` with the feet of every member of the batch."""
    pairs = [rim_miss(target, crease, strip.column(slice(k, k + 1))) for k in range(strip.points.shape[1])]
    misses, reaches = (np.concatenate(part) for part in zip(*pairs, strict=True))
    return misses, reaches


def _fit_crease(target: Target, crease: int, following: int, strip: Strip, fold: float) -> np.ndarray:
    """Robust three-parameter fit of (t, β̄, φ) of one crease."""
    scale = np.array([target.widths[crease], 1.0, 1.0])
    first = np.array([*_first_guess(target, crease, strip), fold]) / scale
    batch = Strip(*(np.repeat(array, 4, axis=1) for array in strip))

    def equations(numbers: np.ndarray, slopes: bool) -> NormalEquations:
        result = NormalEquations(numbers)
        displaced = numbers + DIFFERENCE * np.eye(4)[:, 1:] if slopes else numbers[None]
        members = batch if slopes else strip
        found = next_crease(members, *(displaced * scale).T)
        columns = np.arange(3 if slopes else 0)
        result.add(off_guide(target, crease, found.beyond.points), columns, robust=True)
        result.add(_LOOK_AHEAD * rim_miss(target, following, found.beyond)[0], columns, robust=True)
        for hinge in regularity_hinges(target, crease, members, found):
            result.add(hinge, columns)
        return result

    return minimise(equations, first, _ITERATIONS, tolerance=1e-4, damping=1e-3)[0] * scale


def _first_guess(target: Target, crease: int, strip: Strip) -> tuple[float, float]:
    """Distance and direction in the middle: where the ruling is nearest to the guide; its tangent."""
    middle = strip.points.shape[-1] // 2
    width = target.widths[crease]
    near = rim_reach(target, crease, strip)[1][0, max(0, middle - 3):middle + 4]
    distance = float(np.clip(np.nan_to_num(np.median(near), nan=width), 0.4 * width, 2 * width))
    ruling, normal = strip.rulings[:, 0, middle], strip.normals[:, 0, middle]
    point = strip.points[:, 0, middle] + distance * ruling
    _, tangent = target.polylines[crease].feet(point[:, None])
    direction = np.arctan2(tangent[:, 0] @ np.cross(ruling, normal), -tangent[:, 0] @ ruling)
    return distance, float(np.clip(direction, *_DIRECTIONS))

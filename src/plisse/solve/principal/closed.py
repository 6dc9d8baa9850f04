"""Closed creases: the crease on a closed strip that closes, at a prescribed distance (§2.5, Figs 12, 16, 26).

Once around the strip both the direction β and the distance t have to return. The total Möbius map is
almost parabolic: its fixed direction is ill-determined by a given fold angle. So t is prescribed and (β,
φ) are found by Newton's method.
"""

import numpy as np

from plisse.solve.principal.march import Crease, distance_maps, fold_maps, fold_over, ruling_folds
from plisse.solve.principal.moebius import affine_chain, homogeneous_chain
from plisse.solve.principal.strip import Strip

__all__ = ["close_crease", "closed_crease", "closing_gaps", "follow"]

_STEP = 1e-6  # of the central differences
_LONGEST = 0.2  # radians per Newton step


def closed_crease(strip: Strip, distance: np.ndarray, direction: np.ndarray, fold: np.ndarray) -> Crease:
    """The crease with numbers (t, β, φ), each (B,), prescribed at vertex and face 0; they must close it."""
    distances, sine, cosine, _ = _around(strip, ruling_folds(strip, closed=True), distance, direction, fold)
    distances = distances[..., :-1]
    return Crease(distances, sine, fold_over(strip, distances, sine, cosine, fold, closed=True))


def close_crease(strip: Strip, distance: np.ndarray, start: np.ndarray, iterations: int = 12,
                 tolerance: float = 1e-12) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (β, φ) (B, 2) that close the crease at distance (B,), and the remaining gaps (B,).

    `start` (B, 2) is a guess. At most `iterations` Newton steps; the last one is taken from below the
    tolerance.
    """
    best = np.array(start, dtype=float)
    least = np.full(len(best), np.inf)
    numbers = best
    for _ in range(iterations):
        gap, slopes = closing_gaps(strip, distance, numbers)
        size = np.abs(gap).max(axis=-1)
        better, done = size < least, least.max() < tolerance
        best, least = np.where(better[:, None], numbers, best), np.where(better, size, least)
        if done or not better.any():
            break
        numbers = best - _bounded(_solve(slopes, gap))
    return best, least


def closing_gaps(strip: Strip, distance: np.ndarray, numbers: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """By how much creases (B, 2) miss themselves (B, 2), and the derivatives (B, 2, 2) of that."""
    folds = ruling_folds(strip, closed=True)
    shifts = _STEP * np.array([[0, 0], [1, 0], [0, 1], [-1, 0], [0, -1]])
    displaced = (numbers + shifts[:, None]).reshape(-1, 2)
    members = Strip(*(np.tile(array, (1, 5, 1)) for array in strip))
    gaps = _gaps(members, np.tile(folds, (5, 1)), np.tile(distance, 5), displaced).reshape(5, -1, 2)
    return gaps[0], np.stack([gaps[1] - gaps[3], gaps[2] - gaps[4]], axis=-1) / (2 * _STEP)


def follow(strip: Strip, distance: np.ndarray, numbers: np.ndarray, slopes: np.ndarray,
           steps: int = 2) -> np.ndarray:
    """(β, φ) (B, 2) of closed creases that hardly differ from one of known numbers (2,), slopes (2, 2)."""
    folds = ruling_folds(strip, closed=True)
    moved = np.repeat(numbers[None], len(distance), axis=0)
    for _ in range(steps):
        moved = moved - _bounded(_solve(slopes[None], _gaps(strip, folds, distance, moved)))
    return moved


def _bounded(step: np.ndarray) -> np.ndarray:
    """The step (B, 2), shortened to at most 0.2 rad; none where it is not finite."""
    step = np.nan_to_num(step, nan=0.0, posinf=0.0, neginf=0.0)
    longest = np.abs(step).max(axis=-1, keepdims=True)
    return step * np.minimum(1.0, _LONGEST / np.maximum(longest, _LONGEST))


def _solve(slopes: np.ndarray, gap: np.ndarray) -> np.ndarray:
    """The 2 × 2 systems by Cramer's rule; nan where singular."""
    a, b, c, d = slopes[:, 0, 0], slopes[:, 0, 1], slopes[:, 1, 0], slopes[:, 1, 1]
    determinant = a * d - b * c
    adjugate = np.stack([d * gap[:, 0] - b * gap[:, 1], a * gap[:, 1] - c * gap[:, 0]], axis=-1)
    return adjugate / determinant[:, None]


def _gaps(strip: Strip, folds: np.ndarray, distance: np.ndarray, numbers: np.ndarray) -> np.ndarray:
    """By how much direction and relative distance (B, 2) miss themselves after one turn."""
    distances, _, _, turned = _around(strip, folds, distance, numbers[:, 0], numbers[:, 1])
    return np.stack([turned, distances[..., -1] / distance - 1], axis=-1)


def _around(strip: Strip, folds: np.ndarray, distance: np.ndarray, direction: np.ndarray,
            fold: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Distances (B, n + 1), sin β and cos β (B, n) once around from vertex 0, and the change of β (B,)."""
    sine, cosine = start = np.sin(direction / 2), np.cos(direction / 2)
    u, v = homogeneous_chain(fold_maps(strip, folds, np.tan(fold / 2), closed=True), *start)
    last_u, last_v = u[..., -1], v[..., -1]
    turned = 2 * np.arctan2(last_u * cosine - last_v * sine, last_v * cosine + last_u * sine)
    u, v = (np.concatenate([first[..., None], states[..., :-1]], axis=-1)
            for first, states in zip(start, (u, v), strict=True))
    square = u * u + v * v
    sine, cosine = 2 * u * v / square, (v * v - u * u) / square
    after = affine_chain(*distance_maps(strip, sine, cosine, closed=True), distance)
    return np.concatenate([distance[..., None], after], axis=-1), sine, cosine, turned

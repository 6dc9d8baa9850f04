"""The construction of principal pleated structures, crease by crease, exact by construction (§2.4, §2.5).

Given a strip and a signed fold angle for the next crease q = p + t r, let β[i] be the angle at q[i]
between the ruling back to p[i] and the edge to q[i+1], δ[i] the angle between rulings i and i+1, φ_c and
φ_r[i] the folds at the crease and at the ruling, T = tan(φ_r/2) / tan(φ_c/2). All four conditions at q[i]
together say

    tan(β[i]/2) = (1 − T)/(1 + T) · tan((β[i−1] − δ[i−1])/2),

so one number, the direction in the middle of the crease, gives all directions, and a second, the distance
there, all distances. Three numbers (t, β̄, φ_c) determine a crease; they are prescribed in the middle, β̄
as the mean of the two directions there, so that they do not depend on the number of samples.
"""

from typing import NamedTuple

import numpy as np

from plisse.geometry.components import cross, dot, unit
from plisse.solve.principal.moebius import Matrix, affine_chain, homogeneous_chain, inverse, sliced
from plisse.solve.principal.strip import Strip, rulings_between

__all__ = ["Crease", "distance_maps", "fold_maps", "fold_over", "next_crease", "ruling_folds"]


class Crease(NamedTuple):
    """A crease found on a strip: distances along the rulings (B, n), sin β (B, faces), the strip beyond."""

    distances: np.ndarray
    sine: np.ndarray
    beyond: Strip


def next_crease(strip: Strip, distance: np.ndarray, direction: np.ndarray, fold: np.ndarray) -> Crease:
    """The crease on an open strip with numbers (t, β̄, φ), each (B,), prescribed at its middle vertex."""
    middle = strip.points.shape[-1] // 2
    folds = ruling_folds(strip)
    half_fold = np.tan(fold / 2)
    at_middle = -folds[..., middle - 1] / half_fold * np.sin(direction)
    state = 0.5 * (direction + np.arcsin(np.clip(at_middle, -1, 1)))
    sine, cosine = _directions(fold_maps(strip, folds, half_fold), np.sin(state), np.cos(state), middle)
    distances = _distances(*distance_maps(strip, sine, cosine), distance, middle)
    return Crease(distances, sine, fold_over(strip, distances, sine, cosine, fold))


def ruling_folds(strip: Strip, closed: bool = False) -> np.ndarray:
    """tan(φ_r/2) at rulings: (B, n − 2) inner ones of an open strip, (B, n) of a closed one from ruling 1 on.

    The sign is the one for which angles add up to 2π beyond the next crease.
    """
    if closed:
        before, after, rulings = strip.normals, np.roll(strip.normals, -1, -1), np.roll(strip.rulings, -1, -1)
    else:
        before, after, rulings = strip.normals[..., :-1], strip.normals[..., 1:], strip.rulings[..., 1:-1]
    return -dot(cross(before, after - before), rulings) / (1 + dot(before, after))


def fold_maps(strip: Strip, folds: np.ndarray, half_fold: np.ndarray, closed: bool = False) -> Matrix:
    """Matrices (B, k) that take (sin β/2, cos β/2) of a face to the next one, over the rulings of `folds`."""
    rulings = strip.rulings
    following = np.roll(rulings, -1, -1) if closed else rulings[..., 1:-1]
    faces = slice(None) if closed else slice(None, -1)
    rulings = rulings if closed else rulings[..., :-2]
    cosine = 1 + dot(rulings, following)
    sine = dot(cross(rulings, following - rulings), strip.normals[..., faces])
    sign = np.where(half_fold < 0, -1.0, 1.0)[..., None]
    minus, plus = (half_fold[..., None] - folds) * sign, (half_fold[..., None] + folds) * sign
    return minus * cosine, -minus * sine, plus * sine, plus * cosine


def distance_maps(strip: Strip, sine: np.ndarray, cosine: np.ndarray,
                  closed: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Factor and shift (B, faces) of t[i+1] = factor t[i] + shift: the edge from q[i] has direction β[i]."""
    if closed:
        points, rulings = strip.points, strip.rulings
        next_points, next_rulings = np.roll(points, -1, -1), np.roll(rulings, -1, -1)
    else:
        points, rulings = strip.points[..., :-1], strip.rulings[..., :-1]
        next_points, next_rulings = strip.points[..., 1:], strip.rulings[..., 1:]
    across = cross(_edges(strip, sine, cosine), strip.normals)
    slope = dot(next_rulings, across)
    return dot(rulings, across) / slope, dot(points - next_points, across) / slope


def fold_over(strip: Strip, distances: np.ndarray, sine: np.ndarray, cosine: np.ndarray, fold: np.ndarray,
              closed: bool = False) -> Strip:
    """The strip beyond the crease at distances (B, n), in directions β (B, faces): faces turn on edges."""
    points = strip.points + distances * strip.rulings
    edges = unit(_edges(strip, sine, cosine))
    backward = unit(cross(edges, strip.normals))
    flat = cross(backward, edges)
    cos, sin = np.cos(fold)[..., None], np.sin(fold)[..., None]
    normals = cos * flat - sin * backward
    inward = -cos * backward - sin * flat
    return Strip(points, edges, normals, rulings_between(edges, inward, normals, closed))


def _edges(strip: Strip, sine: np.ndarray, cosine: np.ndarray) -> np.ndarray:
    """Unit edges (3, B, faces) of the crease: edge i makes the angle β[i] with ruling i, taken backward."""
    rulings = strip.rulings[..., :sine.shape[-1]]
    return sine * cross(rulings, strip.normals) - cosine * rulings


def _directions(maps: Matrix, sine: np.ndarray, cosine: np.ndarray,
                middle: int) -> tuple[np.ndarray, np.ndarray]:
    """sin β and cos β (B, n − 1) from the half-angle state in face `middle`, outwards on both sides."""
    forward = homogeneous_chain(sliced(maps, slice(middle, None)), sine, cosine)
    reverse = slice(middle - 1, None, -1)
    back = homogeneous_chain(inverse(sliced(maps, reverse)), sine, cosine)
    u, v = (np.concatenate([left[..., ::-1], start[..., None], right], axis=-1)
            for left, start, right in zip(back, (sine, cosine), forward, strict=True))
    square = u * u + v * v
    return 2 * u * v / square, (v * v - u * u) / square


def _distances(factor: np.ndarray, shift: np.ndarray, start: np.ndarray, middle: int) -> np.ndarray:
    """Distances (B, n) along the rulings from the one at vertex `middle`, outwards on both sides."""
    forward = affine_chain(factor[..., middle:], shift[..., middle:], start)
    undo = 1 / factor[..., :middle][..., ::-1]
    back = affine_chain(undo, -undo * shift[..., :middle][..., ::-1], start)
    return np.concatenate([back[..., ::-1], start[..., None], forward], axis=-1)

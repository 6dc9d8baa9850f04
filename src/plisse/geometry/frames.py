"""Moving frames of polylines: curvature, torsion and binormals that pass through inflections (§2.1, §3.2)."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.linalg import lapack

from plisse.errors import Infeasible
from plisse.geometry import components
from plisse.geometry.polyline import segments
from plisse.geometry.vectors import cross, dot, norm, unit

__all__ = ["Frame", "curvature", "curvature_vectors", "regularised_frame",
           "tangents_and_binormals", "torsion"]


@dataclass(frozen=True, eq=False)
class Frame:
    """Tangent e1, principal normal e2 and binormal e3, each (N, 3)."""

    tangent: np.ndarray
    principal_normal: np.ndarray
    binormal: np.ndarray


def curvature_vectors(points: np.ndarray, closed: bool = False) -> np.ndarray:
    """κ e3 (N, 3) of the circles through three successive points; 0 at open ends."""
    before, after = segments(points, closed)
    length_before, length_after = norm(before), norm(after)
    chord = norm(before + after)
    inner = 2 * cross(before, after) / (length_before * length_after * chord)[:, None]
    return inner if closed else np.concatenate([np.zeros((1, 3)), inner, np.zeros((1, 3))])


def curvature(points: np.ndarray, closed: bool = False) -> np.ndarray:
    """Curvature κ (N,), copied outwards to open ends."""
    values = norm(curvature_vectors(points, closed))
    return values if closed else np.concatenate([values[1:2], values[1:-1], values[-2:-1]])


def torsion(points: np.ndarray, closed: bool = False) -> np.ndarray:
    """Torsion τ (N,) by the turn of the osculating planes, copied outwards to open ends."""
    binormal = unit(curvature_vectors(points, closed))
    if closed:
        following = np.roll(binormal, -1, axis=0)
        edge = np.roll(points, -1, axis=0) - points
    else:
        binormal = binormal[1:-1]
        following, binormal = binormal[1:], binormal[:-1]
        edge = np.diff(points, axis=0)[1:-1]
    turn = np.arctan2(dot(np.cross(binormal, following), unit(edge)), dot(binormal, following)) / norm(edge)
    if closed:
        return 0.5 * (turn + np.roll(turn, 1))
    inner = 0.5 * (turn[1:] + turn[:-1]) if len(turn) > 1 else turn
    missing = len(points) - len(inner)
    return np.concatenate([np.repeat(inner[:1], missing // 2), inner, np.repeat(inner[-1:], missing - missing // 2)])


def regularised_frame(points: np.ndarray, closed: bool, smoothing: float) -> Frame:
    """Frame whose binormal minimises Σ κ²|E − e3|² + mean(κ²) ℓ⁴ |E″|², for any resolution alike.

    `smoothing` is the length ℓ in model units. The weights κ² let E pass through weak inflections (§3.2's
    regulariser made independent of the number of points).
    """
    tangent, binormal, _ = tangents_and_binormals(np.ascontiguousarray(points.T), closed, smoothing)
    return Frame(tangent.T, components.cross(binormal, tangent).T, binormal.T)


def tangents_and_binormals(points: np.ndarray, closed: bool, smoothing: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """e1 and e3 (3, N) of `regularised_frame` for points (3, N), and κ² (N,), 0 at open ends.

    Evolution asks for them hundreds of times.
    """
    chain = np.concatenate((points[:, -1:], points, points[:, :1]), axis=1) if closed else points
    edges = chain[:, 1:] - chain[:, :-1]
    square = components.dot(edges, edges)
    length, slopes = np.sqrt(square), edges / square
    along, chord = slopes[:, :-1] + slopes[:, 1:], chain[:, 2:] - chain[:, :-2]
    turn = components.cross(edges[:, :-1], edges[:, 1:])
    scale = 4 / (square[:-1] * square[1:] * components.dot(chord, chord))
    weight = scale * components.dot(turn, turn)
    count = len(weight)
    mean, step = float(np.add.reduce(weight)) / count, float(np.add.reduce(length) - 0.5 * (length[0] + length[-1])) / count
    if not mean > 0:
        raise Infeasible("a guiding curve becomes straight and has no side to evolve to; bend the seed curve more")
    vectors = turn * np.sqrt(scale * weight)
    if not closed:
        weight, vectors, along = _with_ends(weight, vectors, along, edges, slopes)
    smooth = _solve_banded(weight, (smoothing / step) ** 4 * mean, vectors, closed)
    tangent = along / components.norm(along)
    binormal = smooth - components.dot(smooth, tangent) * tangent
    binormal /= components.norm(binormal)
    return tangent, binormal, weight


def _with_ends(weight: np.ndarray, vectors: np.ndarray, along: np.ndarray, edges: np.ndarray,
               slopes: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Squared curvature, its vectors and tangents continued to open ends: no curvature, and tangents of the end circles."""
    count = len(weight) + 2
    every, last = np.zeros((7, count)), count - 1
    every[0, 1:-1], every[1:4, 1:-1], every[4:, 1:-1] = weight, vectors, along
    inner, edge, slope = along[:, ::max(count - 3, 1)], edges[:, ::count - 2], slopes[:, ::count - 2]
    every[4:, ::last] = 2 * components.dot(inner, edge) * slope - inner
    return every[0], every[1:4], every[4:]


def _solve_banded(weight: np.ndarray, stiffness: float, right: np.ndarray, closed: bool) -> np.ndarray:
    """Solve (diag(weight) + stiffness D2ᵀD2) x = right (3, N), D2 second differences with free or periodic ends."""
    count = len(weight)
    if not closed:
        bands = stiffness * _second_difference_bands(count)
        bands[2] += weight
        return _definite(bands, right)
    order, bands = _periodic_second_difference_bands(count)
    bands = stiffness * bands
    bands[4] += weight[order]
    solution = np.empty_like(right)
    solution[:, order] = _definite(bands, right[:, order])
    return solution


def _definite(bands: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Solutions (3, N) of a positive definite system given by its upper bands."""
    _, solution, info = lapack.dpbsv(bands, right.T)
    if info:
        raise Infeasible("binormals of a guiding curve are not determined; its points coincide or are not finite")
    return solution.T


@lru_cache(maxsize=16)
def _second_difference_bands(count: int) -> np.ndarray:
    """Upper bands (3, count) of D2ᵀD2 for free ends, not to be written to."""
    main, first = np.full(count, 6.0), np.full(count, -4.0)
    main[[0, -1]], main[[1, -2]] = 1, 5
    first[[1, -1]] = -2
    if count == 3:
        main[1] = 4
    if count == 4:
        main[[1, 2]], first[2] = 5, -4
    return np.stack([np.ones(count), first, main])


@lru_cache(maxsize=16)
def _periodic_second_difference_bands(count: int) -> tuple[np.ndarray, np.ndarray]:
    """The order 0, n−1, 1, n−2, … in which a ring has a narrow band, and the upper bands (5, count) of its D2ᵀD2."""
    order = np.empty(count, np.int64)
    order[::2] = np.arange((count + 1) // 2)
    order[1::2] = count - 1 - np.arange(count // 2)
    rank, here, bands = np.argsort(order), np.arange(count), np.zeros((5, count))
    for shift, value in ((0, 6.0), (1, -4.0), (2, 1.0)):
        one, other = rank[here], rank[(here + shift) % count]
        np.add.at(bands, (4 - np.abs(one - other), np.maximum(one, other)), value)
    return order, bands

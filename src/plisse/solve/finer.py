"""More columns for a structure over a whole surface: displacements are interpolated along the creases, then polished.

Solving with many columns at once fails more often and takes longer; from a solved coarse structure a polish suffices.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import make_interp_spline

from plisse.geometry.vectors import unit
from plisse.measure.intersection import intersecting_faces
from plisse.measure.regularity import OPENING_RANGE
from plisse.solve.anneal import SLOWLY
from plisse.solve.masked import CONVERGED, MaskedGrid, irregular, relaxed
from plisse.structure.pattern import interpolate_along

__all__ = ["Sampled", "finer"]

HOLD = 0.1
LAST = SLOWLY[4:]


@dataclass(frozen=True, eq=False)
class Sampled:
    """A solved masked grid: `vertices` (V, 3) of its part, and over the whole grid (n, m, 3) the zigzag it started from,
    normals of the reference and directions across."""

    grid: MaskedGrid
    vertices: np.ndarray
    zigzag: np.ndarray
    normals: np.ndarray
    outward: np.ndarray


def finer(coarse: Sampled, samples: int, least_opening: float = OPENING_RANGE[0]) -> Sampled:
    """The structure with its columns doubled until there are `samples`, or as often as it stays exact and regular."""
    while coarse.grid.shape[1] < samples:
        rest = _doubled(coarse)
        zigzag, normals = (field.reshape(-1, 3) for field in (rest.zigzag, rest.normals))
        whole = zigzag.copy()
        whole[rest.grid.used] = rest.vertices
        for weights in ((), LAST):
            vertices, defect = relaxed(rest.grid, zigzag, whole, normals, weights, HOLD)
            if defect < CONVERGED and not irregular(rest.grid, vertices, least_opening).any() \
                    and not len(intersecting_faces(rest.grid.topology, vertices)):
                break
        else:
            return coarse
        coarse = Sampled(rest.grid, vertices, rest.zigzag, rest.normals, rest.outward)
    return coarse


def _doubled(coarse: Sampled) -> Sampled:
    """The same structure with a column between every two, by splines along the creases; not exact."""
    part, closed = coarse.grid, coarse.grid.closed
    rows, columns = part.shape
    count = 2 * columns - (not closed)
    parameters = np.linspace(0, 1, count, endpoint=not closed)
    zigzag, normals, outward = (interpolate_along(field, closed)(parameters).swapaxes(0, 1)
                                for field in (coarse.zigzag, coarse.normals, coarse.outward))
    seams = tuple(2 * seam for seam in part.seams)
    grid = MaskedGrid.of((rows, count), closed, np.repeat(part.mask, 2, axis=1), seams, part.is_ring)
    displacement = np.full((rows, columns, 3), np.nan)
    displacement.reshape(-1, 3)[part.used] = coarse.vertices - coarse.zigzag.reshape(-1, 3)[part.used]
    fine = np.stack([_between(row, closed, part.seams) for row in displacement])
    vertices = (zigzag + fine).reshape(-1, 3)[grid.used]
    return Sampled(grid, vertices, zigzag, unit(normals), unit(outward))


def _between(row: np.ndarray, closed: bool, seams: tuple[int, ...]) -> np.ndarray:
    """Values (2m or 2m − 1, 3) at twice as many columns as (m, 3), by splines over the runs that are known."""
    count = len(row)
    fine = np.full((2 * count - (not closed), 3), np.nan)
    if closed and np.isfinite(row).all() and not seams:
        return interpolate_along(row[None], True, 3)(np.linspace(0, 1, 2 * count, endpoint=False))[:, 0]
    for run in _runs(np.isfinite(row[:, 0]), closed, seams):
        values = row[run % count]
        at = np.linspace(0, len(run) - 1, 2 * len(run) - 1)
        spline = make_interp_spline(np.arange(len(run)), values, k=3 if len(run) > 3 else 1) if len(run) > 1 else None
        fine[np.arange(2 * run[0], 2 * run[-1] + 1) % len(fine)] = values if spline is None else spline(at)
    return fine


def _runs(known: np.ndarray, closed: bool, seams: tuple[int, ...]) -> Iterator[np.ndarray]:
    """Successive columns that are known, cut at seams; on closed rows they may run over the end."""
    count = len(known)
    first = 0
    if closed:
        first = int(np.argmin(known)) if not known.all() else min(seams, default=0)
    order = first + np.arange(count + closed)
    there = known[order % count]
    begin = 0
    for k in range(1, len(order) + 1):
        ends = k == len(order) or not there[k]
        if there[k - 1] and (ends or order[k] % count in seams):
            yield order[begin:k if ends else k + 1]
            begin = k
        elif ends or not there[k - 1]:
            begin = k

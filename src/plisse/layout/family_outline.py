"""A family of curves cropped to the outline of its surface: a zigzag over all columns and a mask of usable quads."""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import norm
from plisse.layout.coverage import AreaSamples, located
from plisse.layout.crossing import Crossing, trajectories
from plisse.layout.family import Family
from plisse.layout.family_columns import placed
from plisse.layout.rectangle import GAPS, PROBES
from plisse.structure.masks import cleaned, grown

__all__ = ["Outlined", "outlined"]

LEAST_AREA = 0.02  # of a quad that must lie over the surface
FEWEST = 30


@dataclass(frozen=True, eq=False)
class Outlined:
    """A zigzag (m, n, 3), the surface's normals under it, the mask of quads that are wanted, whether columns close."""

    zigzag: np.ndarray
    normals: np.ndarray
    mask: np.ndarray
    closed: bool


def outlined(family: Family, surface: Surface, area: AreaSamples, amplitude: float, samples: int,
             inside: bool = False) -> Outlined:
    """The zigzag of an open family with `samples` columns, and the quads that meet the surface and their neighbours.

    With `inside` only quads within the boundary are kept. Raises Infeasible where hardly any quads are usable.
    """
    if family.closed:
        raise InvalidDesign("surface.crop = \"outline\" is for open families, and this one closes around the surface; "
                            "remove it")
    count, ranges = len(family.curves), family.ranges
    best, window, start = 0, (0.0, 0.0), 0
    for row in sorted({count // 2, count // 4, (3 * count) // 4, int(np.argmax(np.ptp(ranges, axis=1)))}):
        low, high = float(ranges[row, 0]), float(ranges[row, 1])
        at = np.linspace(low, high, PROBES, endpoint=not family.closed_curves)
        mask = _mask(family, surface, trajectories(family, row, at, past_ends=True), area, inside)
        if mask.sum() > best:
            columns = np.flatnonzero(mask.any(axis=0))
            ends = float(at[columns[0]]), float(at[min(columns[-1] + 1, PROBES - 1)])
            best, start, window = int(mask.sum()), row, (low, high) if family.closed_curves else ends
    at = np.linspace(*window, samples, endpoint=not family.closed_curves)
    crossing = trajectories(family, start, at, past_ends=True)
    mask = _mask(family, surface, crossing, area, inside)
    if mask.sum() < FEWEST:
        raise Infeasible(f"only {mask.sum()} quads of the family lie over the surface in good order; give another guide, "
                         "another theta, or a smaller width")
    points, normals, across = placed(family, surface, crossing, amplitude, smooth=False)
    side = np.where((np.arange(count) + family.above) % 2, 1.0, -1.0)[:, None, None]
    zigzag = points + amplitude * side * (np.cos(family.theta) * normals + np.sin(family.theta) * across)
    return Outlined(zigzag, normals, mask, family.closed_curves)


def _mask(family: Family, surface: Surface, crossing: Crossing, area: AreaSamples, inside: bool) -> np.ndarray:
    """Quads (m − 1, n − 1 or n) on the curves, in good order, that meet the surface or lie inside of it."""
    low, high = family.ranges.T[..., None]
    slack = 1e-9 * (high - low)
    there = np.full(crossing.at.shape, True) if family.closed_curves else \
        (crossing.at >= low - slack) & (crossing.at <= high + slack)
    if inside:
        there &= surface.project(crossing.points.reshape(-1, 3)).known.reshape(there.shape)
    usable = crossing.usable(family, GAPS)
    columns = usable.shape[1]
    corners = np.stack([part[:, :columns] for part in _corners(there)])
    usable &= corners.all(axis=0)
    if not inside:
        usable &= _meeting(family, crossing, area, columns)
    return cleaned(usable, family.closed_curves)


def _meeting(family: Family, crossing: Crossing, area: AreaSamples, columns: int) -> np.ndarray:
    """Quads (m − 1, columns) under which some of the sampled surface lies, and those around them."""
    quads = np.stack(_corners(crossing.points), axis=2)[:, :columns]
    found = located(area, quads.reshape(-1, 4, 3), 0.5 * float(family.spacing.mean()))
    under = np.bincount(found[found >= 0], area.areas[found >= 0], quads.shape[0] * columns).reshape(-1, columns)
    size = 0.5 * norm(np.cross(quads[:, :, 2] - quads[:, :, 0], quads[:, :, 3] - quads[:, :, 1]))
    return grown(under > LEAST_AREA * size, family.closed_curves)


def _corners(values: np.ndarray) -> tuple[np.ndarray, ...]:
    """Values at the four corners of every quad, around it; the last column is followed by the first."""
    following = np.roll(values, -1, axis=1)
    return values[:-1], following[:-1], following[1:], values[1:]

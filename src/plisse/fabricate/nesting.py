"""Pieces on sheets, each in the first place from the left where it fits, over a raster.

Every piece is grown by half the spacing and half a raster diagonal; when the raster points inside two such shapes
differ, the pieces themselves are at least the spacing apart.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.fft import irfft2, next_fast_len, rfft2

from plisse.errors import Infeasible
from plisse.fabricate.fitting import angle_that_fits
from plisse.fabricate.pieces import Placement

__all__ = ["Bed", "nest"]

CELLS = 360
TURNS, MANY, FEWER = 24, 12, 8
ROOMIEST = 10


@dataclass(frozen=True)
class Bed:
    """The part of every sheet that pieces may use: lower left corner and size in mm, pieces `spacing` mm apart."""

    corner: tuple[float, float]
    width: float
    height: float
    spacing: float

    @property
    def cell(self) -> float:
        """Side of the raster in mm."""
        return max(self.width, self.height) / CELLS

    @property
    def border(self) -> int:
        """Raster points around the bed that grown pieces may reach."""
        return 2 + int(np.ceil(self.spacing / 2 / self.cell + 1))

    @property
    def raster(self) -> tuple[int, int]:
        """Rows and columns of the raster with its border, in numbers that transform fast."""
        rows, columns = (next_fast_len(int(side / self.cell) + 2 * self.border + 2, True)
                         for side in (self.height, self.width))
        return rows, columns


def nest(outlines: list, bed: Bed) -> list[Placement]:
    """A placement for every outline (shapely polygons), larger pieces first, each on the first sheet that has a place.

    Of many sheets the ten emptiest are tried.

    Raises Infeasible where a piece does not fit the bed at all.
    """
    turns = TURNS if len(outlines) <= MANY else FEWER
    sheets: list[_Sheet] = []
    placements: dict[int, Placement] = {}
    for k in sorted(range(len(outlines)), key=lambda k: -outlines[k].area):
        shapes = _turned(outlines[k], bed, turns, k + 1)
        tried = sorted(sorted(range(len(sheets)), key=lambda number: -sheets[number].room)[:ROOMIEST])
        for number in (*tried, len(sheets)):
            if number == len(sheets):
                sheets.append(_Sheet(bed))
            found = sheets[number].put(shapes)
            if found is not None:
                placements[k] = Placement(number, *found)
                break
    return [placements[k] for k in range(len(outlines))]


@dataclass(frozen=True, eq=False)
class _Shape:
    """A piece turned by `angle`: its lower left corner, its size, and the raster points (rows, columns) it takes.

    `spectrum` is the conjugate transform of the mask on the raster of a sheet.
    """

    angle: float
    low: np.ndarray
    size: np.ndarray
    mask: np.ndarray
    raster: tuple[int, int]

    @cached_property
    def spectrum(self) -> np.ndarray:
        return np.conj(rfft2(self.mask, self.raster))


def _turned(outline, bed: Bed, turns: int, number: int) -> list[_Shape]:
    """A piece at all angles at which it fits an empty bed, the narrowest first."""
    from shapely import get_coordinates, transform

    points = get_coordinates(outline.exterior)
    best = angle_that_fits(points, bed.width, bed.height)
    if best is None:
        raise Infeasible(f"piece {number} with its flaps does not fit {bed.width:.1f} × {bed.height:.1f} mm; take larger "
                         "material or shorter tabs")
    grown = outline.simplify(bed.cell / 4).buffer(bed.spacing / 2 + bed.cell / np.sqrt(2) + bed.cell / 4)
    shapes = []
    for angle in best + np.linspace(0, 2 * np.pi, turns, endpoint=False):
        turn = Placement(0, float(angle), (0.0, 0.0))
        turned = turn.apply(points)
        low, size = turned.min(axis=0), np.ptp(turned, axis=0)
        if size[0] <= bed.width * (1 + 1e-9) and size[1] <= bed.height * (1 + 1e-9):
            shapes.append(_Shape(float(angle), low, size, _raster(transform(grown, turn.apply), low, size, bed), bed.raster))
    return sorted(shapes, key=lambda shape: (round(float(shape.size[0]), 6), shape.angle))


def _raster(grown, low: np.ndarray, size: np.ndarray, bed: Bed) -> np.ndarray:
    """Raster points inside a grown outline whose piece has its lower left corner at a raster point."""
    from shapely import contains_xy, prepare

    prepare(grown)
    count = np.ceil(size / bed.cell).astype(int) + 2 * bed.border
    x, y = (low[k] + bed.cell * (np.arange(count[k]) - bed.border) for k in (0, 1))
    inside = contains_xy(grown, *(axis.ravel() for axis in np.meshgrid(x, y)))
    return inside.reshape(len(y), len(x)).astype(np.float32)


class _Sheet:
    """Which raster points of a bed are taken, with an empty border around it."""

    def __init__(self, bed: Bed):
        self._bed = bed
        self._taken = np.zeros(bed.raster, np.float32)
        self._spectrum: np.ndarray | None = None

    @property
    def room(self) -> int:
        """Number of raster points that are free."""
        return self._taken.size - int(self._taken.sum())

    def put(self, shapes: list[_Shape]) -> tuple[float, tuple[float, float]] | None:
        """Angle and shift of the free place whose right end is farthest left, now taken; None where there is none."""
        best, right = None, np.inf
        for shape in shapes:
            place = self._leftmost(shape)
            if place is not None and place[0] * self._bed.cell + shape.size[0] < right - 1e-9:
                best, right = (shape, place), place[0] * self._bed.cell + shape.size[0]
            if best is not None and self._spectrum is None:
                break
        if best is None:
            return None
        shape, (column, row) = best
        rows, columns = shape.mask.shape
        self._taken[row:row + rows, column:column + columns] += shape.mask
        self._spectrum = rfft2(self._taken)
        x, y = (np.array(self._bed.corner) + np.array([column, row]) * self._bed.cell - shape.low).tolist()
        return shape.angle, (x, y)

    def _leftmost(self, shape: _Shape) -> tuple[int, int] | None:
        """Column and row of the free place that is farthest left, then lowest."""
        if self._spectrum is None:
            return 0, 0
        if shape.mask.sum() > self.room:
            return None
        room = ((np.array([self._bed.width, self._bed.height]) - shape.size) / self._bed.cell + 1e-9).astype(int)
        meets = irfft2(self._spectrum * shape.spectrum, self._taken.shape)
        free = meets[:room[1] + 1, :room[0] + 1] < 0.5
        columns = np.flatnonzero(free.any(axis=0))
        return (int(columns[0]), int(np.argmax(free[:, columns[0]]))) if len(columns) else None

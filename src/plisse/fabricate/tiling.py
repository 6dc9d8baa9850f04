"""A large sheet on several pages of a printer, which overlap and are laid together by their marks."""

from dataclasses import dataclass
from itertools import product

import numpy as np

from plisse.errors import PlisseError

__all__ = ["PAPERS", "Tile", "Tiling", "paper_size", "tiling"]

PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0), "Letter": (215.9, 279.4)}
BORDER, BAND, OVERLAP = 8.0, 9.0, 10.0


@dataclass(frozen=True)
class Tile:
    """One page: its row from the top and column from the left, counted from 1, and the corner of its window on the sheet."""

    row: int
    column: int
    corner: tuple[float, float]


@dataclass(frozen=True, eq=False)
class Tiling:
    """Windows of `window` (width, height) mm that cover a sheet, on pages of `page` mm; neighbours share 10 mm.

    `marks` (K, 2) are places on the sheet in the middle of shared bands, each seen on two pages or more.
    """

    page: tuple[float, float]
    window: tuple[float, float]
    rows: int
    columns: int
    tiles: tuple[Tile, ...]
    marks: np.ndarray

    @property
    def origin(self) -> tuple[float, float]:
        """Where the lower left corner of the window lies on its page; below it is a band of 9 mm for the caption."""
        return BORDER, BORDER + BAND


def paper_size(name: str) -> tuple[float, float]:
    """Width and height of a paper in mm, upright; raises PlisseError for unknown names."""
    for known, size in PAPERS.items():
        if known.lower() == name.lower():
            return size
    raise PlisseError(f"paper {name!r} is unknown; give {', '.join(PAPERS)}")


def tiling(size: tuple[float, float], paper: tuple[float, float]) -> Tiling:
    """The tiling of a sheet of `size` mm with the fewest pages, upright or lying; one page where it fits as it is."""
    both = [_tiling(size, page) for page in (paper, paper[::-1])]
    return min(both, key=lambda some: len(some.tiles))


def _tiling(size: tuple[float, float], page: tuple[float, float]) -> Tiling:
    window = (page[0] - 2 * BORDER, page[1] - 2 * BORDER - BAND)
    columns, rows = (max(1, int(np.ceil((side - OVERLAP) / (seen - OVERLAP) - 1e-9)))
                     for side, seen in zip(size, window, strict=True))
    step = window[0] - OVERLAP, window[1] - OVERLAP
    tiles = tuple(Tile(row + 1, column + 1, (column * step[0], (rows - 1 - row) * step[1]))
                  for row, column in product(range(rows), range(columns)))
    across, up = (_seams(count, length) for count, length in ((columns, step[0]), (rows, step[1])))
    ends = [(OVERLAP / 2, side - OVERLAP / 2) for side in size]
    marks = {(x, y) for x in across for y in (*up, *ends[1])} | {(x, y) for y in up for x in (*across, *ends[0])}
    return Tiling(page, window, rows, columns, tiles, np.array(sorted(marks)).reshape(-1, 2))


def _seams(count: int, step: float) -> list[float]:
    """Middles of the bands that neighbouring windows share."""
    return [k * step + OVERLAP / 2 for k in range(1, count)]

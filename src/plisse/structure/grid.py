"""The grid constructor: creases × columns, open or closed either way, quads missing where a mask says so."""

import numpy as np

from plisse.errors import InvalidStructure
from plisse.structure.topology import Topology

__all__ = ["grid"]


def grid(creases: int, columns: int, *, closed_creases: bool = False, closed_family: bool = False,
         mask: np.ndarray | None = None) -> Topology:
    """Topology of `creases` × `columns` vertices, vertex (l, i) numbered l·columns + i.

    `mask` (strips, columns or columns − 1) keeps the quads where it is true. Raises InvalidStructure for fewer
    than 2 creases or columns, fewer than 3 columns or creases around, or an odd closed family (§6 of the paper's
    figures: mountain and valley must alternate around it).
    """
    if creases < (3 if closed_family else 2) or columns < (3 if closed_creases else 2):
        raise InvalidStructure(f"a grid of {creases} creases with {columns} vertices each is too small to have faces")
    if closed_family and creases % 2:
        raise InvalidStructure(f"a closed family needs an even number of creases, not {creases}, "
                               "because mountains and valleys alternate around it")
    index = np.arange(creases * columns).reshape(creases, columns)
    along = np.roll(index, -1, axis=1)
    strips = creases if closed_family else creases - 1
    width = columns if closed_creases else columns - 1
    across, diagonal = np.roll(index, -1, axis=0), np.roll(along, -1, axis=0)
    quads = np.stack([index, along, diagonal, across], axis=-1)[:strips, :width]
    if mask is not None:
        if mask.shape != (strips, width):
            raise InvalidStructure(f"the mask has shape {mask.shape}, but the grid has {strips} × {width} quads")
        quads = quads[mask]
    return Topology(creases * columns, quads.reshape(-1, 4),
                    ordering=_band_ordering(creases, columns, closed_creases, closed_family))


def _band_ordering(creases: int, columns: int, closed_creases: bool, closed_family: bool) -> np.ndarray:
    """Key per vertex: column by column along the longer side, closed sides folded together (0, n−1, 1, n−2, …)."""
    row, column = np.divmod(np.arange(creases * columns), columns)
    if columns * (2 - closed_creases) >= creases * (2 - closed_family):
        major, minor, size = _fold(column, columns, closed_creases), row, creases
    else:
        major, minor, size = _fold(row, creases, closed_family), column, columns
    return major * size + minor.astype(float)


def _fold(index: np.ndarray, count: int, closed: bool) -> np.ndarray:
    if not closed:
        return index.astype(float)
    return np.where(2 * index < count, 2 * index, 2 * (count - index) - 1).astype(float)

"""Masks of grids: which quads (strips, columns) are there, kept connected and free of loose ends."""

import numpy as np
from scipy.ndimage import binary_dilation, generate_binary_structure, label

__all__ = ["cleaned", "grown", "largest_piece"]

PLUS = generate_binary_structure(2, 1)
SQUARE = generate_binary_structure(2, 2)


def cleaned(mask: np.ndarray, closed: bool) -> np.ndarray:
    """The largest piece of a mask whose quads all have neighbours both along and across, and whose corners are plain.

    A corner where two quads touch only diagonally loses one of them.
    """
    while True:
        left, right = _shifted(mask, closed, -1), _shifted(mask, closed, 1)
        above, below = np.zeros_like(mask), np.zeros_like(mask)
        above[1:], below[:-1] = mask[:-1], mask[1:]
        kept = mask & (left | right) & (above | below)
        for side in (-1, 1):  # quads that touch a diagonal neighbour and nothing between
            diagonal, beside = _shifted(kept, closed, side), kept
            pinched = beside[1:] & diagonal[:-1] & ~beside[:-1] & ~diagonal[1:]
            kept = kept.copy()
            kept[1:] &= ~pinched
        if (kept == mask).all():
            break
        mask = kept
    return largest_piece(mask, closed)


def largest_piece(mask: np.ndarray, closed: bool) -> np.ndarray:
    """The largest part of a mask that hangs together over edges."""
    doubled = np.concatenate([mask, mask], axis=1) if closed else mask
    labels, count = label(doubled, PLUS)
    if count == 0:
        return mask
    piece = labels == 1 + np.argmax(np.bincount(labels.ravel())[1:])
    if closed:
        piece = piece[:, :mask.shape[1]] | piece[:, mask.shape[1]:]
    return mask & piece


def grown(mask: np.ndarray, closed: bool, by: int = 1) -> np.ndarray:
    """The mask with all quads around it, corners included, `by` times."""
    if by == 0:
        return mask
    if not closed:
        return binary_dilation(mask, SQUARE, iterations=by)
    padded = np.concatenate([mask[:, -by:], mask, mask[:, :by]], axis=1)
    return binary_dilation(padded, SQUARE, iterations=by)[:, by:-by]


def _shifted(mask: np.ndarray, closed: bool, by: int) -> np.ndarray:
    """Whether the neighbour `by` columns further on is there."""
    moved = np.roll(mask, -by, axis=1)
    if not closed:
        moved[:, -1 if by > 0 else 0] = False
    return moved

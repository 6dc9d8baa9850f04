"""Masks of grids: which quads (strips, columns) are there, kept connected and free of loose ends."""

from collections.abc import Sequence

import numpy as np
from scipy.ndimage import binary_dilation, generate_binary_structure, label
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

__all__ = ["cleaned", "grown", "largest_piece"]

PLUS = generate_binary_structure(2, 1)
SQUARE = generate_binary_structure(2, 2)
FEWEST_IN_PART = 6


def cleaned(mask: np.ndarray, closed: bool, seams: Sequence[int] = (), is_ring: bool = False) -> np.ndarray:
    """The largest piece of a mask whose quads all have neighbours both along and across, and whose corners are plain.

    A corner where two quads touch only diagonally loses one of them. Seams, in front of the columns `seams`, part the
    mask: neighbours across them do not count, and parts of fewer than 6 quads go. In a ring the last strip borders on
    the first.
    """
    seam = np.array(sorted(seams), dtype=int)
    while True:
        left, right = _shifted(mask, closed, -1), _shifted(mask, closed, 1)
        left[:, seam], right[:, seam - 1] = False, False
        above, below = _shifted(mask.T, is_ring, -1).T, _shifted(mask.T, is_ring, 1).T
        kept = mask & (left | right) & (above | below)
        for side in (-1, 1):  # quads that touch a diagonal neighbour and nothing between
            diagonal = _shifted(kept, closed, side)
            kept = kept & ~(_shifted(diagonal.T, is_ring, -1).T & ~_shifted(kept.T, is_ring, -1).T & ~diagonal)
        if len(seam):
            kept = _without_crumbs(kept, closed, seam, is_ring)
        if (kept == mask).all():
            break
        mask = kept
    return largest_piece(mask, closed, is_ring)


def largest_piece(mask: np.ndarray, closed: bool, is_ring: bool = False) -> np.ndarray:
    """The largest part of a mask that hangs together over edges, around a ring too."""
    labels = _pieces(mask, closed, is_ring)
    return mask & (labels == 1 + np.argmax(np.bincount(labels.ravel(), minlength=2)[1:]))


def _pieces(mask: np.ndarray, closed: bool, is_ring: bool) -> np.ndarray:
    """Numbers from 1 of the pieces that quads belong to, 0 where there are none."""
    labels, count = label(mask, PLUS)
    ends = [pair for pair, joined in (((labels[:, -1], labels[:, 0]), closed), ((labels[-1], labels[0]), is_ring)) if joined]
    if not ends:
        return labels
    one, other = np.concatenate(ends, axis=1)
    one, other = one[both := (one > 0) & (other > 0)], other[both]
    joined = connected_components(coo_array((np.ones(len(one)), (one, other)), shape=(count + 1,) * 2), directed=False)[1]
    return np.where(labels > 0, joined[labels], 0)


def _without_crumbs(mask: np.ndarray, closed: bool, seams: np.ndarray, is_ring: bool) -> np.ndarray:
    """The mask without the small parts that seams leave."""
    first = int(seams[0]) if closed else 0  # a closed mask is unrolled where it is parted anyway
    parted = np.insert(np.roll(mask, -first, axis=1), seams - first, False, axis=1)
    labels = _pieces(parted, False, is_ring)
    sizes = np.bincount(labels.ravel(), minlength=1)
    sizes[0] = 0
    kept = np.delete(sizes[labels] >= FEWEST_IN_PART, seams - first + np.arange(len(seams)), axis=1)
    return np.roll(kept, first, axis=1)


def grown(mask: np.ndarray, closed: bool, by: int = 1, is_ring: bool = False) -> np.ndarray:
    """The mask with all quads around it, corners included, `by` times; in a ring the last strip borders on the first."""
    if is_ring:
        return grown(mask.T, True, by).T
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

"""Where to cut a pleated surface apart: columns of rulings along which angles need not sum to 2π.

Where curvature or twist is too strong for one sheet, several sheets that meet along rulings still cover everything:
each is exact, the whole is watertight in space.
"""

import numpy as np
from scipy.ndimage import gaussian_filter1d

from plisse.measure.sectors import sector_angles
from plisse.structure.topology import Topology

__all__ = ["even_columns", "seam_counts", "seam_defects", "worst_columns"]

STEPS, RATIO = 5, 1.6  # numbers of seams that are tried, and how much larger each is than the one before
NARROWEST = 3  # columns of quads in a part
SPREAD = 1.5  # columns over which losses are smoothed
APART = 0.6  # of the distance that seams would have if they were even


def seam_counts(most: int) -> list[int]:
    """Numbers of seams to try in turn, up to `most`."""
    return sorted({max(1, round(most / RATIO**k)) for k in range(STEPS)})


def even_columns(mask: np.ndarray, closed: bool, count: int) -> tuple[int, ...]:
    """At most `count` columns of vertices that divide the quads of a mask (strips, columns) evenly."""
    if closed:
        count = min(count, mask.shape[1] // NARROWEST)
        return tuple(np.arange(count) * mask.shape[1] // max(count, 1))
    used = np.flatnonzero(mask.any(axis=0))
    count = min(count, len(used) // NARROWEST - 1)
    return tuple(int(used[0] + k * len(used) / (count + 1)) for k in range(1, count + 1))


def worst_columns(mask: np.ndarray, kept: np.ndarray, closed: bool, count: int) -> tuple[int, ...]:
    """At most `count` columns of vertices near which most quads of a mask were not kept, well apart."""
    lost = (mask & ~kept).sum(axis=0).astype(float)
    around = lost + np.roll(lost, 1)
    score = gaussian_filter1d(around, SPREAD, mode="wrap" if closed else "nearest")
    used = np.flatnonzero(mask.any(axis=0))
    if not closed:
        score[:used[0] + NARROWEST], score[used[-1] + 2 - NARROWEST:] = 0, 0
    apart = max(NARROWEST, int(APART * len(used) / (count + 1)))
    found: list[int] = []
    while len(found) < count and score.max(initial=0) > 0:
        found.append(int(np.argmax(score)))
        distance = np.abs(np.arange(len(score)) - found[-1])
        score[(np.minimum(distance, len(score) - distance) if closed else distance) < apart] = 0
    return tuple(sorted(found))


def seam_defects(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """|Σω − 2π| in radians at the vertices inside seams, where it is none of the conditions."""
    sums = np.bincount(topology.corners.vertex, sector_angles(topology, vertices), topology.vertex_count)
    inside = np.unique(topology.seams)
    return np.abs(sums - 2 * np.pi)[inside[~topology.is_boundary[inside]]]

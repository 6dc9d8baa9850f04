"""Creases spaced along the bisectors of sectors, columns along their legs (§2.6).

No crease lies on a leg: there labels repeat, and in the middle a polygon is left whose edges alternate.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from plisse.layout.asymptotic.curves import Limits, trace_both_ways
from plisse.layout.asymptotic.directions import Directions, Field
from plisse.layout.asymptotic.leaf import Leaf
from plisse.layout.asymptotic.rays import Ray, crossings

__all__ = ["Spacing", "evenly", "spaced"]

NEAR_A_LEG = 2.2  # distances of the first curve within which another singularity's ray leaves room for one curve only
WORTH_ONE = 0.35
FREE = 0.6  # spacings that must be free behind the first curve
BEFORE_A_LEG = 0.2


@dataclass(frozen=True)
class Spacing:
    """Distances in space along rays: of the `first` curve, between the others, and `reach`, up to which there are any."""

    first: float
    gap: float
    reach: float


def spaced(directions: Directions, field: Field, along: tuple[Ray, ...], own: tuple[Ray, ...], spacing: Spacing,
           limits: Limits) -> list[Leaf]:
    """Curves of a field through places on the rays `along`; they keep clear of the rays `own` of the same field.

    The first curves around every singularity come first; gaps between curves that cross a ray already are then
    filled evenly, never across another singularity's ray, and the rest follows at even distances.
    """
    leaves: list[Leaf] = []
    for place in (_first, _others):
        for ray in along:
            taken = np.sort(crossings(ray.leaf, leaves))
            marks = np.sort(crossings(ray.leaf, [other.leaf for other in own if other.hub != ray.hub]))
            reach = min(ray.leaf.length, spacing.reach)
            arcs = place(taken[np.isfinite(taken)], marks[np.isfinite(marks)], spacing, reach)
            leaves += trace_both_ways(directions, ray.leaf.place_at(np.array(arcs)), field, limits)
    return leaves


def evenly(directions: Directions, field: Field, along: Leaf, count: int, gap: float, limits: Limits) -> list[Leaf]:
    """Curves of a field at even distances across the middle of one curve: patterns without singularity."""
    arcs = 0.5 * along.length + gap * (np.arange(count) - 0.5 * (count - 1))
    return list(trace_both_ways(directions, along.place_at(arcs[(arcs > 0) & (arcs < along.length)]), field, limits))


def _first(taken: np.ndarray, marks: np.ndarray, spacing: Spacing, reach: float) -> list[float]:
    if spacing.first > reach:
        return []
    if len(marks) and marks[0] < NEAR_A_LEG * spacing.first:
        free = not len(taken) or taken[0] > marks[0]
        return [0.5 * marks[0]] if free and marks[0] > WORTH_ONE * spacing.first else []
    return [spacing.first] if not len(taken) or taken[0] > spacing.first + FREE * spacing.gap else []


def _others(taken: np.ndarray, marks: np.ndarray, spacing: Spacing, reach: float) -> list[float]:
    taken = taken[taken <= reach]
    if not len(taken):
        return []
    out: list[float] = []
    for start, end in pairwise(taken):
        if not ((marks > start) & (marks < end)).any():
            parts = round((end - start) / spacing.gap)
            out += [start + (end - start) * k / parts for k in range(1, parts)]
    later = marks[marks > taken[-1]]
    limit = min(reach, later[0] - BEFORE_A_LEG * spacing.gap) if len(later) else reach
    steps = np.floor((limit - taken[-1]) / spacing.gap + 1e-9)
    return out + [taken[-1] + spacing.gap * k for k in range(1, int(steps) + 1)]

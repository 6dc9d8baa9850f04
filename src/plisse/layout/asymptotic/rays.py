"""Legs and bisectors of the sectors around singularities: the frame on which creases and columns are spaced (§2.6)."""

from dataclasses import dataclass

import numpy as np

from plisse.layout.asymptotic.crossings import met
from plisse.layout.asymptotic.curves import Limits, trace_leaves
from plisse.layout.asymptotic.directions import Directions, Field
from plisse.layout.asymptotic.leaf import Leaf, Steps
from plisse.layout.asymptotic.singularities import Singularity, radial_directions

__all__ = ["Ray", "crossings", "rays"]


@dataclass(frozen=True, eq=False)
class Ray:
    """A curve that starts in singularity number `hub`: a leg (a crease direction) or a bisector (orthogonal to it)."""

    hub: int
    leaf: Leaf


def rays(directions: Directions, hubs: tuple[Singularity, ...], field: Field, limits: Limits,
         radius: float) -> tuple[Ray, ...]:
    """Legs (`field` creases) or bisectors (columns) of all singularities, traced outwards from a circle (in the plane)."""
    out = []
    for number, hub in enumerate(hubs):
        outward = radial_directions(directions, hub, radius, field)
        for leaf in trace_leaves(directions, hub.place + radius * outward, outward, field, limits):
            straight = Steps(np.array([hub.place, leaf.steps.nodes[0]]), leaf.steps.tangents[[0, 0]], np.array([radius]))
            points = np.concatenate([directions.chart.positions(straight.samples[:-1]), leaf.points])
            out.append(Ray(number, Leaf(straight.followed_by(leaf.steps), points, leaf.stop)))
    return tuple(out)


def crossings(leaf: Leaf, others: list[Leaf]) -> np.ndarray:
    """Length (N,) in space along a curve up to its first crossing with each of the others, nan where there is none."""
    reached = np.full(len(others), np.nan)
    found = met([leaf], others)
    reached[found.other] = np.interp(found.on_one, leaf.plane, leaf.arc)
    return reached

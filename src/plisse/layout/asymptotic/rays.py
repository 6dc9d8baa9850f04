"""Legs and bisectors of the sectors around singularities: the frame on which creases and columns are spaced (§2.6)."""

from dataclasses import dataclass

import numpy as np
import shapely

from plisse.layout.asymptotic.curves import Leaf, Limits, trace_leaves
from plisse.layout.asymptotic.directions import Directions, Field
from plisse.layout.asymptotic.singularities import Singularity, radial_directions

__all__ = ["Ray", "as_line", "crossings", "rays"]


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
            places = np.concatenate([[hub.place], leaf.places])
            points = np.concatenate([directions.chart.positions(places[:1]), leaf.points])
            out.append(Ray(number, Leaf(places, points, leaf.stop)))
    return tuple(out)


def crossings(leaf: Leaf, others: list[Leaf]) -> np.ndarray:
    """Length (N,) in space along a curve up to its first crossing with each of the others, nan where there is none."""
    if not others:
        return np.empty(0)
    line = as_line(leaf)
    met = shapely.intersection(line, np.array([as_line(other) for other in others]))
    reached = np.full(len(others), np.nan)
    plane = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(leaf.places)))])
    for k in np.flatnonzero(~shapely.is_empty(met)):
        first = shapely.line_locate_point(line, shapely.points(shapely.get_coordinates(met[k]))).min()
        reached[k] = np.interp(first, plane, leaf.arc)
    return reached


def as_line(leaf: Leaf) -> shapely.LineString:
    """The curve as a line of the plane."""
    return shapely.LineString(np.column_stack([leaf.places.real, leaf.places.imag]))

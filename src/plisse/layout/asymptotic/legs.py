"""Where patterns end along the legs of singularities: creases hardly bend there, and rulings turn tangent (§2.6)."""

import numpy as np
import shapely

from plisse.layout.asymptotic.bends import Bends
from plisse.layout.asymptotic.overlay import Net
from plisse.layout.asymptotic.rays import Ray, crossings

__all__ = ["kept_columns"]


def kept_columns(net: Net, points: np.ndarray, bends: Bends, legs: tuple[Ray, ...], bisectors: tuple[Ray, ...],
                 most_twist: float) -> np.ndarray:
    """Mask (M,) of the columns of a net that are not cut off along every leg they cross.

    A leg is cut at the first column where the creases on its two sides have τ/κ above `most_twist` or turn to the same
    side, never between two singularities.
    """
    columns = list(net.columns)
    crossed, cut = np.zeros(len(columns), int), np.zeros(len(columns), int)
    edges = net.topology.edges
    pairs = edges.vertices[~edges.is_crease]
    bad = (bends.twist[pairs].max(axis=1) > most_twist) | (bends.facing(points, *pairs.T) > 0)
    for leg in legs:
        reached = crossings(leg.leaf, columns)
        crossed += np.isfinite(reached)
        others = crossings(leg.leaf, [ray.leaf for ray in bisectors if ray.hub != leg.hub])
        between = np.nanmax(others) if np.isfinite(others).any() else 0.0
        hits = _pairs_on_leg(net, pairs, leg)
        wrong = [reached[net.column[pairs[k, 0]]] for k in hits[bad[hits]]]
        end = min((arc for arc in wrong if arc >= between), default=np.inf)
        cut += reached >= end
    return ~((crossed > 0) & (cut == crossed))


def _pairs_on_leg(net: Net, pairs: np.ndarray, leg: Ray) -> np.ndarray:
    """Numbers of the rulings that cross a leg."""
    ends = np.stack([net.places[pairs].real, net.places[pairs].imag], axis=-1)
    line = shapely.linestrings(np.column_stack([leg.leaf.places.real, leg.leaf.places.imag]))
    shapely.prepare(line)
    return np.flatnonzero(shapely.intersects(line, shapely.linestrings(ends)))

"""Binormals of a polyline as unknowns: the small optimisation problem of §3.2."""

import numpy as np

from plisse.geometry.components import dot
from plisse.leastsquares.differences import second_difference
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.leastsquares.unit_length import unit_length

__all__ = ["binormal_fit", "orthogonal_to_edge"]


@kernel
def orthogonal_to_edge(binormal, *, edge):
    """<v_{i±1} − v_i, e3>."""
    return dot(edge, binormal)


@orthogonal_to_edge.jacobian
def _(binormal, *, edge):
    return (np.broadcast_to(edge, binormal.shape),)


def binormal_fit(points: np.ndarray, closed: bool, regulariser: float) -> list[Term]:
    """Binormals e3 of points (n, 3): orthogonal to both edges, of length 1, smooth by the regulariser."""
    index = np.arange(len(points))
    successor = np.roll(index, -1) if closed else index[1:]
    start = index if closed else index[:-1]
    edge = (points[successor] - points[start]).T
    bends = (np.roll(index, 1), index, np.roll(index, -1)) if closed else (index[:-2], index[1:-1], index[2:])
    return [Term("edge_after", orthogonal_to_edge, (Rows("binormals", start),), 1.0, {"edge": edge}),
            Term("edge_before", orthogonal_to_edge, (Rows("binormals", successor),), 1.0, {"edge": -edge}),
            Term("unit_binormal", unit_length, (Rows("binormals", index),)),
            Term("regulariser", second_difference, tuple(Rows("binormals", column) for column in bends),
                 regulariser, {"rest": 0.0})]

"""Constant fold angles along creases: E_principal of §3.4, over the normals."""

import numpy as np

from plisse.geometry.components import dot
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

__all__ = ["constant_fold", "equal_cosine"]


@kernel
def equal_cosine(plus, minus, next_plus, next_minus):
    """<n_f⁺, n_f⁻> − <n_f'⁺, n_f'⁻>, f and f' faces at successive edges of a crease."""
    return dot(plus, minus) - dot(next_plus, next_minus)


@equal_cosine.jacobian
def _(plus, minus, next_plus, next_minus):
    return minus, plus, -next_minus, -next_plus


def constant_fold(topology: Topology, weight: float = 1.0) -> Term:
    """E_principal: one condition at every inner 4-valent vertex, where two edges of a crease meet."""
    corners = topology.star_corners.get(4, np.empty((0, 4), np.int64))
    face = topology.corners.face[corners]
    # the ring starts on a crease edge: sectors 3 and 0 lie beside it, sectors 1 and 2 beside the next one
    return Term("principal", equal_cosine, tuple(Rows("normals", face[:, k]) for k in (0, 3, 1, 2)), weight)

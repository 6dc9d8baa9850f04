"""Closeness of the mid-surface to a reference: pleats may slide, tilt and open, their middle stays (Fig. 20)."""

import numpy as np

from plisse.geometry import components
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

__all__ = ["mid_offset", "mid_surface_closeness"]


@kernel
def mid_offset(p, q, *, foot, normal):
    """<(p + q)/2 − foot, normal>."""
    return components.dot(0.5 * (p + q) - foot, normal)


@mid_offset.jacobian
def _(p, q, *, foot, normal):
    half = 0.5 * np.broadcast_to(normal, p.shape)
    return half, half


def mid_surface_closeness(topology: Topology, rest: np.ndarray, normals: np.ndarray, weight: float = 1.0) -> Term:
    """One equation per ruling: its middle moves off the middle at `rest` (3, V) only along the surface.

    `normals` (3, V) are those of the reference at the vertices.
    """
    p, q = topology.edges.vertices[~topology.edges.is_crease].T
    foot = 0.5 * (rest[:, p] + rest[:, q])
    return Term("mid_surface", mid_offset, (Rows("vertices", p), Rows("vertices", q)), weight,
                {"foot": foot, "normal": components.unit(normals[:, p] + normals[:, q])})

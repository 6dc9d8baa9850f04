"""Planarity with normals as unknowns: E_plan of §3.4."""

import numpy as np

from plisse.geometry.components import dot
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.leastsquares.unit_length import unit_length
from plisse.structure.topology import Topology

__all__ = ["edge_in_plane", "plane_fit", "unit_length"]


@kernel
def edge_in_plane(p, q, normal):
    """<p − q, n>."""
    return dot(p - q, normal)


@edge_in_plane.jacobian
def _(p, q, normal):
    return normal, -normal, p - q


def plane_fit(topology: Topology, weight: float = 1.0) -> list[Term]:
    """E_plan: every edge of a face is orthogonal to the face's normal, every normal has length 1."""
    corners = topology.corners
    edges = Rows("vertices", corners.next), Rows("vertices", corners.vertex), Rows("normals", corners.face)
    return [Term("plane", edge_in_plane, edges, weight),
            Term("unit_normal", unit_length, (Rows("normals", np.arange(topology.face_count)),), weight)]

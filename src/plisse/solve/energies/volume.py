"""Planarity as vanishing tetrahedron volumes: exact, scale-free after normalisation, no normals needed (§3.4)."""

from plisse.geometry.components import cross, dot
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

__all__ = ["planarity", "tetrahedron_volume"]


@kernel
def tetrahedron_volume(a, b, c, d):
    """det(b − a, c − a, d − a), six times the volume."""
    return dot(cross(b - a, c - a), d - a)


@tetrahedron_volume.jacobian
def _(a, b, c, d):
    p, q, r = b - a, c - a, d - a
    by_b, by_c, by_d = cross(q, r), cross(r, p), cross(p, q)
    return -(by_b + by_c + by_d), by_b, by_c, by_d


def planarity(topology: Topology, weight: float = 1.0) -> Term:
    """One volume per quad, k − 3 per hub; vertices are expected in units of the mean edge length."""
    return Term("planarity", tetrahedron_volume, tuple(Rows("vertices", column) for column in topology.tetrahedra.T),
                weight)

"""Isometry: lengths in the development equal lengths in space (E_isom of §3.4)."""


from plisse.geometry.components import dot
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

__all__ = ["equal_length", "given_length", "isometry"]


@kernel
def given_length(p, q, *, square):
    """|p − q|² − square."""
    return dot(p - q, p - q) - square


@given_length.jacobian
def _(p, q, *, square):
    return 2 * (p - q), 2 * (q - p)


@kernel
def equal_length(p, q, a, b):
    """|p − q|² − |a − b|², p and q in space, a and b in the plane."""
    return dot(p - q, p - q) - dot(a - b, a - b)


@equal_length.jacobian
def _(p, q, a, b):
    return 2 * (p - q), 2 * (q - p), 2 * (b - a), 2 * (a - b)


def isometry(topology: Topology, weight: float = 1.0) -> Term:
    """E_isom: mesh and development have equal edges and diagonals; every edge is counted once."""
    i, j = topology.rods.T
    return Term("isometry", equal_length, (Rows("vertices", i), Rows("vertices", j),
                                           Rows("development", i), Rows("development", j)), weight)

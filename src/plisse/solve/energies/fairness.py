"""Fairness of the creases: E_fair of §3.4; it prevents foldovers, but straightens what should stay curved."""

from plisse.leastsquares.differences import second_difference
from plisse.leastsquares.kernel import Rows, Term
from plisse.structure.chains import successive_triples
from plisse.structure.topology import Topology

__all__ = ["fairness"]


def fairness(topology: Topology, weight: float = 1.0) -> Term:
    """E_fair: second differences p − 2q + r of positions over all successive vertices of creases."""
    triples = successive_triples(topology.edges.vertices[topology.edges.is_crease])
    rows = tuple(Rows("vertices", column) for column in triples.T)
    return Term("fair", second_difference, rows, weight, {"rest": 0.0})

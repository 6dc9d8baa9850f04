"""Fairness of the creases: E_fair of §3.4; it prevents foldovers, but straightens what should stay curved."""

from plisse.solve.energies.displacement import _triples, displacement_bend
from plisse.solve.energies.kernel import Rows, Term
from plisse.structure.topology import Topology

__all__ = ["fairness"]


def fairness(topology: Topology, weight: float = 1.0) -> Term:
    """E_fair: second differences p − 2q + r of positions over all successive vertices of creases."""
    rows = tuple(Rows("vertices", column) for column in _triples(topology.creases).T)
    return Term("fair", displacement_bend, rows, weight, {"rest": 0.0})

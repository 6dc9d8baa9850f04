"""Fairness of the displacement from a rest position: keeps a structure regular without straightening its creases.

Second differences along creases alone have a null space in which neighbouring creases slide and pleats close;
closeness and differences across creases take it away.
"""

import numpy as np

from plisse.leastsquares.differences import first_difference, second_difference, value
from plisse.leastsquares.kernel import Rows, Term
from plisse.structure.chains import successive_triples
from plisse.structure.topology import Topology

__all__ = ["displacement_fairness"]


def displacement_fairness(topology: Topology, rest: np.ndarray, *, along: float = 1.0, same_side: float = 0.05,
                          across: float = 0.0, closeness: float = 0.1) -> list[Term]:
    """Terms that draw the displacement from `rest` (3, V) towards zero and towards smoothness.

    `along` weighs second differences along creases, `same_side` first differences between creases on the same side
    of the zigzag, `across` first differences between neighbouring creases, `closeness` the displacement itself.
    """
    columns = np.arange(topology.vertex_count)
    edges = topology.edges
    rulings = edges.vertices[~edges.is_crease]
    bends, twos = successive_triples(edges.vertices[edges.is_crease]), successive_triples(rulings)
    candidates = [
        ("closeness", value, columns[:, None], closeness),
        ("bend", second_difference, bends, along),
        ("same_side", first_difference, twos[:, [0, 2]], same_side),
        ("across", first_difference, rulings, across),
    ]
    return [Term(name, core, tuple(Rows("vertices", column) for column in index.T), weight,
                 {"rest": core.residual(*(rest.take(column, axis=1) for column in index.T), rest=0.0)})
            for name, core, index, weight in candidates if weight > 0 and len(index)]

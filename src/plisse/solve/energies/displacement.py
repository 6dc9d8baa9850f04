"""Fairness of the displacement from a rest position: keeps a structure regular without straightening its creases.

Second differences along creases alone have a null space in which neighbouring creases slide and pleats close;
closeness and differences across creases take it away.
"""

import numpy as np

from plisse.solve.energies.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

__all__ = ["displacement_fairness"]


@kernel(componentwise=True)
def displacement(p, *, rest):
    """p − rest."""
    return p - rest


@displacement.jacobian
def _(p, *, rest):
    return (np.ones_like(p),)


@kernel(componentwise=True)
def displacement_step(p, q, *, rest):
    """First difference q − p of the displacement."""
    return q - p - rest


@displacement_step.jacobian
def _(p, q, *, rest):
    return -np.ones_like(p), np.ones_like(p)


@kernel(componentwise=True)
def displacement_bend(p, q, r, *, rest):
    """Second difference p − 2q + r of the displacement."""
    return p - 2 * q + r - rest


@displacement_bend.jacobian
def _(p, q, r, *, rest):
    return np.ones_like(p), np.full_like(p, -2.0), np.ones_like(p)


def displacement_fairness(topology: Topology, rest: np.ndarray, *, along: float = 1.0, same_side: float = 0.05,
                          across: float = 0.0, closeness: float = 0.1) -> list[Term]:
    """Terms that draw the displacement from `rest` (3, V) towards zero and towards smoothness.

    `along` weighs second differences along creases, `same_side` first differences between creases on the same side
    of the zigzag, `across` first differences between neighbouring creases, `closeness` the displacement itself.
    """
    columns = np.arange(topology.vertex_count)
    bends = _triples(topology.creases)
    twos = _triples(topology.rulings)
    rulings = topology.edges.vertices[~topology.edges.is_crease]
    candidates = [
        ("closeness", displacement, columns[:, None], closeness),
        ("bend", displacement_bend, bends, along),
        ("same_side", displacement_step, twos[:, [0, 2]], same_side),
        ("across", displacement_step, rulings, across),
    ]
    return [Term(name, core, tuple(Rows("vertices", column) for column in index.T), weight,
                 {"rest": core.residual(*(rest[:, column] for column in index.T), rest=0.0)})
            for name, core, index, weight in candidates if weight > 0 and len(index)]


def _triples(lines) -> np.ndarray:
    """Successive vertices (T, 3) along polylines."""
    parts = [np.empty((0, 3), np.int64)]
    for line in lines:
        vertices = np.append(line.vertices, line.vertices[:2]) if line.closed else line.vertices
        parts.append(np.stack([vertices[:-2], vertices[1:-1], vertices[2:]], axis=1))
    return np.concatenate(parts)

"""Keeping the height of a zigzag: fairness alone does not see creases sink into the surface (§2.6, §3.4)."""

import numpy as np

from plisse.geometry import components
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

__all__ = ["height_over", "kept_amplitude"]


@kernel
def height_over(p, *around, rest, normal):
    """<p − mean of the points around it − rest, normal>."""
    return components.dot(p - sum(around) / len(around) - rest, normal)


@height_over.jacobian
def _(p, *around, rest, normal):
    normal = np.broadcast_to(normal, p.shape)
    return (normal, *[-normal / len(around)] * len(around))


def kept_amplitude(topology: Topology, rest: np.ndarray, normals: np.ndarray, repeats: np.ndarray,
                   weight: float = 1.0) -> list[Term]:
    """Every vertex keeps its height over the neighbouring creases at `rest` (3, V), along `normals` (3, V).

    Creases across the rulings of the mask `repeats` (E,), which lie at the same height, do not count.
    """
    pairs = topology.edges.vertices[~topology.edges.is_crease & ~repeats]
    one, other = np.concatenate([pairs, pairs[:, ::-1]]).T
    order = np.argsort(one, kind="stable")
    one, other = one[order], other[order]
    count = np.bincount(one, minlength=topology.vertex_count)
    first = np.cumsum(count) - count
    terms = []
    for number in np.unique(count[count > 0]):
        centre = np.flatnonzero(count == number)
        around = other[first[centre][:, None] + np.arange(number)]
        drop = rest[:, centre] - rest[:, around].mean(axis=2)
        rows = tuple(Rows("vertices", column) for column in [centre, *around.T])
        terms.append(Term(f"amplitude {number}", height_over, rows, weight, {"rest": drop, "normal": normals[:, centre]}))
    return terms

"""How much of the sky paper sees at its folds: bright ridges and dark grooves, in closed form."""

import numpy as np

from plisse.measure.folds import fold_angles
from plisse.structure.topology import Topology

__all__ = ["openness"]


def openness(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """How much of the sky vertices (V, 2) see on the front and on the back of the paper, in 0…1.

    In a groove with opening angle φ a wall sees (1 − cos φ) / 2 of the sky at its bottom, and nearly all of it on the ridge.
    """
    edges, inner = topology.edges, topology.edges.is_crease & ~topology.edges.is_boundary
    fold = fold_angles(topology, vertices)[inner]
    ends = edges.vertices[inner].ravel()
    count = np.maximum(np.bincount(ends, minlength=topology.vertex_count), 1)
    valley, ridge = (np.bincount(ends, np.maximum(side * fold, 0).repeat(2), topology.vertex_count) / count
                     for side in (1, -1))
    return (1 + np.cos(np.stack([valley, ridge], axis=1))) / 2

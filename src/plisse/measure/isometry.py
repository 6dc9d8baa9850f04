"""Isometry between the folded state and its development (E_isom of §3.4, as a number)."""

import numpy as np

from plisse.geometry.vectors import norm
from plisse.structure.topology import Topology

__all__ = ["isometry_defect"]


def isometry_defect(topology: Topology, vertices: np.ndarray, flat: np.ndarray) -> float:
    """Largest difference of an edge or diagonal between space (V, 3) and plane (V, 2), over the mean length."""
    i, j = topology.rods.T
    lengths = norm(vertices.take(i, axis=0) - vertices.take(j, axis=0))
    return float(np.abs(norm(flat.take(i, axis=0) - flat.take(j, axis=0)) - lengths).max() / lengths.mean())

"""Where on a structure something is, in words a designer can follow."""

import numpy as np

from plisse.structure.topology import Topology

__all__ = ["place_of"]


def place_of(topology: Topology, vertex: int) -> str:
    """Crease number (from 1) and percent of its length, by counting vertices along the crease."""
    for number, crease in enumerate(topology.creases, 1):
        position = np.flatnonzero(crease.vertices == vertex)
        if len(position):
            percent = 100 * position[0] / max(len(crease.vertices) - (not crease.closed), 1)
            return f"crease {number} near {percent:.0f} % of its length"
    return f"vertex {vertex}"

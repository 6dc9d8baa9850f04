"""Faces cut into triangles, for formats and methods that know nothing else."""

import numpy as np

from plisse.structure.topology import Topology

__all__ = ["triangulated"]


def triangulated(topology: Topology) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (T, 3) of all faces, each fan from its first vertex, and their faces (T,), sorted by face."""
    quads = topology.quads
    parts = [quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)]
    faces = [np.repeat(np.arange(len(quads)), 2)]
    for k, hub in enumerate(topology.hubs):
        parts.append(np.stack([np.full(len(hub) - 2, hub[0]), hub[1:-1], hub[2:]], axis=1))
        faces.append(np.full(len(hub) - 2, len(quads) + k))
    return np.concatenate(parts), np.concatenate(faces)

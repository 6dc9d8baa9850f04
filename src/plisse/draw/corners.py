"""Corners of faces as pictures need them: in triangles, and with normals that break at creases only."""

import numpy as np

from plisse.geometry.vectors import unit
from plisse.measure.planarity import face_normals
from plisse.structure.incidence import edge_lookup
from plisse.structure.topology import Topology

__all__ = ["corner_normals", "corner_triangles"]


def corner_triangles(topology: Topology) -> np.ndarray:
    """Triangles (T, 3) of all faces as indices of `topology.corners`."""
    corners = np.arange(topology.quads.size).reshape(-1, 4)
    parts = [corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]
    start = topology.quads.size
    for hub in topology.hubs:
        fan = np.arange(1, len(hub) - 1)
        parts.append(start + np.stack([np.zeros_like(fan), fan, fan + 1], axis=1))
        start += len(hub)
    return np.concatenate(parts)


def corner_normals(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Unit normals (C, 3) that are continuous over rulings and break at creases, as paper does."""
    edges, faces = topology.edges, face_normals(topology, vertices)
    meets = ~edges.is_crease & ~edges.is_boundary
    second = np.where(meets, edges.faces[:, 1], edges.faces[:, 0])
    across = unit(faces[edges.faces[:, 0]] + faces[second])
    corners = topology.corners
    other = np.where(corners.next_is_crease, corners.previous, corners.next)
    normals = across[edge_lookup(topology)(corners.vertex, other)]
    in_hub = corners.face >= len(topology.quads)
    return np.where(in_hub[:, None], faces[corners.face], normals)

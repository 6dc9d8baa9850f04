"""Fold angles at edges and opening angles of creases (§2.1: opening, §2.5: fold)."""

import numpy as np

from plisse.geometry.components import cross, dot, norm
from plisse.measure.planarity import face_normals
from plisse.structure.topology import Topology

__all__ = ["assignments", "crease_opening_angles", "fold_angles"]


def fold_angles(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Signed fold angle in radians (E,): 0 flat, positive for valleys seen from the faces' positive side.

    Boundary edges have 0. The sign is that of FOLD's edges_foldAngle.
    """
    edges = topology.edges
    normals, points = np.ascontiguousarray(face_normals(topology, vertices).T), np.ascontiguousarray(vertices.T)
    first, second = (normals.take(column, axis=1, mode="wrap") for column in edges.faces.T)
    start, end = (points.take(column, axis=1) for column in edges.vertices.T)
    along = end - start
    angle = np.arctan2(-dot(cross(first, second), along), dot(first, second) * norm(along))
    return np.where(edges.is_boundary, 0.0, angle)


def crease_opening_angles(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Opening angle in radians (K,) of every inner crease edge: π flat, 0 folded flat (φ of §2.1)."""
    inner = topology.edges.is_crease & ~topology.edges.is_boundary
    return np.pi - np.abs(fold_angles(topology, vertices)[inner])


def assignments(topology: Topology, vertices: np.ndarray, flat: float = 1e-9) -> np.ndarray:
    """One letter per edge (E,): M and V for folded edges, B on the boundary, F where the fold is below `flat`."""
    angle = fold_angles(topology, vertices)
    letters = np.where(angle > flat, "V", np.where(angle < -flat, "M", "F"))
    return np.where(topology.edges.is_boundary, "B", letters)

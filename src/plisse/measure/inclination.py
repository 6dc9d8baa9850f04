"""Inclination of creases against a reference surface, as folded: varying along every crease (Fig. 23)."""

import numpy as np

from plisse.geometry.vectors import dot, unit
from plisse.measure.planarity import face_normals
from plisse.structure.topology import Topology

__all__ = ["crease_inclinations", "overhanging"]


def overhanging(topology: Topology, vertices: np.ndarray, normals: np.ndarray) -> float:
    """Fraction of the faces that lean beyond the normals (F, 3) of the reference under them, so that they hide others."""
    facing = dot(face_normals(topology, vertices), normals)
    return float(np.mean(facing * np.sign(facing.sum()) < 0))


def crease_inclinations(topology: Topology, vertices: np.ndarray, normals: np.ndarray,
                        outward: np.ndarray) -> np.ndarray:
    """θ in radians (K,) at every inner crease edge: 0 upright, positive where ridges lean outward.

    The wedge between the two strips is halved by the direction ±(cos θ n + sin θ m); `normals` n and `outward` m
    (V, 3) are those of the reference at the vertices, m across the creases.
    """
    edges = topology.edges
    inner = edges.is_crease & ~edges.is_boundary
    ends, faces = edges.vertices[inner], edges.faces[inner]
    along = unit(vertices[ends[:, 1]] - vertices[ends[:, 0]])
    middle = vertices[ends].mean(axis=1)
    centres = vertices[topology.quads].mean(axis=1)
    wings = []
    for face in faces.T:
        wing = centres[face] - middle
        wings.append(unit(wing - dot(wing, along)[:, None] * along))
    normal = unit(normals[ends].sum(axis=1))
    across = unit(np.cross(along, normal))
    across *= np.sign(dot(across, outward[ends].sum(axis=1)))[:, None]
    axis = wings[0] + wings[1]
    up = dot(axis, normal)
    return np.arctan2(np.sign(up) * dot(axis, across), np.abs(up))

"""Planarity of faces: w_planar of Fig. 21."""

import numpy as np

from plisse.geometry import components
from plisse.geometry.vectors import norm, unit
from plisse.structure.topology import Topology

__all__ = ["face_areas", "face_normals", "planarity_defect"]


def face_normals(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Unit normals (F, 3): the cross product of a quad's diagonals, the area vector of a hub."""
    return unit(_area_vectors(topology, vertices))


def face_areas(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Areas (F,) of the faces projected onto their mean planes."""
    return norm(_area_vectors(topology, vertices))


def planarity_defect(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Per face (F,) the distance of a quad's diagonals over their mean length; 0 for planar faces (Fig. 21).

    For a hub: the largest distance of a vertex from the mean plane over the hub's diameter.
    """
    a, b, c, d = _quad_corners(topology, vertices)
    one, other = c - a, d - b
    normal = components.cross(one, other)
    size = 0.5 * components.norm(normal) * (components.norm(one) + components.norm(other))
    quads = np.divide(np.abs(components.dot(b - a, normal)), size, out=np.zeros(len(size)), where=size > 0)
    hubs = [_hub_defect(vertices[hub]) for hub in topology.hubs]
    return np.concatenate([quads, hubs])


def _quad_corners(topology: Topology, vertices: np.ndarray) -> list[np.ndarray]:
    """Vertices a, b, c, d (3, Q) of all quads."""
    points = np.ascontiguousarray(vertices.T)
    return [points.take(column, axis=1) for column in topology.quads.T]


def _area_vectors(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    a, b, c, d = _quad_corners(topology, vertices)
    quads = 0.5 * components.cross(c - a, d - b).T
    hubs = [0.5 * np.cross(p := vertices[hub] - vertices[hub].mean(axis=0), np.roll(p, -1, axis=0)).sum(axis=0)
            for hub in topology.hubs]
    return np.concatenate([quads, np.reshape(hubs, (-1, 3))])


def _hub_defect(points: np.ndarray) -> float:
    centred = points - points.mean(axis=0)
    normal = np.linalg.svd(centred)[2][2]
    diameter = norm(points[:, None] - points).max()
    return float(np.abs(centred @ normal).max() / diameter)

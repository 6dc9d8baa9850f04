"""Sector angles ω of the faces, and what they must sum to (§2.3 (2), §2.4 (4))."""

import numpy as np

from plisse.geometry.components import angle_between
from plisse.structure.topology import Topology

__all__ = ["angle_defect", "principal_defect", "sector_angles"]


def sector_angles(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Angle in radians (C,) at every corner, in the order of `topology.corners`."""
    corners = topology.corners
    points = np.ascontiguousarray(vertices.T)
    origin, ahead, behind = (points.take(ends, axis=1) for ends in (corners.vertex, corners.next, corners.previous))
    return angle_between(ahead - origin, behind - origin)


def angle_defect(topology: Topology, vertices: np.ndarray, sectors: np.ndarray | None = None) -> np.ndarray:
    """Σω − 2π per vertex (V,), 0 on boundary and seams: w_angle of Fig. 21, zero when developable (2).

    `sectors` are the sector angles where they are known already.
    """
    angles = sector_angles(topology, vertices) if sectors is None else sectors
    sums = np.bincount(topology.corners.vertex, angles, topology.vertex_count)
    return np.where(topology.is_inner, sums - 2 * np.pi, 0.0)


def principal_defect(topology: Topology, vertices: np.ndarray, sectors: np.ndarray | None = None) -> np.ndarray:
    """Largest of |ω1+ω3−π| and |ω2+ω4−π| per vertex (V,), 0 on the boundary and off 4-valent vertices (4).

    `sectors` are the sector angles where they are known already.
    """
    defect = np.zeros(topology.vertex_count)
    angles = sector_angles(topology, vertices) if sectors is None else sectors
    walk = topology.star_corners.get(4)
    if walk is not None:
        ring = angles[walk]
        opposite = np.stack([ring[:, 0] + ring[:, 2], ring[:, 1] + ring[:, 3]])
        defect[topology.stars[4][:, 0]] = np.abs(opposite - np.pi).max(axis=0)
    return defect

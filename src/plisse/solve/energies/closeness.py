"""Closeness to the guiding creases: E_close of §3.4; vertices may slide along them and out of the surface."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry import components
from plisse.geometry.frames import regularised_frame
from plisse.geometry.polyline import arc_length, tangents
from plisse.geometry.vectors import dot, unit
from plisse.solve.energies.kernel import Rows, Term, kernel
from plisse.structure.topology import Polyline, Topology

__all__ = ["Guides", "closeness", "offset_along"]

SMOOTHING = 0.02  # of a crease's length, over which binormals are smoothed


@kernel
def offset_along(p, *, foot, normal):
    """<p − v*, n*>."""
    return components.dot(p - foot, normal)


@offset_along.jacobian
def _(p, *, foot, normal):
    return (np.broadcast_to(normal, p.shape),)


@dataclass(frozen=True, eq=False)
class Guides:
    """The creases of a zigzag at rest: `vertices` (V, 3) and their principal normals e2 (V, 3)."""

    topology: Topology
    vertices: np.ndarray
    principal_normals: np.ndarray

    @classmethod
    def along_creases(cls, topology: Topology, vertices: np.ndarray,
                      binormals: np.ndarray | None = None) -> "Guides":
        """Guides through vertices (V, 3); e2 = e3 × e1 comes from binormals (V, 3) where these are known."""
        normals = np.zeros_like(vertices)
        for crease in topology.creases:
            points = vertices[crease.vertices]
            if binormals is None:
                smoothing = SMOOTHING * arc_length(points, crease.closed)[-1]
                frame = regularised_frame(points, crease.closed, smoothing)
                normals[crease.vertices] = frame.principal_normal
            else:
                across = np.cross(binormals[crease.vertices], tangents(points, crease.closed))
                normals[crease.vertices] = unit(across)
        return cls(topology, vertices, normals)

    def feet(self, vertices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Closest points v* (V, 3) on each vertex's own crease and the principal normals n* (V, 3) there."""
        feet, normals = vertices.copy(), self.principal_normals.copy()
        for crease in self.topology.creases:
            start, end, fraction = _closest_segments(crease, self.vertices, vertices[crease.vertices])
            weight = fraction[:, None]
            feet[crease.vertices] = (1 - weight) * self.vertices[start] + weight * self.vertices[end]
            normals[crease.vertices] = unit((1 - weight) * self.principal_normals[start]
                                            + weight * self.principal_normals[end])
        return feet, normals


def closeness(guides: Guides, vertices: np.ndarray, weight: float = 1.0) -> Term:
    """E_close with the feet of vertices (V, 3) frozen; to be renewed after each round."""
    feet, normals = guides.feet(vertices)
    rows = (Rows("vertices", np.arange(len(vertices))),)
    return Term("close", offset_along, rows, weight, {"foot": feet.T, "normal": normals.T})


def _closest_segments(crease: Polyline, line: np.ndarray,
                      points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Ends (vertex numbers) of the segment closest to each point (n, 3), and the foot's place in it.

    Only the two segments at the nearest vertex are tried.
    """
    count = len(crease.vertices)
    nearest = cKDTree(line[crease.vertices]).query(points)[1]
    options = []
    for first in (nearest - 1, nearest):
        first = first % count if crease.closed else np.clip(first, 0, count - 2)
        start, end = crease.vertices[first], crease.vertices[(first + 1) % count]
        along = line[end] - line[start]
        fraction = np.clip(dot(points - line[start], along) / dot(along, along), 0, 1)
        gap = points - line[start] - fraction[:, None] * along
        options.append((start, end, fraction, dot(gap, gap)))
    first_is_closer = options[0][3] < options[1][3]
    start, end, fraction = (np.where(first_is_closer, a, b)
                            for a, b in zip(options[0][:3], options[1][:3], strict=True))
    return start, end, fraction

"""Closeness to the guiding creases: E_close of §3.4; vertices may slide along them and out of the surface."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry import components
from plisse.geometry.frames import regularised_frame
from plisse.geometry.polyline import arc_length, closest_on_polyline, tangents
from plisse.geometry.vectors import unit
from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.structure.topology import Topology

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
            line, across = self.vertices[crease.vertices], self.principal_normals[crease.vertices]
            start, end, fraction = closest_on_polyline(vertices[crease.vertices], line, crease.closed)
            weight = fraction[:, None]
            feet[crease.vertices] = (1 - weight) * line[start] + weight * line[end]
            normals[crease.vertices] = unit((1 - weight) * across[start] + weight * across[end])
        return feet, normals


def closeness(guides: Guides, vertices: np.ndarray, weight: float = 1.0) -> Term:
    """E_close with the feet of vertices (V, 3) frozen; to be renewed after each round."""
    feet, normals = guides.feet(vertices)
    rows = (Rows("vertices", np.arange(len(vertices))),)
    return Term("close", offset_along, rows, weight, {"foot": feet.T, "normal": normals.T})

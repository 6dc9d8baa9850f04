"""The cone that touches the faces around a conical vertex, as something to draw (Figs 8 and 10)."""

import numpy as np

from plisse.draw.camera import Camera
from plisse.geometry.vectors import dot, norm, unit
from plisse.measure.planarity import face_normals
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.cone_axes import cone_axes

__all__ = ["into_cone", "with_cone"]

AROUND = 96
TIP, REACH = 0.02, 0.75
NARROWEST = np.radians(3.0)


def with_cone(structure: PleatedStructure, vertex: int) -> PleatedStructure:
    """The structure and, as further faces of the same mesh, the cone that touches the four faces at an inner vertex.

    Vertices keep their numbers. Cones that have closed to a line, or opened to a plane, are left out.
    """
    topology, vertices = structure.topology, structure.vertices
    axis = cone_axes(topology, vertices)[vertex]
    half = np.arcsin(min(1.0, 1.0 / float(norm(axis))))  # all face normals n have n · axis = 1
    if not NARROWEST < half < np.pi / 2 - NARROWEST:
        return structure
    direction = _side(topology, vertices, vertex, unit(axis))
    first = unit(np.cross(direction, np.eye(3)[np.argmin(np.abs(direction))]))
    angle = 2 * np.pi * np.arange(AROUND) / AROUND
    ring = np.cos(angle)[:, None] * first + np.sin(angle)[:, None] * np.cross(direction, first)
    lines = np.cos(half) * direction + np.sin(half) * ring
    cone = grid(2, AROUND, closed_creases=True).quads + topology.vertex_count
    points = [vertices[vertex] + share * structure.mean_edge * lines for share in (TIP, REACH)]
    merged = Topology(topology.vertex_count + 2 * AROUND, np.concatenate([topology.quads, cone]), topology.hubs)
    return PleatedStructure(merged, np.concatenate([vertices, *points]))


def into_cone(structure: PleatedStructure, vertex: int) -> Camera:
    """A view of the faces around an inner vertex from the side of their cone, a little along the crease."""
    topology, vertices = structure.topology, structure.vertices
    direction = _side(topology, vertices, vertex, unit(cone_axes(topology, vertices)[vertex]))
    ring = next(row[1:] for rows in topology.stars.values() for row in rows if row[0] == vertex)
    crease = unit(vertices[ring[0]] - vertices[vertex])
    return Camera.looking_from(direction + 0.3 * np.cross(crease, direction) + 0.9 * crease, direction)


def _side(topology: Topology, vertices: np.ndarray, vertex: int, axis: np.ndarray) -> np.ndarray:
    """The axis or its opposite: on which side the cone touches the faces themselves and not their planes beyond."""
    corners = topology.corners
    at = np.flatnonzero(corners.vertex == vertex)
    normal = face_normals(topology, vertices)[corners.face[at]]
    middle = unit(vertices[corners.next[at]] - vertices[vertex]) + unit(vertices[corners.previous[at]] - vertices[vertex])
    contact = axis - dot(normal, axis[None])[:, None] * normal
    return axis if dot(contact, middle).sum() >= 0 else -axis

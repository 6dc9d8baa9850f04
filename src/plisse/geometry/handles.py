"""Editing of reference surfaces: handles with smooth falloff, and points that follow an edited mesh (Fig. 23)."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from plisse.errors import InvalidDesign, InvalidMesh
from plisse.geometry.closest import closest_on_mesh
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import dot, norm

__all__ = ["Handle", "falloff", "follow", "moved"]


@dataclass(frozen=True, eq=False)
class Handle:
    """A `point` (3,) pulled by a `displacement` (3,); what is farther away than `radius` stays.

    Raises InvalidDesign for numbers that are no such thing.
    """

    point: np.ndarray
    displacement: np.ndarray
    radius: float

    def __post_init__(self):
        for name in ("point", "displacement"):
            value = np.asarray(getattr(self, name), dtype=float)
            if value.shape != (3,) or not np.isfinite(value).all():
                raise InvalidDesign(f"the {name} of a handle is {getattr(self, name)}; give three numbers [x, y, z]")
            object.__setattr__(self, name, value)
        if not (np.isfinite(self.radius) and self.radius > 0):
            raise InvalidDesign(f"the radius of a handle is {self.radius}; give a positive length")

    def pull(self, points: np.ndarray) -> np.ndarray:
        """Displacements (N, 3) of points (N, 3)."""
        return falloff(norm(points - self.point) / self.radius)[:, None] * self.displacement


def falloff(distance: np.ndarray) -> np.ndarray:
    """Wendland's (1 − r)⁴ (4r + 1) for r < 1, else 0: smooth of order two, 1 at the handle."""
    left = np.maximum(1 - distance, 0)
    return left**4 * (4 * distance + 1)


def moved(points: np.ndarray, handles: Iterable[Handle]) -> np.ndarray:
    """Points (N, 3) moved by handles; the pulls of several add up."""
    return points + sum((handle.pull(points) for handle in handles), np.zeros_like(points))


def follow(points: np.ndarray, mesh: ReferenceMesh, edited_vertices: np.ndarray) -> np.ndarray:
    """Points (N, 3) carried along when a mesh is edited, its connectivity kept.

    The closest point keeps its barycentric coordinates; the offset from it is mapped by the deformation gradient,
    interpolated between the vertices, which takes unit normals to unit normals. Raises InvalidMesh where the edited
    vertices (V, 3) do not belong to the mesh or a triangle has lost its area.
    """
    edited_vertices = np.asarray(edited_vertices, dtype=float)
    if edited_vertices.shape != mesh.vertices.shape:
        raise InvalidMesh(f"the edited mesh has {len(edited_vertices)} vertices and the original {len(mesh.vertices)}; "
                          "edit the surface without changing its connectivity")
    edited = ReferenceMesh(edited_vertices, mesh.triangles)
    if not (np.isfinite(edited_vertices).all() and edited.areas.min() > 1e-9 * edited.areas.mean()):
        raise InvalidMesh("the edited mesh has triangles without area or coordinates that are no numbers; edit more gently")
    feet, faces = closest_on_mesh(mesh, points)
    share = _barycentric(feet, mesh.corners[faces])
    gradients = np.einsum("nk,nkij->nij", share, _gradients(mesh, edited)[mesh.triangles[faces]])
    offset = np.einsum("nij,nj->ni", gradients, points - feet)
    return np.einsum("nk,nki->ni", share, edited.corners[faces]) + offset


def _gradients(mesh: ReferenceMesh, edited: ReferenceMesh) -> np.ndarray:
    """Deformation gradients (V, 3, 3) at the vertices: means of those of the triangles around, by area."""
    before, after = (np.stack([m.corners[:, 1] - m.corners[:, 0], m.corners[:, 2] - m.corners[:, 0], m.normals], axis=-1)
                     for m in (mesh, edited))
    of_faces = (after @ np.linalg.inv(before)).reshape(-1, 9)
    corner, weight = mesh.triangles.ravel(), np.repeat(mesh.areas, 3)
    count = len(mesh.vertices)
    total = np.stack([np.bincount(corner, weight * np.repeat(entry, 3), count) for entry in of_faces.T], axis=1)
    return (total / np.maximum(np.bincount(corner, weight, count), 1e-300)[:, None]).reshape(-1, 3, 3)


def _barycentric(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Barycentric coordinates (N, 3) of points in triangles (N, 3, 3)."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    normal = np.cross(b - a, c - a)
    area = dot(normal, normal)
    second = dot(np.cross(points - a, c - a), normal) / area
    third = dot(np.cross(b - a, points - a), normal) / area
    return np.stack([1 - second - third, second, third], axis=1)

"""Closest points on triangle meshes and on smooth surfaces."""

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.surface import Surface, SurfacePoints
from plisse.geometry.vectors import dot, norm

__all__ = ["closest_on_mesh", "closest_on_surface", "closest_on_triangles"]


def closest_on_surface(surface: Surface, points: np.ndarray, start: np.ndarray | None = None) -> SurfacePoints:
    """Feet of perpendiculars: from `start` (default: the projections), by Newton's method in the tangent planes.

    With d the signed distance along the normal, the foot moves by (1 − d B)⁻¹ times the tangential part of the gap.
    """
    found = surface.project(points if start is None else start)
    limit = 0.1 * surface.diagonal
    for _ in range(20):
        gap = points - found.positions
        distance = dot(gap, found.normals)
        tangential = gap - distance[:, None] * found.normals
        if not np.nanmax(norm(tangential), initial=0) > 1e-12 * surface.diagonal:
            break
        # beyond a focal point 1 − dB has no positive inverse: there the plain tangential step still descends
        matrix = np.eye(3) - distance[:, None, None] * found.bending
        shaky = ~(np.linalg.eigvalsh(np.where(np.isfinite(matrix), matrix, 0)) > 0.1).all(axis=1)
        matrix[shaky] = np.eye(3)
        step = np.linalg.solve(matrix, tangential[..., None])[..., 0]
        step *= np.minimum(1, limit / np.maximum(norm(step), 1e-300))[:, None]
        found = surface.project(found.positions + step)
    return found


def closest_on_mesh(mesh: ReferenceMesh, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Closest points (N, 3) of the mesh and the faces (N,) they lie in, exact."""
    centres = mesh.corners.mean(axis=1)
    largest = float(norm(mesh.corners - centres[:, None]).max())
    tree = cKDTree(centres)
    positions, faces = np.empty((len(points), 3)), np.empty(len(points), np.int64)
    open_points, count = np.arange(len(points)), min(16, len(centres))
    while len(open_points):
        query = points[open_points]
        reach, near = tree.query(query, k=count)
        reach, near = reach.reshape(len(query), -1), near.reshape(len(query), -1)
        feet = closest_on_triangles(np.repeat(query[:, None], near.shape[1], axis=1), mesh.corners[near])
        distance = norm(feet - query[:, None])
        rows, best = np.arange(len(query)), np.argmin(distance, axis=1)
        positions[open_points], faces[open_points] = feet[rows, best], near[rows, best]
        sure = (distance[rows, best] + largest <= reach[:, -1]) | (count == len(centres))
        open_points, count = open_points[~sure], min(4 * count, len(centres))
    return positions, faces


def closest_on_triangles(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Closest points (…, 3) of triangles (…, 3, 3)."""
    a, b, c = np.moveaxis(corners, -2, 0)
    ab, ac, gap = b - a, c - a, points - a
    normal = np.cross(ab, ac)
    area = np.maximum(dot(normal, normal), 1e-300)
    v = dot(np.cross(gap, ac), normal) / area
    w = dot(np.cross(ab, gap), normal) / area
    inside = a + v[..., None] * ab + w[..., None] * ac
    best, nearest = inside, np.where((v >= 0) & (w >= 0) & (v + w <= 1), -1.0, np.inf)
    for p, q in ((a, b), (b, c), (c, a)):
        along = q - p
        fraction = np.clip(dot(points - p, along) / np.maximum(dot(along, along), 1e-300), 0, 1)
        foot = p + fraction[..., None] * along
        distance = dot(points - foot, points - foot)
        closer = distance < nearest
        best, nearest = np.where(closer[..., None], foot, best), np.where(closer, distance, nearest)
    return best

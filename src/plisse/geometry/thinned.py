"""Fewer vertices for smooth graphs: means over the cells of a grid keep what many noisy vertices know together."""

import numpy as np
from scipy.spatial import Delaunay

from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import cross_flat, norm, unit

__all__ = ["thinned"]

MOST = 20_000  # vertices that are taken as they are
ENOUGH = 10_000  # vertices of a thinned mesh at most, about
TOGETHER = 4  # vertices in a cell at least, in the mean
LONGEST = 3.5  # cells, that a side of a triangle is long: means beside an empty cell are nearer to each other


def thinned(mesh: ReferenceMesh) -> ReferenceMesh:
    """A graph with at most about `ENOUGH` vertices, means of a mesh with more than `MOST`; smaller ones as they are.

    Holes stay open if they are wider than the new edges.
    """
    if len(mesh.vertices) <= MOST:
        return mesh
    frame = _frame(mesh)
    plane = mesh.vertices @ frame.T
    size = np.sqrt(np.abs(_doubled_areas(plane, mesh.triangles)).sum() / 2 / min(ENOUGH, len(mesh.vertices) / TOGETHER))
    row, column = np.floor((plane[:, :2] - plane[:, :2].min(axis=0)) / size).astype(int).T
    owner = np.unique(row * (column.max() + 1) + column, return_inverse=True)[1]
    count = np.bincount(owner)
    means = np.stack([np.bincount(owner, values) / count for values in plane.T], axis=1)
    triangles = Delaunay(means[:, :2]).simplices
    sides = norm(means[triangles][:, :, :2] - means[np.roll(triangles, 1, axis=1)][:, :, :2])
    triangles = triangles[sides.max(axis=1) < LONGEST * size]
    turned = _doubled_areas(means, triangles) < 0
    triangles[turned] = triangles[turned][:, ::-1]
    used, triangles = np.unique(triangles, return_inverse=True)
    return ReferenceMesh(means[used] @ frame, triangles.reshape(-1, 3))


def _doubled_areas(plane: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Twice the signed areas (T,) of triangles in the plane of the first two coordinates."""
    a, b, c = plane[triangles].transpose(1, 0, 2)
    return cross_flat(b - a, c - a)


def _frame(mesh: ReferenceMesh) -> np.ndarray:
    """Rows: two directions in the mean plane, and its normal."""
    up = unit(mesh.face_vectors.sum(axis=0)[None])[0]
    x = unit(np.cross(up, np.eye(3)[np.argmin(np.abs(up))])[None])[0]
    return np.stack([x, np.cross(up, x), up])

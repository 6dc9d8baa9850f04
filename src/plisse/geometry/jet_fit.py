"""Cubic jets: at every point of a cloud the cubic height over its tangent plane that fits its neighbours best."""

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.vectors import dot, norm, unit

__all__ = ["fitted_jets"]

POWERS = np.array([[0, 0], [1, 0], [0, 1], [2, 0], [1, 1], [0, 2], [3, 0], [2, 1], [1, 2], [0, 3]])
NEIGHBOURS = 48  # points that a cubic is fitted to at most
TOGETHER = 1000  # jets fitted at once: what fits into a processor's cache


def fitted_jets(points: np.ndarray, normals: np.ndarray, radii: np.ndarray,
                tree: cKDTree) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients (V, 10) in units of the `radii` (V,), and frames (V, 3, 3) with rows x, y and the normal.

    Neighbours whose normals point elsewhere belong to another part of the surface and are left out.
    """
    parts = [_fit(points, normals, radii, tree, slice(i, i + TOGETHER)) for i in range(0, len(points), TOGETHER)]
    return np.concatenate([part[0] for part in parts]), np.concatenate([part[1] for part in parts])


def _fit(points: np.ndarray, normals: np.ndarray, radii: np.ndarray, tree: cKDTree,
         some: slice) -> tuple[np.ndarray, np.ndarray]:
    near = tree.query(points[some], k=min(NEIGHBOURS, len(points)))[1]
    gap = points[near] - points[some][:, None]
    radius, up = radii[some][:, None], normals[some]
    support = np.minimum(1.15 * radius, 0.98 * norm(gap[:, -1:]))
    weight = np.maximum(1 - dot(gap, gap) / support**2, 0) ** 4
    weight[np.einsum("nki,ni->nk", normals[near], up) < 0.2] = 0
    for _ in range(2):  # the second time over the tangent plane of the first jet
        frames = _frames(up)
        x, y, z = np.moveaxis(np.einsum("nij,nkj->nki", frames, gap), -1, 0) / radius
        monomials = np.stack([x**p * y**q for p, q in POWERS], axis=-1)
        jets = _least_squares(monomials, weight, z)
        up = unit(up - jets[:, 1:2] * frames[:, 0] - jets[:, 2:3] * frames[:, 1])
    return jets, frames


def _least_squares(monomials: np.ndarray, weight: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Coefficients (N, 10); cubic terms are held back slightly, so that sparse neighbourhoods stay determined."""
    weighted = monomials * weight[..., None]
    normal = np.swapaxes(weighted, 1, 2) @ monomials
    damping = np.array([1e-14] * 3 + [1e-12] * 3 + [1e-9] * 4) * weight.sum(axis=1)[:, None]
    normal[:, np.arange(10), np.arange(10)] += damping
    return np.linalg.solve(normal, np.einsum("nkc,nk->nc", weighted, values)[..., None])[..., 0]


def _frames(normals: np.ndarray) -> np.ndarray:
    """Orthonormal frames (N, 3, 3) with rows x, y and the normal."""
    axis = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    x = unit(np.cross(normals, axis))
    return np.stack([x, np.cross(normals, x), normals], axis=1)

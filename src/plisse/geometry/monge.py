"""Normals and bending of graphs z(x, y)."""

import numpy as np

__all__ = ["monge"]


def monge(slopes: np.ndarray, hessians: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Unit upward normals (N, 3) and bending tensors (N, 3, 3) from (zx, zy) and (zxx, zxy, zyy), component first.

    B is the Hessian of z over W = √(1 + zx² + zy²), restricted to the tangent plane.
    """
    zx, zy = slopes
    width = np.sqrt(1 + zx**2 + zy**2)
    normals = np.stack([-zx, -zy, np.ones_like(zx)], axis=-1) / width[:, None]
    flat = np.zeros((len(zx), 3, 3))
    flat[:, 0, 0], flat[:, 1, 1] = hessians[0], hessians[2]
    flat[:, 0, 1] = flat[:, 1, 0] = hessians[1]
    tangent = np.eye(3) - normals[:, :, None] * normals[:, None, :]
    return normals, tangent @ (flat / width[:, None, None]) @ tangent

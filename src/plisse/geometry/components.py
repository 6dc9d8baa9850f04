"""Vector algebra on component-first arrays (3, …), for code that runs at every iteration.

Rows of x, y and z that lie contiguous in memory are three to five times faster than (…, 3) arrays.
"""

import numpy as np

__all__ = ["cross", "dot", "norm", "unit"]


def dot(a, b):
    """Inner products a·b over the first axis, shape (…)."""
    return np.einsum("i...,i...->...", a, b)


def cross(a, b):
    """Vector products a × b, shape (3, …)."""
    shape = a.shape if a.shape == b.shape else np.broadcast_shapes(a.shape, b.shape)
    out = np.empty(shape, np.result_type(a, b))
    spare = np.empty(shape[1:], out.dtype)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[j], b[k], out=out[i])
        out[i] -= np.multiply(a[k], b[j], out=spare)
    return out


def norm(a):
    """Lengths |a| over the first axis, shape (…)."""
    return np.sqrt(dot(a, a))


def unit(a):
    """Directions a / |a|, same shape; zero vectors give nan."""
    return a / norm(a)

"""Vector algebra on component-first arrays (3, …), for code that runs at every iteration.

Rows of x, y and z that lie contiguous in memory are three to five times faster than (…, 3) arrays.
"""

import numpy as np

__all__ = ["angle_between", "cross", "dot", "norm", "unit"]

SMALL = 6000  # below, few calls matter more than rows that stay in the cache
AHEAD, BEHIND = np.array([1, 2, 0]), np.array([2, 0, 1])


def dot(a, b):
    """Inner products a·b over the first axis, shape (…)."""
    return np.einsum("i...,i...->...", a, b)


def cross(a, b):
    """Vector products a × b, shape (3, …)."""
    if max(a.size, b.size) < SMALL:
        return a.take(AHEAD, 0) * b.take(BEHIND, 0) - a.take(BEHIND, 0) * b.take(AHEAD, 0)
    shape = a.shape if a.shape == b.shape else np.broadcast_shapes(a.shape, b.shape)
    out = np.empty(shape, np.result_type(a, b))
    spare = np.empty(shape[1:], out.dtype)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        np.multiply(a[j], b[k], out=out[i])
        out[i] -= np.multiply(a[k], b[j], out=spare)
    return out


def angle_between(a, b):
    """Angles in [0, π] between vectors, shape (…), accurate near 0 and π."""
    return np.arctan2(norm(cross(a, b)), dot(a, b))


def norm(a):
    """Lengths |a| over the first axis, shape (…)."""
    return np.sqrt(dot(a, a))


def unit(a):
    """Directions a / |a|, same shape; zero vectors give nan."""
    return a / norm(a)

"""Vector algebra on component-first arrays (3, …), for code that runs at every iteration.

Rows of x, y and z that lie contiguous in memory are three to five times faster than (…, 3) arrays.
"""

import numpy as np

__all__ = ["cross", "dot", "norm", "unit"]


def dot(a, b):
    """Inner products a·b over the first axis, shape (…)."""
    total = a[0] * b[0]
    for x, y in zip(a[1:], b[1:], strict=True):
        total = total + x * y
    return total


def cross(a, b):
    """Vector products a × b, shape (3, …)."""
    out = np.empty(np.broadcast_shapes(a.shape, b.shape), np.result_type(a, b))
    out[0] = a[1] * b[2] - a[2] * b[1]
    out[1] = a[2] * b[0] - a[0] * b[2]
    out[2] = a[0] * b[1] - a[1] * b[0]
    return out


def norm(a):
    """Lengths |a| over the first axis, shape (…)."""
    return np.sqrt(dot(a, a))


def unit(a):
    """Directions a / |a|, same shape; zero vectors give nan."""
    return a / norm(a)

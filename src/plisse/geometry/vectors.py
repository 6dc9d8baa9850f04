"""Vector algebra on (…, 3) arrays, and angles that keep all digits (always by atan2)."""

import numpy as np

__all__ = ["angle_between", "cross_flat", "dot", "norm", "unit"]


def dot(a, b):
    """Inner products over the last axis, shape (…)."""
    return np.einsum("...i,...i->...", a, b)


def norm(a):
    """Lengths over the last axis, shape (…)."""
    return np.sqrt(dot(a, a))


def unit(a):
    """Directions, same shape; zero vectors stay zero."""
    length = norm(a)[..., None]
    return np.divide(a, length, out=np.zeros_like(a, dtype=float), where=length > 0)


def angle_between(a, b):
    """Angles in [0, π] between vectors (…, 3), accurate near 0 and π."""
    return np.arctan2(norm(np.cross(a, b)), dot(a, b))


def cross_flat(a, b):
    """Signed areas a × b of plane vectors (…, 2), shape (…)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

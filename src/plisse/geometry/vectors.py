"""Vector algebra on (…, 3) arrays, and angles that keep all digits (always by atan2)."""

import numpy as np

__all__ = ["angle_between", "cross", "cross_flat", "dot", "norm", "unit"]


def dot(a, b):
    """Inner products over the last axis, shape (…)."""
    return np.einsum("...i,...i->...", a, b)


def cross(a, b):
    """Vector products a × b of vectors (…, 3)."""
    x, y, z = (a[..., j] * b[..., k] - a[..., k] * b[..., j] for j, k in ((1, 2), (2, 0), (0, 1)))
    return np.stack([x, y, z], axis=-1)


def norm(a):
    """Lengths over the last axis, shape (…)."""
    return np.sqrt(dot(a, a))


def unit(a):
    """Directions, same shape; zero vectors stay zero."""
    length = norm(a)[..., None]
    is_long = length > 0
    return a / length if is_long.all() else np.divide(a, length, out=np.zeros_like(a, dtype=float), where=is_long)


def angle_between(a, b):
    """Angles in [0, π] between vectors (…, 3), accurate near 0 and π."""
    return np.arctan2(norm(cross(a, b)), dot(a, b))


def cross_flat(a, b):
    """Signed areas a × b of plane vectors (…, 2), shape (…)."""
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]

"""Bending of parametrised surfaces."""

from collections.abc import Iterable

import numpy as np

from plisse.geometry.vectors import dot

__all__ = ["bending", "symmetric"]


def bending(partials: Iterable[np.ndarray], second: Iterable[np.ndarray]) -> np.ndarray:
    """Bending tensors (N, 3, 3) from X_u, X_v (N, 3) and the second fundamental form L, M, N (N,) each.

    They are large, but finite, where the parametrisation is singular.
    """
    xu, xv = partials
    e, f, g = dot(xu, xu), dot(xu, xv), dot(xv, xv)
    size = np.maximum(e * g - f**2, np.finfo(float).tiny)[:, None]
    dual = np.stack([(g[:, None] * xu - f[:, None] * xv) / size, (e[:, None] * xv - f[:, None] * xu) / size], axis=1)
    return dual.swapaxes(-1, -2) @ symmetric(*second) @ dual


def symmetric(one: np.ndarray, mixed: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Symmetric matrices (N, 2, 2) from their entries (N,) each."""
    return np.stack([np.stack([one, mixed], axis=-1), np.stack([mixed, two], axis=-1)], axis=-2)

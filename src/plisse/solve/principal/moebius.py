"""Products of 2 × 2 matrices along a crease, and chains of affine maps, without loops.

A fold condition turns tan(β/2) into the next tan(β/2) by a Möbius map. On homogeneous coordinates (sin
β/2, cos β/2) it is a matrix, has no poles, and prefix products (a scan) compose all of them in log₂ n
passes.
"""

import numpy as np

__all__ = ["affine_chain", "homogeneous_chain", "inverse", "prefix_products", "sliced"]

Matrix = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]  # a, b, c, d of [[a, b], [c, d]], each (B, n)


def prefix_products(matrices: Matrix) -> Matrix:
    """M[i] … M[1] M[0] for every i, each up to a positive factor."""
    a, b, c, d = matrices
    reach, count = 1, a.shape[-1]
    while reach < count:
        later = tuple(x[..., reach:] for x in (a, b, c, d))
        earlier = tuple(x[..., :-reach] for x in (a, b, c, d))
        product = _scaled(_multiply(later, earlier))
        a, b, c, d = (np.concatenate([old[..., :reach], new], axis=-1)
                      for old, new in zip((a, b, c, d), product, strict=True))
        reach *= 2
    return a, b, c, d


def inverse(matrices: Matrix) -> Matrix:
    """The adjugates, which are the inverses up to a factor."""
    a, b, c, d = matrices
    return d, -b, -c, a


def sliced(matrices: Matrix, part: slice) -> Matrix:
    """The matrices of a part of the crease."""
    a, b, c, d = matrices
    return a[..., part], b[..., part], c[..., part], d[..., part]


def homogeneous_chain(matrices: Matrix, sine: np.ndarray,
                      cosine: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Images (B, n) of the state (sine, cosine), each (B,), under M[0], M[1] M[0], …, of any length."""
    a, b, c, d = prefix_products(matrices)
    u, v = sine[..., None], cosine[..., None]
    return a * u + b * v, c * u + d * v


def affine_chain(factor: np.ndarray, shift: np.ndarray, start: np.ndarray) -> np.ndarray:
    """x[i] = factor[i] x[i−1] + shift[i] from x[−1] = start (B,): a cumulative product and a sum, (B, n)."""
    product = np.cumprod(factor, axis=-1)
    return product * (start[..., None] + np.cumsum(shift / product, axis=-1))


def _multiply(left: tuple, right: tuple) -> Matrix:
    a, b, c, d = left
    e, f, g, h = right
    return a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h


def _scaled(matrices: Matrix) -> Matrix:
    a, b, c, d = matrices
    scale = 1 / (np.abs(a) + np.abs(b) + np.abs(c) + np.abs(d))
    return a * scale, b * scale, c * scale, d * scale

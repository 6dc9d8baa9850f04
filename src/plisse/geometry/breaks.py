"""Where a function that ought to be smooth is not: poles between samples, jumps at branch cuts, places without a value."""

from collections.abc import Callable

import numpy as np

__all__ = ["broken_place"]

CELLS = 48  # along each side, to begin with
HALVINGS = 14
SMOOTH = 1e-3  # of the typical change over the whole domain, by which a value may miss the trapezoidal rule
RESOLVED = 0.1  # of the change along an edge, the same
MOST = 20_000  # cells looked at in one round

Differentiable = Callable[[np.ndarray], tuple[np.ndarray, np.ndarray, np.ndarray]]


def broken_place(function: Differentiable, low: complex, high: complex) -> complex | None:
    """A place between two corners of a rectangle where a function has a pole, a jump or no value; None if it is smooth.

    `function` gives value and both partial derivatives (N,) at places (N,). Cells are halved again and again where the
    change along an edge is not what derivatives at its ends say; near poles and jumps that never gets better.
    """
    u = np.linspace(low.real, high.real, CELLS + 1)
    v = np.linspace(low.imag, high.imag, CELLS + 1)
    size = np.array([u[1] - u[0], v[1] - v[0]])
    corners = (u[:-1, None] + 1j * v[:-1]).ravel()
    scale = None
    for _ in range(HALVINGS):
        around = corners[:, None] + np.array([0, size[0], size[0] + 1j * size[1], 1j * size[1]])
        value, du, dv = (part.reshape(around.shape) for part in function(around.ravel()))
        if not (fine := np.isfinite(value) & np.isfinite(du) & np.isfinite(dv)).all():
            return complex(around[~fine][0])
        if scale is None:
            scale = SMOOTH * float(np.median(np.maximum(np.abs(du), np.abs(dv)))) * abs(high - low) + np.finfo(float).tiny
        corners = corners[_is_rough(value, du, dv, around, scale)]
        if not len(corners):
            return None
        size = size / 2
        corners = (corners[:, None] + np.array([0, size[0], size[0] + 1j * size[1], 1j * size[1]])).ravel()[:MOST]
    return complex(corners[0])


def _is_rough(value: np.ndarray, du: np.ndarray, dv: np.ndarray, around: np.ndarray, scale: float) -> np.ndarray:
    """Mask (N,) of cells with an edge along which a value changes otherwise than its derivatives say."""
    rough = np.zeros(len(value), bool)
    for k in range(4):
        step = around[:, (k + 1) % 4] - around[:, k]
        expected = [du[:, j] * step.real + dv[:, j] * step.imag for j in (k, (k + 1) % 4)]
        change = value[:, (k + 1) % 4] - value[:, k]
        miss = np.abs(change - 0.5 * (expected[0] + expected[1]))
        rough |= (miss > scale) & (miss > RESOLVED * (np.abs(expected[0]) + np.abs(expected[1])))
    return rough

"""Widths of the strips between guiding curves, and how both sides of a crease couple (Fig. 11)."""

import numpy as np
from scipy.interpolate import CubicSpline, make_interp_spline
from scipy.ndimage import gaussian_filter1d

__all__ = ["mirrored_width", "nominal_widths", "strip_widths"]


def strip_widths(width, theta: np.ndarray, amplitude: float, parameters: np.ndarray, *, closed: bool = False,
                 spacing: str = "mirror") -> np.ndarray:
    """Widths s (m−1, n) on the surface for nominal widths as a design gives them and inclinations (m,) in radians.

    With `mirror` spacing the strips that fall (every second one) are narrowed so that both sides of a crease are
    mirror images in its rectifying plane: sinθ = d (1/s2 − 1/s1). `uniform` is the paper's choice.
    """
    widths = nominal_widths(width, len(theta) - 1, parameters, closed)
    if spacing == "mirror":
        between = 0.5 * (theta[1:] + theta[:-1])
        widths[1::2] = mirrored_width(widths[1::2], between[1::2, None], amplitude)
    return widths


def mirrored_width(width: np.ndarray, theta: np.ndarray, amplitude: float) -> np.ndarray:
    """Width s2 of the falling strip beside a climbing one of width s1."""
    return 1 / (np.sin(theta) / amplitude + 1 / width)


def nominal_widths(width, strips: int, parameters: np.ndarray, closed: bool = False) -> np.ndarray:
    """Widths (strips, n) from a length, one per strip, or a table [[position, width], …] along the curve.

    Tables are interpolated smoothly: a corner in the width would become a corner in every crease.
    """
    values = np.asarray(width, dtype=float)
    if values.ndim < 2:
        return np.broadcast_to(values.reshape(-1, 1) if values.ndim else values, (strips, len(parameters))).copy()
    profile = _profile(values, closed)(parameters % 1.0 if closed else parameters)
    return np.broadcast_to(profile, (strips, len(parameters))).copy()


def _profile(table: np.ndarray, closed: bool):
    """A smooth function through the table, or near it where a spline through it would swing beyond its values."""
    position, value = table.T
    if closed:
        if position[0] + 1 - position[-1] > 1e-9:
            position, value = np.append(position, position[0] + 1), np.append(value, value[0])
        spline = CubicSpline(position, value, bc_type="periodic")
        interpolant = lambda u: spline(position[0] + (u - position[0]) % 1.0)  # noqa: E731
    else:
        inner = make_interp_spline(position, value, k=min(3, len(table) - 1))
        interpolant = lambda u: inner(np.clip(u, position[0], position[-1]))  # noqa: E731
    fine = np.linspace(0, 1, 1001)
    swing = 0.1 * np.ptp(value)
    values = interpolant(fine)
    if values.min() >= max(value.min() - swing, 0.5 * value.min()) and values.max() <= value.max() + swing:
        return interpolant
    return _softened(position, value, closed)


def _softened(position: np.ndarray, value: np.ndarray, closed: bool):
    """The piecewise linear function through the table, smoothed over a twentieth of the curve."""
    fine = np.linspace(0, 1, 1001)
    linear = np.interp(fine, position, value, period=1.0 if closed else None)
    smooth = gaussian_filter1d(linear, 50.0, mode="wrap" if closed else "nearest")
    return CubicSpline(fine, np.append(smooth[:-1], smooth[0]) if closed else smooth, bc_type="periodic" if closed else
                       "not-a-knot")

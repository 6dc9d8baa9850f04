"""Holomorphic functions of z as text, with exact derivatives: Weierstrass data of minimal surfaces."""

from collections.abc import Callable

import numpy as np

from plisse.geometry.expression import Jet, checked_formula, jet_of

__all__ = ["holomorphic"]

FUNCTIONS = ("sin", "cos", "tan", "exp", "log", "sqrt")


def holomorphic(text: str, what: str) -> Callable[[np.ndarray], tuple[np.ndarray, np.ndarray]]:
    """The function z → (value, derivative) of an expression in z and i, complex (N,); nan where it is not defined.

    `what` names it in messages. Raises InvalidDesign for anything but a formula of bounded size.
    """
    tree = checked_formula(text, ("z", "i"), what, FUNCTIONS)

    def at(z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        part, constant = np.zeros((6, len(z)), complex), np.zeros((6, 1), complex)
        part[0], part[1] = z, 1  # the first of two real variables is z; nothing depends on the second
        constant[0] = 1j
        with np.errstate(all="ignore"):
            value, derivative = np.broadcast_to(jet_of(tree, {"z": Jet(part), "i": Jet(constant)}).part, part.shape)[:2]
        defined = np.isfinite(value) & np.isfinite(derivative)
        return np.where(defined, value, np.nan), np.where(defined, derivative, np.nan)

    return at

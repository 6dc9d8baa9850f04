"""Quadratic functions minimised under linear equations: one sparse factorisation and a few refinements."""

import numpy as np
from scipy.sparse import block_array, csc_array, eye_array
from scipy.sparse.linalg import splu

from plisse.errors import Infeasible

__all__ = ["least_quadratic", "projected"]

DAMPING = 1e-13
REFINEMENTS = 6


def least_quadratic(hessian, gradient: np.ndarray, matrix, right: np.ndarray) -> np.ndarray:
    """The x (N,) that minimises xᵀ H x / 2 − gᵀ x subject to A x = b.

    The equations may repeat each other; a damping of 1e-13 picks one solution and refinement removes what it does to x.
    Raises Infeasible where no x satisfies the equations.
    """
    size, rows = matrix.shape[1], matrix.shape[0]
    exact = csc_array(block_array([[hessian, matrix.T], [matrix, None]]))
    damped = csc_array(block_array([[hessian, matrix.T], [matrix, -DAMPING * eye_array(rows)]]))
    try:
        factor = splu(damped)
    except RuntimeError:
        raise Infeasible("the conditions on a parallel mesh leave it undetermined; prescribe less or keep it open") from None
    wanted = np.concatenate([gradient, right])
    found = np.zeros(size + rows)
    for _ in range(REFINEMENTS):
        found = found + factor.solve(wanted - exact @ found)
    return found[:size]


def projected(values: np.ndarray, matrix) -> np.ndarray:
    """The values (N,) moved as little as possible so that A x = 0."""
    return least_quadratic(eye_array(len(values)), values, matrix, np.zeros(matrix.shape[0]))

"""Componentwise kernels: values and differences of points against data at rest."""

import numpy as np

from plisse.leastsquares.kernel import kernel

__all__ = ["first_difference", "second_difference", "value"]


@kernel(componentwise=True)
def value(p, *, rest):
    """p − rest."""
    return p - rest


@value.jacobian
def _(p, *, rest):
    return (np.ones_like(p),)


@kernel(componentwise=True)
def first_difference(p, q, *, rest):
    """q − p − rest."""
    return q - p - rest


@first_difference.jacobian
def _(p, q, *, rest):
    return -np.ones_like(p), np.ones_like(p)


@kernel(componentwise=True)
def second_difference(p, q, r, *, rest):
    """p − 2q + r − rest."""
    return p - 2 * q + r - rest


@second_difference.jacobian
def _(p, q, r, *, rest):
    return np.ones_like(p), np.full_like(p, -2.0), np.ones_like(p)

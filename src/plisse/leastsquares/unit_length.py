"""Unit vectors as unknowns."""

from plisse.geometry.components import dot
from plisse.leastsquares.kernel import kernel

__all__ = ["unit_length"]


@kernel
def unit_length(normal):
    """|n|² − 1."""
    return dot(normal, normal) - 1


@unit_length.jacobian
def _(normal):
    return (2 * normal,)

"""Signed sums of the sector angles around a vertex, the common core of `angle_sum` and `flat_fold`."""

import numpy as np

from plisse.geometry.components import cross, dot

__all__ = ["signed_angle_gradients", "signed_angles"]

TINY = 1e-300


def signed_angles(centre, ring, signs):
    """Σ ± ω over the angles between successive ring vertices (k arrays (3, N)) seen from the centre, shape (N,)."""
    spokes = [vertex - centre for vertex in ring]
    total = 0.0
    for k, sign in enumerate(signs):
        u, v = spokes[k], spokes[(k + 1) % len(ring)]
        normal = cross(u, v)
        total = total + sign * np.arctan2(np.sqrt(dot(normal, normal)), dot(u, v))
    return total


def signed_angle_gradients(centre, ring, signs):
    """Gradients by the centre and by every ring vertex.

    The angle from u to v turns by (u × n)/|u|² when u moves, n the unit normal of u and v.
    """
    spokes = [vertex - centre for vertex in ring]
    normals = []
    for k, sign in enumerate(signs):
        normal = cross(spokes[k], spokes[(k + 1) % len(ring)])
        normals.append(normal * (sign / np.sqrt(dot(normal, normal) + TINY)))
    outer = [cross(u, normals[k] - normals[k - 1]) / dot(u, u) for k, u in enumerate(spokes)]
    return (-sum(outer), *outer)

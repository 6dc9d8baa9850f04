"""Strips: the developable between two creases, as a crease polyline with its rulings and face planes.

Everything is component-first and batched: points (3, B, n). In face i lie the edge i → i+1 of the crease
and the rulings i and i+1. An open strip has n − 1 faces and free end rulings, a closed one n of each.
"""

from typing import NamedTuple

import numpy as np

from plisse.geometry.components import cross, dot, unit

__all__ = ["Strip", "edge_directions", "rulings_between", "successor"]

_CONTINUATION = np.array([1.8, 0.0, -0.8, -0.6, 0.6])  # parabola through 5 equidistant values, one step further
_STEEPEST_END = 0.1  # largest change of cot(ruling angle) from the last but one ruling to the free end ruling


class Strip(NamedTuple):
    """Crease points (3, B, n), unit edges and unit face normals (3, B, faces), unit rulings (3, B, n).

    The edges are carried along although the points determine them: rounded points know an edge only to
    1e-16 |X| / h, and rulings amplify that error by 1 / (κ h).
    """

    points: np.ndarray
    edges: np.ndarray
    normals: np.ndarray
    rulings: np.ndarray

    def column(self, batch: slice) -> "Strip":
        """The strips of some members of the batch."""
        return Strip(*(array[:, batch] for array in self))


def successor(array: np.ndarray) -> np.ndarray:
    """The cyclic successors along the last axis: entry i + 1 at place i."""
    return np.roll(array, -1, axis=-1)


def edge_directions(points: np.ndarray, closed: bool) -> np.ndarray:
    """Unit edges (3, B, n − 1) of open polylines, (3, B, n) of closed ones."""
    return unit(successor(points) - points) if closed else unit(points[..., 1:] - points[..., :-1])


def rulings_between(edges: np.ndarray, inward: np.ndarray, normals: np.ndarray, closed: bool) -> np.ndarray:
    """Rulings (3, B, n): where planes of neighbouring faces meet, on the side of the strip.

    `inward` (3, B, faces) lies in each face, orthogonal to its edge. f × g is taken as f × (g − f): the
    planes are almost parallel and the difference is exact, so rulings lie in both planes to rounding
    error.
    """
    if closed:
        before, after = np.roll(normals, 1, axis=-1), normals
        side = np.roll(inward, 1, axis=-1) + inward
    else:
        before, after = normals[..., :-1], normals[..., 1:]
        side = inward[..., :-1] + inward[..., 1:]
    inner = unit(cross(before, after - before))
    inner = inner * np.where(dot(inner, side) < 0, -1.0, 1.0)
    return inner if closed else _with_ends(edges, inward, inner)


def _with_ends(edges: np.ndarray, inward: np.ndarray, inner: np.ndarray) -> np.ndarray:
    """Free rulings at both ends, in the planes of the end faces; their angles continue those of the others."""
    near = len(_CONTINUATION)
    first = _end_cotangent(edges[..., 1:near + 1], inward[..., 1:near + 1], inner[..., :near])
    back = slice(-2, -near - 2, -1)
    last = _end_cotangent(edges[..., back], inward[..., back], inner[..., :-near - 1:-1])
    start = unit(first * edges[..., 0] + inward[..., 0])[..., None]
    end = unit(last * edges[..., -1] + inward[..., -1])[..., None]
    return np.concatenate([start, inner, end], axis=-1)


def _end_cotangent(edges: np.ndarray, inward: np.ndarray, rulings: np.ndarray) -> np.ndarray:
    """Cotangent (B,) of the ruling angle at the end, from the rulings (3, B, 5) next to it, nearest first."""
    cotangent = dot(rulings, edges) / dot(rulings, inward)
    nearest = cotangent[..., 0]
    return nearest + np.clip(cotangent @ _CONTINUATION - nearest, -_STEEPEST_END, _STEEPEST_END)

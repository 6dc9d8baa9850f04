"""Both strips of a seed polyline: rectifying planes, opened by a constant angle (§2.2, §2.5).

The strips on both sides of a crease with constant fold angle are mirror images in its rectifying plane.
On a polyline that plane is carried along by reflections: the mirror that takes edge e[i−1] to e[i] takes
binormal b[i−1] to b[i]. Measured from a smooth reference field the angle of b obeys angle[i] = c[i] −
angle[i−1]. Its free constant is no freedom of design but an alternating (checkerboard) mode, which is
removed.
"""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.components import cross, dot, unit
from plisse.solve.principal.strip import Strip, edge_directions, rulings_between

__all__ = ["rectifying_binormals", "seed_strip"]

_CLOSING_GAP = 1e-9  # radians by which binormals of an even closed polyline may miss themselves


def rectifying_binormals(points: np.ndarray, reference: np.ndarray, closed: bool = False) -> np.ndarray:
    """Unit binormals (3, B, faces), orthogonal to the edges of a polyline (3, B, n), in rectifying planes.

    `reference` (3, B, faces) is any smooth field that is nowhere parallel to the curve. A closed polyline
    with an odd number of points has exactly one such field up to sign; with an even number a sum has to
    vanish, which it does to rounding error on smooth well sampled curves, and the constant is chosen as
    on open ones.
    """
    edges = edge_directions(points, closed)
    first = unit(reference - dot(reference, edges) * edges)
    second = cross(edges, first)
    turns = _reflected_angles(edges, first, second)
    angle = _closed_angles(turns) if closed else _without_checkerboard(turns[..., 1:])
    return np.cos(angle) * first + np.sin(angle) * second


def seed_strip(points: np.ndarray, binormals: np.ndarray, half_opening: np.ndarray, side: float,
               closed: bool = False) -> Strip:
    """The strip on one side (±1): its faces make the angle half_opening (B,) with the rectifying planes."""
    edges = edge_directions(points, closed)
    half = np.asarray(half_opening)[..., None]
    inward = np.cos(half) * binormals + side * np.sin(half) * cross(edges, binormals)
    normals = cross(edges, inward)
    rulings = rulings_between(edges, inward, normals, closed)
    points, edges = np.broadcast_to(points, rulings.shape), np.broadcast_to(edges, normals.shape)
    return Strip(points, edges, normals, rulings)


def _reflected_angles(edges: np.ndarray, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """c (B, faces): where the reference of the edge before lands under the mirror, in this edge's frame."""
    before, frame = np.roll(edges, 1, axis=-1), np.roll(first, 1, axis=-1)
    mirror = edges - before
    length = dot(mirror, mirror)
    image = frame - 2 * dot(frame, mirror) / np.where(length > 0, length, 1.0) * mirror
    return np.arctan2(dot(image, second), dot(image, first))


def _without_checkerboard(turns: np.ndarray) -> np.ndarray:
    """Solve angle[i] = turns[i−1] − angle[i−1]; the constant is the one without an alternating part."""
    signs = (-1.0) ** np.arange(turns.shape[-1] + 1)
    zero = np.zeros((*turns.shape[:-1], 1))
    unsigned = np.concatenate([zero, np.cumsum(signs[1:] * turns, axis=-1)], axis=-1)
    unsigned = unsigned - 0.5 * (unsigned[..., 1:] + unsigned[..., :-1]).mean(axis=-1, keepdims=True)
    differences = np.diff(signs * unsigned, n=6, axis=-1)
    alternating = -signs[3:-3] * differences / 64
    return signs * (unsigned - np.median(alternating, axis=-1, keepdims=True))


def _closed_angles(turns: np.ndarray) -> np.ndarray:
    """The periodic solution of angle[i] = turns[i] − angle[i−1]."""
    count = turns.shape[-1]
    if count % 2 == 0:
        total = ((-1.0) ** np.arange(count) * turns).sum(axis=-1)
        gap = np.abs(np.arctan2(np.sin(total), np.cos(total)))
        if gap.max() > _CLOSING_GAP:
            raise Infeasible(f"rectifying planes along {count} points of a closed crease miss themselves by "
                             f"{np.degrees(gap.max()):.2g}°: use an odd number of points")
        return _without_checkerboard(turns[..., 1:])
    signs = (-1.0) ** np.arange(count)
    unsigned = np.cumsum(signs[1:] * turns[..., 1:], axis=-1)
    unsigned = np.concatenate([np.zeros_like(turns[..., :1]), unsigned], axis=-1)
    return signs * (unsigned + 0.5 * (turns[..., :1] - unsigned[..., -1:]))

"""Strips of a given thickness: closed, oriented solids."""

from typing import NamedTuple

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.vectors import dot, unit
from plisse.transform.strips import RectifyingStrip

__all__ = ["StripSolid", "strip_solid"]


class StripSolid(NamedTuple):
    """Vertices (V, 3) in model units and quads (F, 4), counterclockwise seen from outside."""

    vertices: np.ndarray
    quads: np.ndarray

    @property
    def triangles(self) -> np.ndarray:
        """The quads cut in two (2F, 3)."""
        return self.quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def strip_solid(strip: RectifyingStrip, thickness: float) -> StripSolid:
    """The strip thickened by half of `thickness` to both sides of its faces.

    Both sides are made of planar quads parallel to those of the strip: planes moved by half the thickness meet in lines
    parallel to the rulings. The narrow walls between them are slightly twisted. Raises Infeasible where the strip bends
    too sharply for the thickness.
    """
    if not thickness > 0:
        raise Infeasible(f"a solid of thickness {thickness:g} is none; give a positive length")
    normals = np.concatenate([strip.normals[:1], strip.normals, strip.normals[-1:]])
    before, after = normals[:-1], normals[1:]
    mitre = 0.5 * thickness * (before + after) / (1 + dot(before, after))[:, None]
    low, high = strip.row(strip.low), strip.row(strip.high)
    _require_room(strip, [low + sign * mitre for sign in (-1, 1)] + [high + sign * mitre for sign in (-1, 1)])
    count = len(strip.points)
    ring = np.arange(count) + count * np.arange(4)[:, None]  # below low, below high, above high, above low
    vertices = np.concatenate([low - mitre, high - mitre, high + mitre, low + mitre])
    quads = [np.stack([a[:-1], b[:-1], b[1:], a[1:]], axis=1) for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True)]
    quads += [ring[::-1, :1].T, ring[:, -1:].T]
    return StripSolid(vertices, np.concatenate(quads))


def _require_room(strip: RectifyingStrip, rows: list[np.ndarray]) -> None:
    """Raise Infeasible where an edge of the solid would turn round."""
    edges = unit(np.diff(strip.points, axis=0))
    turned: np.ndarray = (dot(np.diff(np.stack(rows), axis=1), edges) <= 0).any(axis=0)
    if turned.any():
        percent = 100 * (int(np.argmax(turned)) + 0.5) / len(turned)
        raise Infeasible(f"a strip bends too sharply near {percent:.0f} % of its length for this thickness; give less, or "
                         "narrower strips")

"""Pieces to cut out, and where on which sheet they lie."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from plisse.errors import Infeasible
from plisse.fabricate.paper import Paper
from plisse.fabricate.tabs import Tab

__all__ = ["Piece", "Placement", "pieces_from"]

SHARPEST = 3.0


@dataclass(frozen=True, eq=False)
class Piece:
    """Faces of the development that stay together, numbered from 1, with its flaps and its area in mm².

    `faces` is a mask over all faces. `outline` is the line to cut as a shapely polygon, with flaps and grown by half
    the kerf, in the place of the piece within the development.
    """

    number: int
    faces: np.ndarray
    area: float
    tabs: tuple[Tab, ...]
    outline: Any

    @property
    def rings(self) -> tuple[np.ndarray, ...]:
        """Closed lines (N, 2) to cut, first point not repeated, the outer one first."""
        from shapely import get_coordinates

        return tuple(get_coordinates(ring)[:-1] for ring in (self.outline.exterior, *self.outline.interiors))


@dataclass(frozen=True)
class Placement:
    """A turn by `angle` radians about the origin, then a shift in mm, onto sheet number `sheet` from 0."""

    sheet: int
    angle: float
    shift: tuple[float, float]

    def apply(self, points: np.ndarray) -> np.ndarray:
        """Points (N, 2) of the development on the sheet."""
        cos, sin = np.cos(self.angle), np.sin(self.angle)
        return np.asarray(points) @ np.array([[cos, sin], [-sin, cos]]) + self.shift


def pieces_from(paper: Paper, masks: list[np.ndarray], tabs: tuple[Tab, ...], kerf: float) -> tuple[Piece, ...]:
    """The pieces as they are cut, given their faces as masks.

    Flaps that grow together around a hole, where a cut as wide as the kerf cannot go, are left out. Raises Infeasible
    where the kerf is wider than a piece.
    """
    out = []
    for k, mask in enumerate(masks):
        own, polygon = tuple(tab for tab in tabs if tab.piece == k), paper.polygon(mask)
        outline = _outline(polygon, own, kerf, k + 1)
        if kerf and own:
            own, outline = _without_islands(polygon, own, outline, kerf, k + 1)
        out.append(Piece(k + 1, mask, float(paper.face_areas[mask].sum()), own, outline))
    return tuple(out)


def _without_islands(polygon, tabs: tuple[Tab, ...], outline, kerf: float, number: int):
    """The flaps beside no hole that only they make, and the outline with them."""
    from shapely import Polygon, intersects

    holes = [Polygon(ring) for ring in outline.interiors]
    own = [hole for hole in holes if not any(hole.intersects(Polygon(ring)) for ring in polygon.interiors)]
    around = [hole.buffer(kerf) for hole in own]
    kept = tuple(tab for tab in tabs if not intersects(Polygon(tab.points), around).any()) if own else tabs
    return kept, outline if kept is tabs else _outline(polygon, kept, kerf, number)


def _outline(polygon, tabs: tuple[Tab, ...], kerf: float, number: int):
    """A piece with its flaps as a shapely polygon, grown by half the kerf."""
    from shapely import Polygon, union_all

    if kerf and polygon.buffer(-kerf / 2).is_empty:
        raise Infeasible(f"a kerf of {kerf:g} mm is wider than piece {number}; give the width of the cut, or a larger scale")
    whole = union_all([polygon, *(Polygon(tab.points) for tab in tabs)]) if tabs else polygon
    return whole.buffer(kerf / 2, join_style="mitre", mitre_limit=SHARPEST) if kerf else whole

"""Overlaps of the development (paper, Figs 19 and 27): legitimate on the desk, not on one sheet of paper."""

from dataclasses import dataclass
from itertools import combinations

import numpy as np
import shapely

from plisse.geometry.vectors import cross_flat
from plisse.structure.chains import boundary_loops
from plisse.structure.parts import parts
from plisse.structure.topology import Topology

__all__ = ["Overlap", "development_overlap"]


@dataclass(frozen=True)
class Overlap:
    """Whether a development covers a place twice, and one such place (x, y) in model units."""

    overlaps: bool
    place: tuple[float, float] | None = None


def development_overlap(topology: Topology, flat: np.ndarray) -> Overlap:
    """Overlap of a development (V, 2) without inverted faces: of a piece with itself, or of one piece with another."""
    pieces = parts(topology)
    for piece in pieces:
        found = _of_one_piece(piece.topology, flat[piece.vertices])
        if found.overlaps:
            return found
    sheets = [shapely.union_all([shapely.Polygon(flat[piece.vertices[loop]]) for loop in boundary_loops(piece.topology)])
              for piece in pieces if len(pieces) > 1]
    for one, other in combinations(sheets, 2):
        met = one.intersection(other)
        if met.area > 1e-9 * one.area:
            place = met.representative_point()
            return Overlap(True, (float(place.x), float(place.y)))
    return Overlap(False)


def _of_one_piece(topology: Topology, flat: np.ndarray) -> Overlap:
    """An immersed disk covers no place twice exactly when its boundary is a simple curve, so only boundary loops are
    tested; several loops bound the holes of a masked grid.
    """
    loops = sorted((shapely.LinearRing(flat[loop]) for loop in boundary_loops(topology)),
                   key=lambda ring: -shapely.Polygon(ring).area)
    if not loops:
        return Overlap(False)
    for ring in loops:
        if not ring.is_simple:
            return Overlap(True, _crossing(ring))
    outer, holes = shapely.Polygon(loops[0]), loops[1:]
    outside = [hole for hole in holes if not outer.contains(shapely.Polygon(hole))]
    if outside:
        x, y = outside[0].coords[0][:2]
        return Overlap(True, (float(x), float(y)))
    area = outer.area - sum(shapely.Polygon(hole).area for hole in holes)
    a, b, c, d = (flat.take(column, axis=0) for column in topology.quads.T)
    covered = 0.5 * np.abs(cross_flat(c - a, d - b)).sum()
    covered += sum(shapely.Polygon(flat[hub]).area for hub in topology.hubs)
    return Overlap(bool(covered > area * (1 + 1e-6)), None)


def _crossing(ring: shapely.LinearRing) -> tuple[float, float]:
    """A point in which the ring meets itself."""
    pieces = shapely.node(ring)
    ends = shapely.get_coordinates([shapely.get_point(piece, 0) for piece in shapely.get_parts(pieces)])
    corner = shapely.get_coordinates(ring)
    new = [p for p in ends if np.abs(corner - p).sum(axis=1).min() > 0]
    x, y = new[0] if new else ends[0]
    return float(x), float(y)

"""Faces from two families of curves laid over each other: quads, and a polygon around every singularity (§2.6)."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
import shapely
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from plisse.errors import Infeasible
from plisse.layout.asymptotic.crossings import Crossings
from plisse.layout.asymptotic.leaf import Leaf
from plisse.structure.topology import Topology

__all__ = ["Net", "overlay"]


@dataclass(frozen=True, eq=False)
class Net:
    """Crossings of creases and columns, joined to faces: `places` (V,) in the plane, and on which curves they lie.

    `crease` and `column` (V,) are numbers in `creases` and `columns`; `along` (V,) is the length in the plane along
    the crease. `hubs` are the places that polygons surround. `crossings` are all that there are, also those without faces.
    """

    crossings: Crossings
    hubs: tuple[complex, ...]
    places: np.ndarray
    crease: np.ndarray
    column: np.ndarray
    along: np.ndarray
    topology: Topology

    @property
    def creases(self) -> tuple[Leaf, ...]:
        """The creases, also those without faces."""
        return self.crossings.creases

    @property
    def columns(self) -> tuple[Leaf, ...]:
        """The columns, also those without faces."""
        return self.crossings.columns


def overlay(crossings: Crossings, hubs: tuple[complex, ...]) -> Net:
    """The net of the largest connected part whose cells have alternating sides: quads, and polygons around `hubs`.

    Raises Infeasible where no such cells exist.
    """
    crease, column, places = crossings.crease, crossings.column, crossings.places
    start, end, is_crease = _segments(crossings)
    kept = _without_loose_ends(start, end, len(places))
    quads, polygons = np.empty((0, 4), int), list[np.ndarray]()
    if kept.any():
        quads, polygons = _alternating(places, _corners(places, start[kept], end[kept], is_crease[kept]), hubs)
    if not len(quads):
        raise Infeasible("creases and columns do not cross in a single quad; give a smaller width, or more columns")
    quads, polygons = _largest_part(quads, polygons, len(places))
    used = np.unique(np.concatenate([quads.ravel(), *polygons]))
    used = used[np.lexsort((crossings.along[used], crease[used]))]
    number = np.full(len(places), -1)
    number[used] = np.arange(len(used))
    topology = Topology(len(used), number[quads], tuple(number[polygon] for polygon in polygons))
    return Net(crossings, hubs, places[used], crease[used], column[used], crossings.along[used], topology)


def _segments(crossings: Crossings) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Start, end and kind of the edges between successive crossings, in both directions."""
    starts, ends, kinds = [], [], []
    for owner, along, kind in ((crossings.crease, crossings.along, True),
                               (crossings.column, crossings.across, False)):
        order = np.lexsort((along, owner))
        same = owner[order[:-1]] == owner[order[1:]]
        a, b = order[:-1][same], order[1:][same]
        starts += [a, b]
        ends += [b, a]
        kinds.append(np.full(2 * len(a), kind))
    return np.concatenate(starts), np.concatenate(ends), np.concatenate(kinds)


def _without_loose_ends(start: np.ndarray, end: np.ndarray, count: int) -> np.ndarray:
    """Mask of the edges that remain when vertices with a single edge are taken away again and again."""
    kept = np.ones(len(start), bool)
    while True:
        degree = np.bincount(start[kept], minlength=count)
        loose = kept & ((degree[start] == 1) | (degree[end] == 1))
        if not loose.any():
            return kept
        kept &= ~loose


class _Corners(NamedTuple):
    """Corners of all cells: vertex, kind of the edge that starts there, the next corner, and the number of the cell."""

    vertex: np.ndarray
    is_crease: np.ndarray
    following: np.ndarray
    cell: np.ndarray


def _corners(places: np.ndarray, start: np.ndarray, end: np.ndarray, is_crease: np.ndarray) -> _Corners:
    """Corners of the cells between straight edges that are given in both directions."""
    angle = np.angle(places[end] - places[start])
    around = np.lexsort((angle, start))
    first = np.flatnonzero(np.r_[True, np.diff(start[around]) > 0])
    before = np.arange(len(around)) - 1
    before[first] = np.append(first[1:], len(around)) - 1
    clockwise = np.empty(len(around), int)
    clockwise[around] = around[before]
    twin = _twins(start, end)
    following = clockwise[twin]
    cell = connected_components(coo_array((np.ones(len(following)), (np.arange(len(following)), following)),
                                          shape=(len(following),) * 2), directed=False)[1]
    return _Corners(start, is_crease, following, cell)


def _twins(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    there, back = np.lexsort((end, start)), np.lexsort((start, end))
    twin = np.empty(len(start), int)
    twin[there] = back
    return twin


def _alternating(places: np.ndarray, corners: _Corners,
                 hubs: tuple[complex, ...]) -> tuple[np.ndarray, list[np.ndarray]]:
    """Quads (F, 4) that begin with a crease, and polygons around hubs."""
    vertex, is_crease, following, cell = corners
    count = np.bincount(cell)
    turned = np.bincount(cell, (np.conj(places[vertex]) * places[vertex[following]]).imag)
    odd = np.bincount(cell, is_crease == is_crease[following])
    good = (turned > 0) & (odd == 0)
    first = np.flatnonzero(is_crease & good[cell] & (count[cell] == 4))
    first = first[np.unique(cell[first], return_index=True)[1]]
    quads = np.stack([vertex[first], vertex[a := following[first]], vertex[b := following[a]], vertex[following[b]]], axis=1)
    polygons = []
    for number in np.flatnonzero(good & (count > 4)):
        corner = int(np.flatnonzero((cell == number) & is_crease)[0])
        loop = []
        for _ in range(count[number]):
            loop.append(vertex[corner])
            corner = following[corner]
        outline = shapely.Polygon(np.column_stack([places[loop].real, places[loop].imag]))
        if shapely.contains_xy(outline, [hub.real for hub in hubs], [hub.imag for hub in hubs]).any():
            polygons.append(np.array(loop))
    return quads, polygons


def _largest_part(quads: np.ndarray, polygons: list[np.ndarray], count: int) -> tuple[np.ndarray, list[np.ndarray]]:
    """The faces that hang together over edges with the most others."""
    whole = Topology(count, quads, tuple(polygons))
    piece = whole.piece_of_faces
    kept = piece == np.argmax(np.bincount(piece))
    return quads[kept[:len(quads)]], [polygon for polygon, stays in zip(polygons, kept[len(quads):], strict=True) if stays]

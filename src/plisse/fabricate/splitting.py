"""The development in pieces that cover no place twice and fit the material (paper, Figs 19 and 27).

Cuts run along rulings across the whole sheet, because there the paper hardly bends. Only where even one band from
ruling to ruling is too long for the material the sheet is first cut along creases.
"""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible
from plisse.fabricate.fitting import angle_that_fits, extents
from plisse.fabricate.paper import Paper
from plisse.fabricate.partition import Regions, partition

__all__ = ["Room", "split"]

NARROWEST = 0.1
MOST = 200


@dataclass(frozen=True)
class Room:
    """What one piece may take: `width` × `height` mm, with `flap` mm added along its cuts and `gap` mm between its parts."""

    width: float
    height: float
    flap: float = 0.0
    gap: float = NARROWEST


def split(paper: Paper, room: Room) -> list[np.ndarray]:
    """Pieces as masks over the faces, few and with short cuts between them.

    Raises Infeasible where a single face does not fit, the development has faces folded over, or it is out of all
    proportion to the material.
    """
    whole = np.ones(paper.topology.face_count, bool)
    if not paper.face_areas.min() > 0:
        raise Infeasible(f"face {int(np.argmin(paper.face_areas))} is folded over in the development, so it cannot be cut "
                         "out; make the structure regular first")
    _require_fitting_faces(paper, room)
    least = float(paper.face_areas.sum()) / (room.width * room.height)
    if least > MOST:
        raise Infeasible(f"the development would fill at least {least:.0f} sheets with {room.width:.1f} × "
                         f"{room.height:.1f} mm between their margins (limit {MOST}); take larger material or a "
                         "smaller scale")
    pieces = [piece for part in _components(paper, whole) for piece in _split(paper, room, part)]
    return sorted(pieces, key=lambda piece: int(np.argmax(piece)))


def _split(paper: Paper, room: Room, part: np.ndarray) -> list[np.ndarray]:
    if _is_good(paper, room, part):
        return [part]
    is_crease = paper.topology.edges.is_crease
    columns = _regions(paper, part, is_crease)
    if all(_is_good(paper, room, columns == k) for k in range(columns.max() + 1)):
        return _partition(paper, part, columns, lambda faces: _is_good(paper, room, faces))
    strips = _regions(paper, part, ~is_crease)
    bands = _partition(paper, part, strips, lambda faces: _columns_are_good(paper, room, faces))
    if len(bands) == 1:  # one strip whose faces, not whose columns, are the smallest regions
        return _partition(paper, part, _numbered(part), lambda faces: _is_good(paper, room, faces))
    return [piece for band in bands for piece in _split(paper, room, band)]


def _partition(paper: Paper, part: np.ndarray, label: np.ndarray, good) -> list[np.ndarray]:
    """Parts of a set of faces (mask) that are made of whole regions (F,) of it, as masks over the faces."""
    edges = paper.topology.edges
    inner = np.flatnonzero(~edges.is_boundary)
    ends = np.sort(label[edges.faces[inner]], axis=1)
    between = (ends[:, 0] >= 0) & (ends[:, 0] != ends[:, 1])
    pairs, group = np.unique(ends[between], axis=0, return_inverse=True)
    lengths = np.bincount(group.ravel(), paper.edge_lengths[inner[between]], len(pairs))
    regions = Regions(np.bincount(label[part], paper.face_areas[part]), pairs.reshape(-1, 2), lengths)
    return [part & chosen[label] for chosen in partition(regions, lambda some: good(part & some[label]))]


def _is_good(paper: Paper, room: Room, faces: np.ndarray) -> bool:
    """Whether a set of faces fits the room and lies apart from itself everywhere."""
    return _reach(paper, room, faces) is not None and _lies_apart(paper, room, faces)


def _reach(paper: Paper, room: Room, faces: np.ndarray) -> float | None:
    """The angle at which a set of faces, with flaps along its cuts, fits the room."""
    ends, number = paper.rim(faces)
    points = [paper.points[ends[:, 0]]]
    cut = ~paper.topology.edges.is_boundary[number] | paper.severed[number]
    if room.flap and cut.any():
        a, b = paper.points[ends[cut, 0]], paper.points[ends[cut, 1]]
        along = (b - a) / np.hypot(*(b - a).T)[:, None]
        outwards = room.flap * along[:, ::-1] * [1.0, -1.0]
        points += [a + outwards, b + outwards]
    return angle_that_fits(np.concatenate(points), room.width, room.height)


def _lies_apart(paper: Paper, room: Room, faces: np.ndarray) -> bool:
    """Whether the outline is simple and no two parts of it come closer than the gap."""
    polygon = paper.polygon(faces)
    if not polygon.is_valid:
        return False
    grown = polygon.buffer(room.gap / 2, join_style="mitre")
    return len(grown.interiors) == len(polygon.interiors)


def _columns_are_good(paper: Paper, room: Room, faces: np.ndarray) -> bool:
    label = _regions(paper, faces, paper.topology.edges.is_crease)
    return all(_is_good(paper, room, label == k) for k in range(label.max() + 1))


def _components(paper: Paper, faces: np.ndarray) -> list[np.ndarray]:
    label = _regions(paper, faces, np.ones(len(paper.edge_lengths), bool))
    return [label == k for k in range(label.max() + 1)]


def _regions(paper: Paper, faces: np.ndarray, over: np.ndarray) -> np.ndarray:
    return paper.joined_over(over, faces)


def _numbered(faces: np.ndarray) -> np.ndarray:
    return np.where(faces, np.cumsum(faces) - 1, -1)


def _require_fitting_faces(paper: Paper, room: Room) -> None:
    """Nothing; raises Infeasible with the size of the largest face where one does not fit."""
    for face in np.argsort(-_spans(paper))[:20].tolist():
        alone = np.arange(paper.topology.face_count) == face
        if _reach(paper, room, alone) is None:
            width, height = extents(paper.points[paper.topology.faces[face]], np.array([0.0]))[0]
            room_for = f" and flaps of {room.flap:g} mm" if room.flap else ""
            raise Infeasible(f"face {face} alone is about {width:.1f} × {height:.1f} mm{room_for}, larger than the "
                             f"{room.width:.1f} × {room.height:.1f} mm that the material leaves inside its margins; "
                             "take larger material or a smaller scale")


def _spans(paper: Paper) -> np.ndarray:
    """Largest distance (F,) of a corner from the first corner of its face."""
    corners = paper.topology.corners
    first = corners.vertex[np.concatenate([[0], np.flatnonzero(np.diff(corners.face)) + 1])]
    away = np.hypot(*(paper.points[corners.vertex] - paper.points[first[corners.face]]).T)
    out = np.zeros(paper.topology.face_count)
    np.maximum.at(out, corners.face, away)
    return out

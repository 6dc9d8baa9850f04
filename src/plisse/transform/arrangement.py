"""Arrangements of rectifying strips: along the creases of a structure, or along guiding curves on a surface (Fig. 6)."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from plisse.errors import Infeasible, InvalidStructure
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.polyline import tangents
from plisse.geometry.vectors import norm, unit
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.structure.triangles import triangulated
from plisse.transform.refine_fold import inner_creases
from plisse.transform.strips import RectifyingStrip, rectifying_strip

__all__ = ["Arrangement", "Lane", "arranged", "strips_along_creases", "strips_along_rows", "surface_of"]

GAP = 0.4  # of the strip's width between flat strips on the sheet
SHORTENED = 0.5  # share of its curve below which a strip has lost too much


class Lane(NamedTuple):
    """A curve (n, 3) to lay a strip along, unit normals (n, 3) of the surface below it and directions near its rulings.

    Normals and directions may be None; closed curves do not repeat their first point.
    """

    points: np.ndarray
    normals: np.ndarray | None = None
    reference: np.ndarray | None = None
    closed: bool = False


@dataclass(frozen=True, eq=False)
class Arrangement:
    """Strips, the numbers (from 1) of the curves they belong to, and their inclinations to the surface where there is one.

    `inclinations` are arrays (n − 1,) in radians, 0 lying on the surface; `notes` sentences about what was given up, `lost`
    those about strips that were left out, or shortened to less than half.
    """

    strips: tuple[RectifyingStrip, ...]
    numbers: tuple[int, ...]
    inclinations: tuple[np.ndarray | None, ...]
    notes: tuple[str, ...] = ()
    lost: tuple[str, ...] = ()

    @cached_property
    def structure(self) -> PleatedStructure:
        """All strips as one mesh in space, every one a piece of its own, and laid flat below each other."""
        pieces = [strip.structure for strip in self.strips]
        starts = np.cumsum([0] + [piece.topology.vertex_count for piece in pieces])
        quads = np.concatenate([piece.topology.quads + start for piece, start in zip(pieces, starts, strict=False)])
        flat, top = [], 0.0
        for piece in pieces:
            sheet = _required(piece.development)
            low, high = sheet.min(axis=0), sheet.max(axis=0)
            flat.append(sheet - [low[0], high[1] - top])
            top -= (high - low)[1] * (1 + GAP)
        flat_all = np.concatenate(flat)
        return PleatedStructure(Topology(int(starts[-1]), quads), np.concatenate([piece.vertices for piece in pieces]),
                                development=flat_all - flat_all.min(axis=0))


def arranged(lanes: Iterable[Lane], width: float, side: str = "both") -> Arrangement:
    """Strips along all lanes for which there is one; raises Infeasible, with the first reason, where there is none."""
    notes: list[str] = []
    lost: list[str] = []
    strips, numbers, inclinations = [], [], []
    for number, lane in enumerate(lanes, 1):
        try:
            strip = rectifying_strip(lane.points, width, closed=lane.closed, side=side, reference=lane.reference)
        except Infeasible as error:
            lost.append(f"strip {number} was left out: {error}")
            continue
        strips.append(strip)
        numbers.append(number)
        inclinations.append(None if lane.normals is None else strip.inclination(_between(strip, lane)))
        (notes if strip.kept >= SHORTENED else lost).extend(f"strip {number}: {note}" for note in strip.notes)
    if not strips:
        raise Infeasible(lost[0] if lost else "there is no curve to lay a strip along")
    return Arrangement(tuple(strips), tuple(numbers), tuple(inclinations), tuple(notes), tuple(lost))


def strips_along_creases(structure: PleatedStructure, width: float, *, side: str = "both",
                         creases: Sequence[int] | None = None) -> Arrangement:
    """Rectifying strips along the creases of a structure (numbers in `topology.creases`, from 0; None for all).

    Inclinations are measured against the mid-surface: the plane of a crease's tangent and of the line that joins its
    neighbours on both sides; outermost creases have none on one side, and nothing is said of them.
    """
    topology = structure.topology
    chosen = range(len(topology.creases)) if creases is None else creases
    for number in chosen:
        if not 0 <= number < len(topology.creases):
            raise InvalidStructure(f"there is no crease {number + 1}; the structure has {len(topology.creases)}")
    across, inner = _across(structure), set(inner_creases(topology))
    lanes = []
    for number in chosen:
        crease = topology.creases[number]
        points = structure.vertices[crease.vertices]
        normals = unit(np.cross(tangents(points, crease.closed), across[crease.vertices])) if number in inner else None
        lanes.append(Lane(points, normals, None, crease.closed))
    return arranged(lanes, width, side)


def strips_along_rows(curves: np.ndarray, binormals: np.ndarray, width: float, *, side: str = "both",
                      closed: bool = False) -> Arrangement:
    """Rectifying strips along guiding curves (m, n, 3) with their binormals that sweep out a surface, as in a pattern."""
    across = np.concatenate([curves[1:2] - curves[:1], curves[2:] - curves[:-2], curves[-1:] - curves[-2:-1]])
    normals = [unit(np.cross(tangents(curve, closed), line)) for curve, line in zip(curves, across, strict=True)]
    lanes = [Lane(*fields, closed) for fields in zip(curves, normals, binormals, strict=True)]
    return arranged(lanes, width, side)


def surface_of(structure: PleatedStructure) -> ReferenceMesh:
    """The faces of a structure in triangles, each with corners of its own: what strips along its creases stand on."""
    corners = structure.vertices[triangulated(structure.topology)[0]].reshape(-1, 3)
    return ReferenceMesh(corners, np.arange(len(corners)).reshape(-1, 3))


def _across(structure: PleatedStructure) -> np.ndarray:
    """Per vertex (V, 3) the line from its neighbour on one side of the crease to that on the other.

    Rulings are edges between creases; every face sees its crease on the left of one edge and on the right of the other.
    """
    topology = structure.topology
    quads = topology.quads
    line = np.zeros_like(structure.vertices)
    for own, other, sign in ((0, 3, 1.0), (1, 2, 1.0), (3, 0, -1.0), (2, 1, -1.0)):
        ruling = sign * (structure.vertices[quads[:, other]] - structure.vertices[quads[:, own]])
        np.add.at(line, quads[:, own], ruling)
    return line


def _between(strip: RectifyingStrip, lane: Lane) -> np.ndarray:
    """Surface normals (n − 1, 3) at the middles of a strip's faces."""
    assert lane.normals is not None
    normals = np.concatenate([lane.normals, lane.normals[:1]]) if strip.closed else lane.normals
    if len(normals) != len(strip.points):  # a strip that was cut: take the normals of its own points
        start = int(np.argmin(norm(lane.points - strip.points[0])))
        normals = np.roll(normals, -start, axis=0)[:len(strip.points)]
    return unit(normals[:-1] + normals[1:])


def _required(development: np.ndarray | None) -> np.ndarray:
    assert development is not None
    return development

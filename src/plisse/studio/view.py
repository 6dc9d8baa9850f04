"""What a browser shows of a structure: paper that is smooth across rulings and breaks at creases, and its lines."""

from dataclasses import dataclass

import numpy as np

from plisse.draw.colour_maps import ColourMap
from plisse.draw.corners import corner_triangles
from plisse.measure.folds import assignments
from plisse.structure.front import front_up
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.flex import Motion

__all__ = ["Tint", "View", "flat_view", "folded_view", "posed_view", "tinted"]

SHADES = 128
LETTERS = {"mountain": "M", "valley": "V", "flat": "F", "boundary": "B"}


@dataclass(frozen=True, eq=False)
class View:
    """Triangles (T, 3) over points (N, 3), which are doubled along creases, and lines (S, 2, 3) by name."""

    points: np.ndarray
    triangles: np.ndarray
    lines: dict[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class Tint:
    """Positions (N,) in 0…1 on a scale, nan where unknown, of points (N, 3) of triangles (T, 3), and the map's title.

    `bar` (K, 3) are the colours of the scale from 0 to 1, in 0…255, `ticks` positions with their labels.
    """

    points: np.ndarray
    triangles: np.ndarray
    shares: np.ndarray
    title: str
    ticks: list[tuple[float, str]]
    bar: np.ndarray


def folded_view(structure: PleatedStructure) -> View:
    """The structure in space, as float32."""
    letters = assignments(structure.topology, structure.vertices)
    return _view(structure.topology, structure.vertices, letters)


def posed_view(motion: Motion, percent: float) -> View:
    """A state of the motion in space, with the mountains and valleys of the structure as it was designed."""
    letters = assignments(motion.topology, motion.at(100.0).vertices[0])
    return _view(motion.topology, motion.at(percent).vertices[0], letters)


def flat_view(structure: PleatedStructure) -> View:
    """The development in the plane z = 0, front side up, with the mountains and valleys of the folded state."""
    opened = structure.opened
    flat = front_up(structure)
    letters = assignments(opened.topology, opened.vertices)
    return _view(opened.topology, np.column_stack([flat, np.zeros(len(flat))]), letters)


def tinted(structure: PleatedStructure, colour: ColourMap) -> Tint:
    """The structure coloured by a map, every face on its own."""
    corners, scale, shares = structure.topology.corners, colour.scale, np.linspace(0, 1, SHADES)
    bar = colour.colours(scale.values(shares))
    triangles = corner_triangles(structure.topology).astype(np.uint32)
    return Tint(structure.vertices[corners.vertex].astype(np.float32), triangles,
                scale.shares(colour.values).astype(np.float32), colour.title, scale.ticks(),
                np.round(255 * np.clip(bar, 0, 1)).astype(np.uint8))


def _view(topology: Topology, points: np.ndarray, letters: np.ndarray) -> View:
    corners, edges = topology.corners, topology.edges
    key = topology.strip_of_faces[corners.face] * topology.vertex_count + corners.vertex
    used, place = np.unique(key, return_inverse=True)
    paper = points[used % topology.vertex_count]
    letters = np.where(edges.is_crease | edges.is_boundary, letters, "R")
    lines = {name: points[edges.vertices[letters == letter]].astype(np.float32) for name, letter in LETTERS.items()}
    lines["ruling"] = points[edges.vertices[letters == "R"]].astype(np.float32)
    return View(paper.astype(np.float32), place[corner_triangles(topology)].astype(np.uint32), lines)

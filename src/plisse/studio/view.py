"""What a browser shows of a structure: paper that is smooth across rulings and breaks at creases, and its lines."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from plisse.draw.colour_maps import ColourMap
from plisse.draw.corners import corner_triangles
from plisse.draw.dashes import dashed, longest_stride, whole
from plisse.draw.openness import openness
from plisse.draw.thick import thick_sheet
from plisse.geometry.vectors import norm
from plisse.measure.folds import assignments
from plisse.measure.planarity import face_normals
from plisse.structure.front import front_up
from plisse.structure.incidence import corner_means
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.flex import Motion
from plisse.transform.plates import Plates

__all__ = ["Tint", "View", "flat_view", "folded_view", "plates_view", "posed_view", "tinted"]

SHADES = 128
PERIOD, SAG = 0.022, 1e-3  # of dashes, and by how much lines cut corners, in diagonals of what is shown
ABOVE, OUT = 0.01, 0.15  # in widths of a strip: how far lines lie above the paper, and above the bottom of a groove


@dataclass(frozen=True, eq=False)
class View:
    """Triangles (T, 3) over points (N, 3), which are doubled along creases, and lines (S, 2, 3) by name.

    `sky` (N, 2) in 0…255 is how much of the sky points see on the front and on the back of folded paper.
    """

    points: np.ndarray
    triangles: np.ndarray
    lines: dict[str, np.ndarray]
    sky: np.ndarray | None = None


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
    points = np.column_stack([flat, np.zeros(len(flat))])
    vertex, triangles = _paper(opened.topology)
    return View(points[vertex].astype(np.float32), triangles, _lines(opened.topology, points, letters, is_flat=True))


def plates_view(plates: Plates) -> View:
    """Plates as solids, with lines where edges are sharp and, as rulings, where they meet within a strip."""
    thick = thick_sheet(plates)
    topology, points = thick.structure.topology, thick.structure.vertices
    view = _view(topology, points, assignments(topology, points))
    raised = points + OUT * _strip_width(topology, points) * _mean_normals(topology, points)
    edges = plates.structure.topology.edges
    rulings = thick.sides[:, edges.vertices[~edges.is_crease & ~edges.is_boundary]].reshape(-1, 2)
    return replace(view, lines={"plate": raised[thick.outlines].astype(np.float32),
                                "ruling": points[rulings].astype(np.float32)})


def tinted(structure: PleatedStructure, colour: ColourMap) -> Tint:
    """The structure coloured by a map, every face on its own."""
    corners, scale, shares = structure.topology.corners, colour.scale, np.linspace(0, 1, SHADES)
    bar = colour.colours(scale.values(shares))
    triangles = corner_triangles(structure.topology).astype(np.uint32)
    return Tint(structure.vertices[corners.vertex].astype(np.float32), triangles,
                scale.shares(colour.values).astype(np.float32), colour.title, scale.ticks(),
                np.round(255 * np.clip(bar, 0, 1)).astype(np.uint8))


def _view(topology: Topology, points: np.ndarray, letters: np.ndarray) -> View:
    vertex, triangles = _paper(topology)
    sky = np.round(255 * openness(topology, points)).astype(np.uint8)
    return View(points[vertex].astype(np.float32), triangles, _lines(topology, points, letters), sky[vertex])


@lru_cache(maxsize=8)
def _paper(topology: Topology) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (N,) that stand for the points of a view, those on creases once for either side, and its triangles (T, 3)."""
    corners = topology.corners
    key = topology.strip_of_faces[corners.face] * topology.vertex_count + corners.vertex
    used, place = np.unique(key, return_inverse=True)
    return used % topology.vertex_count, place[corner_triangles(topology)].astype(np.uint32)


def _lines(topology: Topology, points: np.ndarray, letters: np.ndarray, is_flat: bool = False) -> dict[str, np.ndarray]:
    """Lines by the kind of their edge, valleys in dashes; creases lie on both sides of the paper, of a flat one in front."""
    edges, is_crease, diagonal = topology.edges, topology.edges.is_crease, float(norm(np.ptp(points, axis=0)))
    stride = longest_stride(topology, points, SAG * diagonal)  # browsers without a graphics card draw lines slowly
    sides = ((ABOVE, ABOVE),) if is_flat else ((ABOVE, OUT), (-OUT, -ABOVE))  # of mountains, of valleys
    out = _strip_width(topology, points) * (np.array([0.0, 0.0, 1.0]) if is_flat else _mean_normals(topology, points))
    lines = {"boundary": np.concatenate([whole(topology, letters == "B", points, stride),
                                         points[edges.vertices[edges.is_boundary & ~is_crease]]]),
             "ruling": points[edges.vertices[~is_crease & ~edges.is_boundary]]}
    for name, letter in (("mountain", "M"), ("flat", "F")):
        lines[name] = np.concatenate([whole(topology, is_crease & (letters == letter), points + above * out, stride)
                                      for above, _ in sides])
    lifted = np.concatenate([points, *(points + above * out for _, above in sides)], axis=1)
    dashes = dashed(topology, is_crease & (letters == "V"), lifted, PERIOD * diagonal, stride)
    lines["valley"] = np.concatenate(np.split(dashes, 1 + len(sides), axis=2)[1:])
    return {name: found.astype(np.float32) for name, found in lines.items()}


def _strip_width(topology: Topology, points: np.ndarray) -> float:
    across = topology.edges.vertices[~topology.edges.is_crease]
    return float(np.median(norm(points[across[:, 1]] - points[across[:, 0]])))


def _mean_normals(topology: Topology, points: np.ndarray) -> np.ndarray:
    """Mean normals (V, 3) of the faces around vertices: short where the fold is sharp, so that lines stay in its groove."""
    return corner_means(topology, face_normals(topology, points)[topology.corners.face])

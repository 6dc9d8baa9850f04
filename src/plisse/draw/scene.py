"""A structure as the viewer of a report page wants it: arrays in base64, little endian."""

import json
from base64 import b64encode
from collections.abc import Iterable

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import Camera
from plisse.draw.colour_maps import ColourMap
from plisse.draw.corners import corner_normals, corner_triangles
from plisse.draw.openness import openness
from plisse.geometry.vectors import norm, unit
from plisse.measure.folds import assignments
from plisse.structure.pleated import PleatedStructure

__all__ = ["scene_json"]

# kind, letter of its edges, colour, opacity, half width in pixels
LINES = (("ruling", "R", colours.RULING, 0.6, 0.5), ("boundary", "B", colours.EDGE, 0.9, 0.7),
         ("flat", "F", colours.CAPTION, 0.9, 0.7), ("valley", "V", colours.VALLEY, 0.95, 0.9),
         ("mountain", "M", colours.MOUNTAIN, 0.95, 0.9))


def scene_json(structure: PleatedStructure, camera: Camera, maps: Iterable[ColourMap]) -> str:
    """The scene as JSON that may stand in a script element; the structure is moved and scaled into the unit sphere."""
    topology, vertices = structure.topology, structure.vertices
    centre = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    normals = corner_normals(topology, vertices)
    basis, elevation = _basis(camera)
    scene = {
        "vertices": _packed((vertices - centre) / norm(vertices - centre).max(), "<f4"),
        "corners": _packed(topology.corners.vertex, "<u4"),
        "triangles": _packed(corner_triangles(topology), "<u4"),
        "normals": _packed(np.pad(np.round(32767 * normals), ((0, 0), (0, 1))), "<i2"),
        "open": _packed(np.round(255 * openness(topology, vertices)[topology.corners.vertex]), "u1"),
        "maps": [{"name": found.name, "colours": _packed(_bytes(found.colours(found.values)), "u1")} for found in maps],
        "lines": _lines(structure),
        "basis": basis.tolist(),
        "elevation": elevation,
    }
    return json.dumps(scene, separators=(",", ":")).replace("</", "<\\/")


def _lines(structure: PleatedStructure) -> list[dict]:
    edges = structure.topology.edges
    letters = assignments(structure.topology, structure.vertices)
    letters = np.where(edges.is_crease | edges.is_boundary, letters, "R")
    return [{"kind": kind, "edges": _packed(edges.vertices[letters == letter], "<u4"), "width": width,
             "ink": [*np.round(colours.rgb(colour), 3).tolist(), opacity]} for kind, letter, colour, opacity, width in LINES]


def _basis(camera: Camera) -> tuple[np.ndarray, float]:
    """Rows towards the viewer on the ground, to the right, upright (3, 3), and the camera's elevation in radians."""
    towards = camera.axes[2]
    upright = camera.axes[1] if camera.upright is None else camera.upright
    right = camera.axes[0]
    return np.stack([unit(np.cross(right, upright)), right, upright]), float(np.arcsin(np.clip(towards @ upright, -1, 1)))


def _bytes(colour: np.ndarray) -> np.ndarray:
    return np.pad(np.round(255 * colour), ((0, 0), (0, 1)), constant_values=255)


def _packed(values: np.ndarray, kind: str) -> str:
    return b64encode(np.ascontiguousarray(values).astype(kind).tobytes()).decode()

"""A structure as binary glTF 2.0 for Blender, browsers and phones: coloured by quality, creases as lines."""

from pathlib import Path

import numpy as np

from plisse.draw.colours import quality
from plisse.draw.corners import corner_triangles
from plisse.io.atomic import written
from plisse.io.gltf import LINES, TRIANGLES, Buffer, linear, one_mesh, primitive, upright
from plisse.measure.folds import assignments
from plisse.measure.planarity import face_normals, planarity_defect
from plisse.measure.sectors import angle_defect
from plisse.measure.verdict import EXACT
from plisse.structure.pleated import PleatedStructure

__all__ = ["write_glb"]

WORST = 1e-2


def write_glb(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure in metres, y upwards.

    Paper is pale where faces are planar and angles sum to 2π within 1e-9, and darker, on a logarithmic scale up to
    1e-2, where they are not. Raises PlisseError where the file cannot be written.
    """
    topology, points = structure.topology, upright(structure.vertices, units)
    corners, buffer = topology.corners, Buffer()
    attributes = {"POSITION": buffer.vectors(points[corners.vertex], bounds=True),
                  "NORMAL": buffer.vectors(face_normals(topology, points)[corners.face]),
                  "COLOR_0": buffer.vectors(linear(quality(_badness(structure))))}
    primitives = [primitive(TRIANGLES, attributes, buffer.indices(corner_triangles(topology)), 0)]
    letters, edges = assignments(topology, structure.vertices), topology.edges
    for material, letter in enumerate("MV", start=1):
        chosen = edges.vertices[(letters == letter) & edges.is_crease]
        if len(chosen):
            used, index = np.unique(chosen, return_inverse=True)
            position = {"POSITION": buffer.vectors(points[used], bounds=True)}
            primitives.append(primitive(LINES, position, buffer.indices(index), material))
    data = buffer.packed(one_mesh({"name": title or "structure", "primitives": primitives}, paper="#ffffff"))
    with written(path) as aside:
        aside.write_bytes(data)


def _badness(structure: PleatedStructure) -> np.ndarray:
    """0 for exact to 1 for bad at every corner (C,), by the larger defect of its face and its vertex."""
    topology, corners = structure.topology, structure.topology.corners
    angles = np.where(topology.is_inner, np.abs(angle_defect(topology, structure.vertices)), 0.0)
    worst = np.maximum(planarity_defect(topology, structure.vertices)[corners.face], angles[corners.vertex])
    return np.clip(np.log10(np.maximum(worst, EXACT) / EXACT) / np.log10(WORST / EXACT), 0, 1)

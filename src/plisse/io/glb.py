"""Motions as binary glTF 2.0: morph targets and an animation that goes to and fro, for any viewer.

Paper is one mesh of triangles with a normal per face; mountains and valleys are lines over it. glTF wants metres and
y upwards. Positions are relative to the state that stands still when nothing plays, the one nearest to the designed.
"""

from pathlib import Path

import numpy as np

from plisse.draw.corners import corner_triangles
from plisse.io.atomic import written
from plisse.io.gltf import LINES, TRIANGLES, Buffer, one_mesh, primitive, upright
from plisse.measure.folds import assignments
from plisse.measure.planarity import face_normals
from plisse.structure.topology import Topology
from plisse.transform.flex import Motion

__all__ = ["motion_glb", "write_motion_glb"]

SECONDS_ONE_WAY = 4.0


def write_motion_glb(motion: Motion, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write a motion as .glb; raises PlisseError where the file cannot be written."""
    data = motion_glb(motion, title=title, units=units)
    with written(path) as aside:
        aside.write_bytes(data)


def motion_glb(motion: Motion, *, title: str = "", units: str = "mm") -> bytes:
    """The bytes of a .glb with one morph target per state but the resting one, and one animation."""
    states = upright(motion.vertices, units)
    rest = int(np.argmin(np.abs(motion.percent - 100)))
    others = np.delete(np.arange(len(states)), rest)
    buffer = Buffer()
    primitives = [_paper(buffer, motion.topology, states, rest, others)]
    letters = assignments(motion.topology, motion.mechanism.designed)
    for material, letter in enumerate("MV", start=1):
        edges = motion.topology.edges.vertices[letters == letter]
        edges = edges[motion.topology.edges.is_crease[letters == letter]]
        if len(edges):
            primitives.append(_lines(buffer, edges, states, rest, others, material))
    names = [f"{percent:.6g} %" for percent in motion.percent[others]]
    mesh: dict = {"name": title or "motion", "primitives": primitives}
    if len(others):
        mesh |= {"weights": [0.0] * len(others), "extras": {"targetNames": names}}
    document = one_mesh(mesh)
    if len(others):
        document["animations"] = [_animation(buffer, len(states), others)]
    return buffer.packed(document)


def _paper(buffer: Buffer, topology: Topology, states: np.ndarray, rest: int, others: np.ndarray) -> dict:
    """Triangles with every corner of every face a vertex of its own, so that faces stay flat when shaded."""
    corners = topology.corners
    normals = np.stack([face_normals(topology, vertices)[corners.face] for vertices in states])
    points = states[:, corners.vertex]
    targets = [{"POSITION": buffer.vectors(points[k] - points[rest], bounds=True),
                "NORMAL": buffer.vectors(normals[k] - normals[rest])} for k in others]
    return primitive(TRIANGLES, {"POSITION": buffer.vectors(points[rest], bounds=True),
                                  "NORMAL": buffer.vectors(normals[rest])},
                      buffer.indices(corner_triangles(topology)), 0, targets)


def _lines(buffer: Buffer, edges: np.ndarray, states: np.ndarray, rest: int, others: np.ndarray, material: int) -> dict:
    used, index = np.unique(edges, return_inverse=True)
    points = states[:, used]
    # every primitive of a mesh needs the same targets; lines have no normals that would matter
    targets = [{"POSITION": buffer.vectors(points[k] - points[rest], bounds=True)} for k in others]
    return primitive(LINES, {"POSITION": buffer.vectors(points[rest], bounds=True)},
                      buffer.indices(index.reshape(-1, 2)), material, targets)


def _animation(buffer: Buffer, count: int, others: np.ndarray) -> dict:
    """One key per state, there and back: its own target has weight 1 and all others 0."""
    order = np.concatenate([np.arange(count), np.arange(count - 2, -1, -1)])
    times = np.linspace(0, 2 * SECONDS_ONE_WAY, len(order))
    weights = (order[:, None] == others).astype(np.float32)
    sampler = {"input": buffer.scalars(times, bounds=True), "output": buffer.scalars(weights.ravel()),
               "interpolation": "LINEAR"}
    return {"name": "flex", "samplers": [sampler], "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}

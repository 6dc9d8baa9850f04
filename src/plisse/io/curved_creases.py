"""Creases as splines in FOLD, after the plan for curved creases of the FOLD project (edemaine/fold, issue 15).

There an edge may be a curve: `edges_controlPoints` holds its control points, null for straight edges, and
`edges_degree` its degree; the knot vector of a single Bézier piece is the default and left out. As the plan is no
part of FOLD 1.2 yet, both properties carry our namespace. The end points of an edge are among its control points.
"""

import numpy as np

from plisse.geometry.bezier import bezier_through
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["curved_document"]

POINTS, DEGREE = "edges_plisse:controlPoints", "edges_plisse:degree"


def curved_document(document: dict, structure: PleatedStructure) -> dict:
    """The FOLD document of a structure with cubic control points on crease edges, flat and folded.

    The splines interpolate the vertices of each crease; a crease that closes is smooth there too.
    """
    opened, source = structure.cut.topology, structure.cut.source
    on_crease = opened.edges.is_crease
    flat = _pieces(opened, np.array(document["vertices_coords"]), opened.edges.vertices[on_crease])
    folded = _pieces(structure.topology, structure.vertices, source[opened.edges.vertices[on_crease]])
    frame, *others = document["file_frames"]
    frame = {**frame, POINTS: _spread(folded, on_crease)}
    degree = {DEGREE: np.where(on_crease, 3, 1).tolist()}
    return {**document, POINTS: _spread(flat, on_crease), **degree, "file_frames": [frame, *others]}


def _pieces(topology: Topology, points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Control points (E, 4, d) of the given crease edges (E, 2), from their first end to their second."""
    ends, pieces = [], []
    for crease in topology.creases:
        path = crease.path
        controls = bezier_through(points[crease.vertices], crease.closed)
        ends.append(np.stack([path[:-1], path[1:]], axis=1))
        pieces.append(np.stack([controls[k:k + len(controls) - 1:3][:len(path) - 1] for k in range(3)]
                               + [controls[3::3]], axis=1))
    known, controls = np.concatenate(ends), np.concatenate(pieces)
    known, controls = np.concatenate([known, known[:, ::-1]]), np.concatenate([controls, controls[:, ::-1]])
    key, wanted = known @ [topology.vertex_count, 1], edges @ [topology.vertex_count, 1]
    order = np.argsort(key)
    return controls[order[np.searchsorted(key[order], wanted)]]


def _spread(pieces: np.ndarray, chosen: np.ndarray) -> list:
    """One entry per edge: control points where `chosen`, None elsewhere."""
    entries: list = [None] * len(chosen)
    for edge, controls in zip(np.flatnonzero(chosen).tolist(), pieces.tolist(), strict=True):
        entries[edge] = controls
    return entries

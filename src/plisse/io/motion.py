"""Motions as FOLD animations and as one OBJ per state."""

from pathlib import Path

import numpy as np

from plisse.io.atomic import written
from plisse.io.fold import PERCENT, fold_bytes, fold_document
from plisse.io.obj import write_obj
from plisse.measure.folds import fold_angles
from plisse.structure.pleated import PleatedStructure
from plisse.transform.flex import Motion

__all__ = ["frame_names", "motion_document", "write_motion_fold", "write_motion_objs"]


def write_motion_fold(motion: Motion, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the flat crease pattern as key frame and one folded form per state; raises PlisseError if it cannot."""
    document = motion_document(motion, title=title, units=units)
    with written(path) as aside:
        aside.write_bytes(fold_bytes(document))


def motion_document(motion: Motion, *, title: str = "", units: str = "mm") -> dict:
    """The FOLD document of a motion: every folded frame has its percent as title, its own vertices and fold angles."""
    designed = PleatedStructure(motion.topology, motion.mechanism.designed, development=motion.development)
    document = fold_document(designed, title=title, units=units)
    frame = document["file_frames"][0]
    edges = motion.topology.edges
    frames = []
    for percent, vertices in zip(motion.percent.tolist(), motion.vertices, strict=True):
        degrees = np.where(edges.is_boundary, 0.0, np.degrees(fold_angles(motion.topology, vertices)))
        frames.append({**frame, "frame_title": f"{percent:.6g}", PERCENT: percent, "vertices_coords": vertices.tolist(),
                       "edges_foldAngle": np.where(edges.is_crease, degrees, 0.0).tolist(),
                       "edges_plisse:rulingAngle": np.where(edges.is_crease, 0.0, degrees).tolist()})
    return {**document, "file_classes": ["animation"], "file_frames": frames}


def write_motion_objs(motion: Motion, directory: Path, *, title: str = "", units: str = "mm") -> None:
    """Write one OBJ per state into a directory that exists, named by `frame_names`."""
    for state, name, percent in zip(motion.structures, frame_names(motion), motion.percent, strict=True):
        write_obj(state, directory / name, title=f"{title} {percent:.6g} %".strip(), units=units)


def frame_names(motion: Motion) -> list[str]:
    """File names of the states, in their order: 000.obj, 001.obj, …"""
    digits = max(3, len(str(len(motion.percent) - 1)))
    return [f"{k:0{digits}d}.obj" for k in range(len(motion.percent))]

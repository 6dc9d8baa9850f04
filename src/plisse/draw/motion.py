"""The motion of a structure as a picture: five states in a row (Figs 5 and 10)."""

from pathlib import Path

import numpy as np

from plisse.draw.camera import Camera, best_view
from plisse.draw.cones import into_cone, with_cone
from plisse.draw.row import write_row
from plisse.draw.runs import Run, lettered_runs
from plisse.structure.pleated import PleatedStructure
from plisse.transform.flex import Motion

__all__ = ["designed_runs", "motion_camera", "write_motion_strip"]

SHOWN = 5


def write_motion_strip(motion: Motion, path: str | Path, *, title: str = "") -> None:
    """Write a PNG of up to five states, evenly chosen from those of the motion, at one scale and from one side.

    A structure with one inner vertex is shown with the cone that touches its four faces (Fig. 10).
    """
    count = len(motion.percent)
    shown = np.unique(np.linspace(0, count - 1, min(SHOWN, count)).round().astype(int))
    states = [PleatedStructure(motion.topology, motion.vertices[k]) for k in shown]
    camera, inner = motion_camera(motion), np.flatnonzero(~motion.topology.is_boundary)
    if len(inner) == 1:
        camera = into_cone(_designed(motion), int(inner[0]))
        states = [with_cone(state, int(inner[0])) for state in states]
    write_row(states, [f"{motion.percent[k]:.4g} %" for k in shown], path, camera=camera, title=title,
              facts=_facts(motion), runs=designed_runs(motion))


def motion_camera(motion: Motion) -> Camera:
    """The view that shows the designed state best."""
    return best_view(_designed(motion))


def designed_runs(motion: Motion) -> list[Run]:
    """Mountains and valleys of the designed state, which are those of all states between flat and flat-folded."""
    return lettered_runs(_designed(motion))


def _designed(motion: Motion) -> PleatedStructure:
    return PleatedStructure(motion.topology, motion.mechanism.designed)


def _facts(motion: Motion) -> list[str]:
    free = motion.free_range
    facts = [f"{motion.topology.vertex_count:,} vertices", f"free from {free.low:.4g} to {free.high:.4g} %"]
    return facts + ([f"cut open {motion.cut_place}"] if motion.cut_place else [])

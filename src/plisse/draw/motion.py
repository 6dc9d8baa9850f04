"""The motion of a structure as a picture: five states in a row (Figs 5 and 10)."""

from pathlib import Path

import numpy as np

from plisse.draw.camera import Camera, best_view
from plisse.draw.cones import into_cone, with_cone
from plisse.draw.row import write_row
from plisse.draw.runs import Run, lettered_runs
from plisse.measure.intersection import intersecting_faces
from plisse.structure.pleated import PleatedStructure
from plisse.transform.collisions import DESIGNED
from plisse.transform.flex import Motion

__all__ = ["designed_runs", "motion_camera", "shown_percents", "write_motion_strip"]

SHOWN = 5


def write_motion_strip(motion: Motion, path: str | Path, *, title: str = "") -> None:
    """Write a PNG of some states of the motion, see `shown_percents`, at one scale and from one side.

    States beyond the free range are lighter, and say whether they cut through themselves. A structure with one inner
    vertex is shown with the cone that touches its four faces (Fig. 10).
    """
    motion = motion.at(shown_percents(motion.percent))
    states = list(motion.structures)
    beyond = [percent not in motion.free_range for percent in motion.percent.tolist()]
    captions = [f"{percent:.4g} %" + _remark(state) * outside
                for percent, state, outside in zip(motion.percent.tolist(), states, beyond, strict=True)]
    camera, inner = motion_camera(motion), np.flatnonzero(~motion.topology.is_boundary)
    if len(inner) == 1:
        camera = into_cone(_designed(motion), int(inner[0]))
        states = [with_cone(state, int(inner[0])) for state in states]
    write_row(states, captions, path, camera=camera, title=title, facts=_facts(motion), runs=designed_runs(motion),
              faded=beyond)


def shown_percents(percent: np.ndarray) -> np.ndarray:
    """The percents (N,) that a picture shows: those given, or five evenly spaced ones where there are more.

    The designed state, 100 percent, is always among them where they lie on both sides of it.
    """
    low, high = float(percent.min()), float(percent.max())
    shown = np.unique(percent)
    if len(shown) > SHOWN:
        shown = np.linspace(low, high, SHOWN)
        if low < DESIGNED < high:
            inner = 1 + np.argmin(np.abs(shown[1:-1] - DESIGNED))
            shown[inner] = DESIGNED
    elif low < DESIGNED < high:
        shown = np.union1d(shown, DESIGNED)
    return shown


def motion_camera(motion: Motion) -> Camera:
    """The view that shows the designed state best, and the first and last as well, even if they are flat."""
    ends = motion.vertices[[np.argmin(motion.percent), np.argmax(motion.percent)]]
    return best_view(_designed(motion), [PleatedStructure(motion.topology, vertices) for vertices in ends])


def designed_runs(motion: Motion) -> list[Run]:
    """Mountains and valleys of the designed state, which are those of all states between flat and flat-folded."""
    return lettered_runs(_designed(motion))


def _designed(motion: Motion) -> PleatedStructure:
    return PleatedStructure(motion.topology, motion.mechanism.designed)


def _remark(state: PleatedStructure) -> str:
    """What a state beyond the free range is, as the end of its caption."""
    return "\ncuts through itself" if len(intersecting_faces(state.topology, state.vertices)) else "\nout of reach"


def _facts(motion: Motion) -> list[str]:
    free = motion.free_range
    facts = [f"{motion.topology.vertex_count:,} vertices", f"free from {free.low:.4g} to {free.high:.4g} %"]
    return facts + ([f"cut open {motion.cut_place}"] if motion.cut_place else [])

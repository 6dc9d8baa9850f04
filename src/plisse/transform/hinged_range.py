"""How far plates on a film let the structure move, and how thick they may be for all of its motion (§2.5, Fig. 26)."""

from dataclasses import dataclass

import numpy as np

from plisse.errors import InvalidDesign
from plisse.measure.convex_overlap import ConvexSolids
from plisse.transform.collisions import DESIGNED, FreeRange, first_of, narrowed
from plisse.transform.flex import Motion, flex
from plisse.transform.mechanism import FLAT_FOLDED, turning
from plisse.transform.outlines import Outlines
from plisse.transform.plate_limits import PlateCut
from plisse.transform.plates import TOUCHING, Plates

__all__ = ["HingedRange", "hinged_range", "placed"]

STEP = 5.0
TOLERANCE = 0.1


@dataclass(frozen=True)
class HingedRange:
    """Percents between which hinged plates move freely: 0 flat, 100 as designed, 200 folded flat.

    `faces` is the free range of the bare faces, `thickness_for_faces` the largest thickness in model units with which
    the hinges allow all of it; `reasons` say in a sentence each what sets the ends of the plates' own range.
    """

    low: float
    high: float
    faces: FreeRange
    thickness_for_faces: float
    reasons: tuple[str, ...] = ()


def hinged_range(plates: Plates) -> HingedRange:
    """The range in which hinged plates do not intersect: at hinges by formula, elsewhere looked at every 5 percent.

    A hinge of fold φ with plates of thickness T and gap g closes where tan(φ/2) = g / (2T), and tan(φ/2) grows by one
    factor on all edges. Raises InvalidDesign for plates that are not hinged.
    """
    if not plates.cut.hinged:
        raise InvalidDesign("mitred plates do not move; make hinged ones")
    motion = flex(plates.structure, DESIGNED)
    opened = plates.cut.on(Outlines(motion.topology, motion.mechanism.designed))
    faces = motion.free_range
    steepest = float(opened.steepness.max())
    closing = opened.gap / (2 * opened.thickness * steepest) if steepest > 0 else np.inf
    at_hinges = float(2 * FLAT_FOLDED / np.pi * np.arctan(closing))
    reach = faces.low, min(at_hinges, faces.high)
    ends, reasons = [], []
    for end, known in zip(reach, _known(faces, at_hinges), strict=True):
        free, struck = _first_collision(plates, motion, end)
        ends.append(free)
        if struck is not None:
            known = f"beyond {free:.1f} % plates {struck[0] + 1} and {struck[1] + 1} run into each other"
        reasons += [known] if known else []
    return HingedRange(ends[0], ends[1], faces, _thickness_for(opened, faces.high, steepest), tuple(reasons))


def _known(faces: FreeRange, at_hinges: float) -> tuple[str, str]:
    """What ends the range on either side before plates are looked at; empty where it is the flat or flat-folded state."""
    below = faces.collisions[0] if faces.collisions and faces.low > 0 else ""
    above = faces.collisions[-1] if faces.collisions and faces.high < FLAT_FOLDED else ""
    return below, f"plates meet at their hinges at {at_hinges:.1f} %" if at_hinges < faces.high else above


def placed(plates: Plates, motion: Motion) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper outlines (K, C, 3) of hinged plates in all states of a motion of their structure."""
    both = [plates.cut.on(Outlines(motion.topology, vertices)).solids() for vertices in motion.vertices]
    return np.array([lower for lower, _ in both]), np.array([upper for _, upper in both])


def _thickness_for(opened: PlateCut, percent: float, steepest: float) -> float:
    """The largest thickness with which all hinges reach a percent; none folds flat."""
    if percent >= FLAT_FOLDED:
        return 0.0
    cosine, sine = turning(np.array(percent))
    return float(0.5 * opened.gap * cosine / (sine * steepest)) if sine * steepest > 0 else np.inf


def _first_collision(plates: Plates, motion: Motion, end: float) -> tuple[float, tuple[int, int] | None]:
    """The last free percent on the way from the designed state to `end`, and the plates that meet beyond it."""
    stops = np.linspace(DESIGNED, end, int(np.ceil(abs(end - DESIGNED) / STEP)) + 1)[1:]
    free = DESIGNED
    for percent in stops.tolist():
        struck = _struck(plates, motion, percent)
        if struck:
            return narrowed(lambda middle: _struck(plates, motion, middle), free, percent, struck, TOLERANCE)
        free = percent
    return end, None


def _struck(plates: Plates, motion: Motion, percent: float) -> tuple[int, int] | None:
    """Two plates that run into each other at a percent, if there are any."""
    lower, upper = (outline[0][plates.corners] for outline in placed(plates, motion.at(percent)))
    solids = ConvexSolids(lower, upper)
    return first_of(solids.overlapping(solids.near(), TOUCHING * plates.structure.diagonal))

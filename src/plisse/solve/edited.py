"""Editing (Fig. 23): a solved structure is carried along by the motion of its surface and solved again from there.

Creases follow the surface and lose their constant inclination. Nothing here knows how the structure was made.
"""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.vectors import norm
from plisse.leastsquares import NotPositiveDefinite
from plisse.measure.folds import fold_angles
from plisse.measure.intersection import intersecting_faces
from plisse.measure.regularity import OPENING_RANGE, regularity
from plisse.solve.anneal import SLOWLY, anneal
from plisse.solve.constraints import Constraints
from plisse.solve.energies.mid_surface import mid_surface_closeness
from plisse.solve.polish import polish
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["Edited", "edited_structure"]

EXACT = 1e-10
GENTLE, FIRM = SLOWLY[3:], SLOWLY[1:]  # from small weights, and from larger ones where these do not do
FAIRNESS = {"closeness": 0.01, "across": 0.1}
HOLD = 0.1
SMALLEST_STEP = 1 / 32
POLISH_STEPS = 10


@dataclass(frozen=True, eq=False)
class Edited:
    """The structure over the edited surface, not yet developed, and the steps (N,) of the motion that led there.

    `drift` (V,) are distances in model units from where the motion alone would have put the vertices.
    """

    structure: PleatedStructure
    steps: tuple[float, ...]
    drift: np.ndarray


def edited_structure(structure: PleatedStructure, rest_moved: np.ndarray, *, normals: np.ndarray | None = None,
                     hold: float = HOLD, least_opening: float = OPENING_RANGE[0]) -> Edited:
    """The exact structure nearest in shape to a solved one carried along to vertices `rest_moved` (V, 3).

    With the `normals` (V, 3) of the edited surface its mid-surface is held along them by `hold`, where that can be. The
    whole motion is tried at once, smaller steps where that leads to nothing exact and regular with creases open by
    `least_opening` radians and folded as they were. Raises Infeasible, with how far the edit could be followed.
    """
    task = _Task(structure, np.asarray(rest_moved, float), normals, hold, least_opening)
    done, size = 0.0, 1.0
    at = task.before
    steps: list[float] = []
    while done < 1:
        target = min(done + size, 1.0)
        found = task.solved(at + (target - done) * task.motion, target)
        if found is None:
            size /= 2
            if size < SMALLEST_STEP:
                raise Infeasible(f"the pleats follow this edit for {100 * done:.0f} % of the way only; edit the surface "
                                 "more gently or lay out the edited surface anew")
            continue
        at, steps, done = found, [*steps, target - done], target
        size *= 2
    vertices = at.T * task.unit
    return Edited(structure.with_vertices(vertices), tuple(steps), norm(vertices - rest_moved))


class _Task:
    """The motion in units of the mean edge length, vertices (3, V)."""

    def __init__(self, structure: PleatedStructure, rest_moved: np.ndarray, normals: np.ndarray | None, hold: float,
                 least_opening: float):
        if rest_moved.shape != structure.vertices.shape:
            raise ValueError(f"the moved vertices have shape {rest_moved.shape}, expected {structure.vertices.shape}")
        self.topology: Topology = structure.topology
        self.unit = structure.mean_edge
        self.before = np.ascontiguousarray(structure.vertices.T / self.unit)
        self.motion = np.ascontiguousarray(rest_moved.T / self.unit) - self.before
        self.normals = None if normals is None else np.ascontiguousarray(normals.T)
        self.hold = hold
        self.least_opening = least_opening
        self.constraints = Constraints(self.topology)
        self.folds = np.sign(self._crease_folds(self.before))

    def solved(self, start: np.ndarray, fraction: float) -> np.ndarray | None:
        """Vertices for a part of the motion, or None where nothing sound was found."""
        rest = self.before + fraction * self.motion
        held = [] if self.normals is None or self.hold == 0 else [
            mid_surface_closeness(self.topology, rest, self.normals, self.hold)]
        for weights, extra in ((GENTLE, held), (FIRM, held), (FIRM, [])):
            try:
                at = anneal(self.topology, start, rest=rest, weights=weights, fairness=FAIRNESS, extra=extra)
                found = polish(self.constraints, at, steps=POLISH_STEPS)
            except NotPositiveDefinite:
                continue
            if found.defect < EXACT and self._is_sound(found.vertices):
                return found.vertices
        return None

    def _is_sound(self, vertices: np.ndarray) -> bool:
        shape = regularity(self.topology, vertices.T)
        return bool(shape.is_regular and shape.min_opening >= self.least_opening
                    and (np.sign(self._crease_folds(vertices)) == self.folds).all()
                    and not len(intersecting_faces(self.topology, vertices.T)))

    def _crease_folds(self, vertices: np.ndarray) -> np.ndarray:
        edges = self.topology.edges
        return fold_angles(self.topology, vertices.T)[edges.is_crease & ~edges.is_boundary]

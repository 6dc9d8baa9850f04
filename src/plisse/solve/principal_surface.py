"""A solved structure over a surface made principal: the same conditions and flat-foldability, from there (§2.4)."""

from itertools import product

import numpy as np

from plisse.leastsquares import NotPositiveDefinite
from plisse.measure.intersection import intersecting_faces
from plisse.measure.regularity import OPENING_RANGE, regularity
from plisse.solve.anneal import SLOWLY, anneal
from plisse.solve.constraints import Constraints
from plisse.solve.polish import polish
from plisse.structure.pleated import PleatedStructure

__all__ = ["nearest_principal"]

EXACT = 1e-10
WAYS = ({"closeness": 0.01, "across": 0.1}, {"closeness": 0.01, "same_side": 0.3, "across": 0.3})
STEPS = 2
POLISH_STEPS = 12


def nearest_principal(structure: PleatedStructure, least_opening: float = OPENING_RANGE[0]) -> PleatedStructure | None:
    """A principal structure near an exact one, without development, or None where none was found.

    Fold angles become constant along every crease; the structure drifts as far as that needs.
    """
    topology, unit = structure.topology, structure.mean_edge
    rest = np.ascontiguousarray(structure.vertices.T / unit)
    constraints = Constraints(topology, principal=True)
    for weights, fairness in product((SLOWLY, SLOWLY[2:]), WAYS):
        try:
            at = anneal(topology, rest, principal=True, weights=weights, steps=STEPS, fairness=fairness)
            done = polish(constraints, at, steps=POLISH_STEPS)
        except NotPositiveDefinite:
            continue
        vertices = done.vertices.T * unit
        if done.defect > EXACT:
            continue
        shape = regularity(topology, vertices)
        if shape.is_regular and shape.min_opening >= least_opening and not len(intersecting_faces(topology, vertices)):
            return structure.with_vertices(vertices)
    return None

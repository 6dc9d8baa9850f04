"""What transforms need: a folded structure, and for motion and offsets one that is exactly principal (§2.4)."""

import numpy as np

from plisse.errors import InvalidStructure
from plisse.measure.folds import fold_angles
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect, principal_defect
from plisse.measure.verdict import EXACT
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure

__all__ = ["require_folded", "require_principal"]

FLATTEST = np.radians(0.1)
THINNEST = 1e-6  # of its size that a structure reaches out of its plane


def require_folded(structure: PleatedStructure, consequence: str) -> None:
    """Nothing; raises InvalidStructure with `consequence` where no crease is folded, or all faces lie in one plane."""
    topology, vertices = structure.topology, structure.vertices
    inner = ~topology.edges.is_boundary
    if not inner.any():
        raise InvalidStructure(f"no crease lies between two faces, so {consequence}; give a structure with at least "
                               "two strips")
    if np.abs(fold_angles(topology, vertices)[inner]).max() < FLATTEST:
        raise InvalidStructure(f"the structure lies flat, no crease is folded, so {consequence}; give a folded state")
    height = np.linalg.svd(vertices - vertices.mean(axis=0), compute_uv=False)[2] / np.sqrt(len(vertices))
    if height < THINNEST * structure.diagonal:
        raise InvalidStructure(f"the structure is folded flat, all faces lie in one plane, so {consequence}; give a state "
                               "between")


def require_principal(structure: PleatedStructure, consequence: str) -> None:
    """Nothing; raises InvalidStructure with place, defect and `consequence` where a structure is not exactly principal.

    Structures that are not folded are refused first, see `require_folded`.
    """
    require_folded(structure, consequence)
    topology, vertices = structure.topology, structure.vertices
    valence = np.bincount(topology.corners.vertex, minlength=topology.vertex_count)
    odd = ~topology.is_boundary & (valence != 4)
    if odd.any():
        vertex = int(np.argmax(odd))
        raise InvalidStructure(f"the structure is not principal: {valence[vertex]} faces meet in vertex {vertex}, not four, "
                               f"so {consequence}")
    planarity = planarity_defect(topology, vertices)
    face = int(np.argmax(planarity))
    if not planarity[face] <= EXACT:
        raise InvalidStructure(f"the structure is not exact: face {face} misses its plane by {planarity[face]:.1e} "
                               f"(limit {EXACT:.0e}), so {consequence}; solve it first")
    for what, defect, remedy in (("exact: angles miss 2π", np.abs(angle_defect(topology, vertices)), "solve it first"),
                                 ("principal: opposite angles miss π", principal_defect(topology, vertices),
                                  "along a curve or a surface guide, designs with solve.principal = true are")):
        vertex = int(np.argmax(defect))
        if not defect[vertex] <= EXACT:
            raise InvalidStructure(f"the structure is not {what} by {defect[vertex]:.1e} rad (limit {EXACT:.0e}) at vertex "
                                   f"{vertex} ({place_of(topology, vertex)}), so {consequence}; {remedy}")

"""The motion of a principal structure, from the flat sheet to the flat-folded state (§2.5, Figs 5 and 10)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.errors import InvalidDesign, InvalidStructure
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.structure.cut import Cut
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.collisions import FreeRange, free_range
from plisse.transform.mechanism import FLAT_FOLDED, Mechanism
from plisse.transform.principal import require_principal

__all__ = ["Motion", "flex"]


@dataclass(frozen=True, eq=False)
class Motion:
    """States of a mechanism: `vertices` (K, V, 3) at `percent` (K,) over the topology of `cut`, one `development` (V, 2).

    0 percent is the flat sheet, 100 the designed state and 200 the flat-folded one; between them every tan(φ/2) is
    tan(π percent / 400) times its designed value, so that a fold of 90° turns in proportion to the percents. Closed
    structures are cut open; `cut_place` says where, and is empty for others.
    """

    mechanism: Mechanism
    cut: Cut
    percent: np.ndarray
    vertices: np.ndarray
    cut_place: str = ""

    @property
    def topology(self) -> Topology:
        """What the vertices of every state belong to: the structure's topology, cut open where it was closed."""
        return self.mechanism.topology

    @property
    def development(self) -> np.ndarray:
        """The flat sheet (V, 2) that all states share, in model units."""
        return self.mechanism.flat

    @cached_property
    def structures(self) -> tuple[PleatedStructure, ...]:
        """Every state as a structure with its development."""
        return tuple(PleatedStructure(self.topology, vertices, development=self.development) for vertices in self.vertices)

    @cached_property
    def free_range(self) -> FreeRange:
        """Between which percents no faces cut through each other; searched for when first asked."""
        return free_range(self.mechanism)

    def at(self, percent) -> "Motion":
        """The same mechanism at other percents; raises InvalidDesign where they leave 0…200."""
        percent = _checked(percent)
        return Motion(self.mechanism, self.cut, percent, self.mechanism.states(percent), self.cut_place)


def flex(structure: PleatedStructure, percent) -> Motion:
    """The motion of a principal structure at one percent or several, each in [0, 200], every state exact.

    Raises InvalidStructure with the vertex and its defect for structures that are not principal: they have no motion
    that keeps their rulings, and for those that lie flat, which do not say how far edges fold. Raises
    InvalidDesign for percents outside the range.
    """
    percent = _checked(percent)
    require_principal(structure, "it has no motion that keeps its rulings")
    structure = _developed(structure)
    opened = structure.opened
    assert structure.development is not None
    mechanism = Mechanism(opened.topology, structure.development, opened.vertices)
    return Motion(mechanism, structure.cut, percent, mechanism.states(percent), _cut_place(structure))


def _checked(percent) -> np.ndarray:
    values = np.atleast_1d(np.asarray(percent, dtype=float))
    if values.ndim != 1 or len(values) == 0:
        raise InvalidDesign(f"percent has shape {values.shape}; give one number or a list of numbers")
    wrong = ~((values >= 0) & (values <= FLAT_FOLDED))
    if wrong.any():
        raise InvalidDesign(f"percent is {values[np.argmax(wrong)]:g}; give numbers from 0 (flat) through 100 (as designed) "
                            "to 200 (folded flat)")
    return values


def _developed(structure: PleatedStructure) -> PleatedStructure:
    """The structure with its development, cut open where it has to be."""
    if structure.topology.components == 1 and (structure.development is None
                                               or structure.cut.topology.euler_characteristic < 1):
        structure = flatten(structure, best_cut(structure))
    if (pieces := structure.cut.topology.components) > 1:
        raise InvalidStructure(f"the sheet falls into {pieces} pieces, each with a motion of its own; flex them one by one")
    return structure


def _cut_place(structure: PleatedStructure) -> str:
    """Where a closed structure was cut open, in words; empty where it was not."""
    if structure.cut.is_trivial:
        return ""
    topology = structure.topology
    copied = np.unique(structure.cut.source[topology.vertex_count:])
    for number, crease in enumerate(topology.creases, 1):
        if np.isin(copied, crease.vertices).all():
            return f"along crease {number}"
    first = min(copied.tolist(), key=lambda vertex: place_of(topology, vertex))
    return f"across the creases, through {place_of(topology, first)}"

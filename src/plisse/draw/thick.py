"""Plates in place as one thick sheet: both sides and the rim as paper, and the edges that are sharp as lines (§2.4)."""

from dataclasses import dataclass

import numpy as np

from plisse.draw.runs import Run, lettered_runs
from plisse.geometry.vectors import dot, unit
from plisse.structure.incidence import corner_means
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.plates import Plates

__all__ = ["ThickSheet", "thick_sheet"]

SHARP = np.cos(np.radians(25))  # between successive edges of the rim


@dataclass(frozen=True, eq=False)
class ThickSheet:
    """The upper side, the lower one and the rim as one structure, in the order of `sides` and then loose walls.

    `sides` are vertices (2, V) of the upper and the lower side; `upright` edges (S, 2) lead from one to the other where
    the rim has a corner.
    """

    structure: PleatedStructure
    sides: np.ndarray
    upright: np.ndarray
    base: PleatedStructure

    @property
    def outlines(self) -> np.ndarray:
        """Ends (S, 2) of all sharp edges: creases and rims on both sides, and corners of the rim."""
        edges = self.base.topology.edges
        across = edges.vertices[edges.is_crease | edges.is_boundary]
        return np.concatenate([*self.sides[:, across], self.upright])

    @property
    def runs(self) -> list[Run]:
        """The sharp edges as runs of ink."""
        found = [run._replace(letter="B", vertices=side[run.vertices])
                 for run in lettered_runs(self.base) if run.letter != "R" for side in self.sides]
        return found + [Run("B", edge, False) for edge in self.upright]


def thick_sheet(plates: Plates) -> ThickSheet:
    """Mitred plates as a thick sheet; walls between neighbours, which nobody sees, are left out.

    At corners of the rim, where square cuts of neighbours miss each other by little, they meet half way.
    """
    base = plates.structure
    topology, count = base.topology, base.topology.vertex_count
    rim = topology.edges.vertices[topology.edges.is_boundary]
    upper, lower = (corner_means(topology, outline) for outline in (plates.upper, plates.lower))
    walls = np.stack([lower[rim[:, 0]], lower[rim[:, 1]], upper[rim[:, 1]], upper[rim[:, 0]]], axis=1)
    vertices = np.concatenate([upper, lower, walls.reshape(-1, 3)])
    quads = np.concatenate([topology.quads, count + topology.quads[:, [1, 0, 3, 2]],
                            2 * count + np.arange(4 * len(rim)).reshape(-1, 4)])
    hubs = (*topology.hubs, *(count + np.roll(hub[::-1], 2) for hub in topology.hubs))
    sides = np.arange(2 * count).reshape(2, count)
    return ThickSheet(PleatedStructure(Topology(len(vertices), quads, hubs), vertices), sides,
                      sides[:, _corners(rim, upper)].T, base)


def _corners(rim: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Vertices where the rim, edges (E, 2) that run around it, turns sharply."""
    along = unit(points[rim[:, 1]] - points[rim[:, 0]])
    arriving = np.zeros_like(points)
    arriving[rim[:, 1]] = along
    return rim[dot(arriving[rim[:, 0]], along) < SHARP, 0]

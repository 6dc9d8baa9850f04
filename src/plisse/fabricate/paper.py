"""The development as paper in millimetres, and what sets of its faces look like."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.vectors import cross_flat
from plisse.measure.folds import assignments
from plisse.structure.chains import directed_loops
from plisse.structure.front import front_up
from plisse.structure.lines import edge_keys
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["Paper", "paper_of"]


@dataclass(frozen=True, eq=False)
class Paper:
    """A development over the topology cut open: `points` (V', 2) in millimetres, faces counterclockwise.

    `source` names the vertex of the closed structure for every vertex, `letters` holds M, V, F or B per edge.
    """

    topology: Topology
    points: np.ndarray
    source: np.ndarray
    letters: np.ndarray

    @cached_property
    def face_areas(self) -> np.ndarray:
        """Area (F,) of every face in mm²."""
        corners = self.topology.corners
        doubled = cross_flat(self.points[corners.vertex], self.points[corners.next])
        return np.bincount(corners.face, doubled, self.topology.face_count) / 2

    @cached_property
    def edge_lengths(self) -> np.ndarray:
        """Length (E,) of every edge in mm."""
        a, b = self.topology.edges.vertices.T
        return np.hypot(*(self.points[b] - self.points[a]).T)

    @cached_property
    def columns(self) -> np.ndarray:
        """Number (F,) of the band across the creases that a face belongs to: rulings bound it."""
        return self.joined_over(self.topology.edges.is_crease)

    @cached_property
    def strips(self) -> np.ndarray:
        """Number (F,) of the strip between two creases that a face belongs to."""
        return self.joined_over(~self.topology.edges.is_crease)

    @cached_property
    def severed(self) -> np.ndarray:
        """Mask (E,) of boundary edges that belong together in the closed structure: the two sides of its cut."""
        edges = self.topology.edges
        key = edge_keys(self.source[edges.vertices], int(self.source.max()) + 1)
        _, group, count = np.unique(key, return_inverse=True, return_counts=True)
        return edges.is_boundary & (count[group] > 1)

    def joined_over(self, chosen: np.ndarray, inside: np.ndarray | None = None) -> np.ndarray:
        """Component numbers (F,) of faces joined over chosen inner edges (E,), −1 outside the mask `inside` (F,)."""
        if inside is None:
            return self.topology.joined_over(chosen)
        edges = self.topology.edges
        label = self.topology.joined_over(chosen & ~edges.is_boundary & inside[edges.faces].all(axis=1))
        out = np.full(self.topology.face_count, -1)
        out[inside] = np.unique(label[inside], return_inverse=True)[1]
        return out

    def rim(self, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Boundary edges of a set of faces (mask): vertex pairs (B, 2) with the faces on the left, and edge numbers."""
        edges = self.topology.edges
        first = faces[edges.faces[:, 0]]
        second = faces[edges.faces[:, 1]] & ~edges.is_boundary
        found = np.flatnonzero(first != second)
        return np.where(first[found, None], edges.vertices[found], edges.vertices[found, ::-1]), found

    def loops(self, faces: np.ndarray) -> list[np.ndarray]:
        """Boundary loops (N,) of a set of faces, the outer one first; holes run clockwise."""
        loops = directed_loops(self.rim(faces)[0])
        return sorted(loops, key=lambda loop: -self._doubled_area(loop))

    def polygon(self, faces: np.ndarray):
        """The set of faces as a shapely polygon; invalid where it covers a place twice or touches itself."""
        from shapely import Polygon

        outer, *holes = self.loops(faces)
        return Polygon(self.points[outer], [self.points[hole] for hole in holes])

    def _doubled_area(self, loop: np.ndarray) -> float:
        points = self.points[loop]
        return float(cross_flat(points, np.roll(points, -1, axis=0)).sum())


def paper_of(structure: PleatedStructure, scale: float = 1.0) -> Paper:
    """The development of a structure, front up, times `scale` (millimetres per model unit).

    Raises InvalidStructure when there is no development.
    """
    points, opened = front_up(structure) * scale, structure.opened
    letters = assignments(opened.topology, opened.vertices)
    edges = opened.topology.edges
    return Paper(opened.topology, points, structure.cut.source, np.where(edges.is_crease | edges.is_boundary, letters, "R"))

"""Outlines of faces whose edges move inwards in their planes: what plates are cut to."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.vectors import dot, norm, unit
from plisse.measure.folds import fold_angles
from plisse.measure.planarity import face_normals
from plisse.structure.incidence import edges_of_corners
from plisse.structure.topology import Topology

__all__ = ["Outlines"]


@dataclass(frozen=True, eq=False)
class Outlines:
    """The faces of a structure, corner by corner in the order of `topology.corners`; edge k runs from corner k on."""

    topology: Topology
    vertices: np.ndarray

    @cached_property
    def following(self) -> np.ndarray:
        """The corner (C,) that follows in the same face."""
        face = self.topology.corners.face
        first = np.flatnonzero(np.append(True, face[1:] != face[:-1]))
        following = np.arange(len(face)) + 1
        following[np.append(first[1:], len(face)) - 1] = first
        return following

    @cached_property
    def edge(self) -> np.ndarray:
        """The edge (C,) of the topology that leaves each corner."""
        return edges_of_corners(self.topology)[0]

    @cached_property
    def neighbour(self) -> np.ndarray:
        """The face (C,) on the other side of each edge, −1 on the boundary."""
        pair = self.topology.edges.faces[self.edge]
        return np.where(pair[:, 0] == self.topology.corners.face, pair[:, 1], pair[:, 0])

    @cached_property
    def fold(self) -> np.ndarray:
        """Signed fold angle (C,) in radians at each edge, valleys positive, 0 on the boundary."""
        return fold_angles(self.topology, self.vertices)[self.edge]

    @cached_property
    def normals(self) -> np.ndarray:
        """Unit normal (C, 3) of the face of each corner."""
        return face_normals(self.topology, self.vertices)[self.topology.corners.face]

    @cached_property
    def lengths(self) -> np.ndarray:
        """Length (C,) of each edge."""
        corners = self.topology.corners
        return norm(self.vertices[corners.next] - self.vertices[corners.vertex])

    def shifted(self, inward: np.ndarray, height: float = 0.0) -> np.ndarray:
        """Corners (C, 3) after every edge has moved `inward` (C,) in its plane, lifted by `height` along the normal."""
        before = self._arrived(inward)
        move = (before[:, None] * self._along - inward[:, None] * self._arriving) / self._turn[:, None]
        return self.vertices[self.topology.corners.vertex] + move + height * self.normals

    def loss(self, inward: np.ndarray) -> np.ndarray:
        """By how much (C,) each edge becomes shorter when all of them move `inward` (C,): linear in it."""
        after, at_end = inward[self.following], self.following
        cosine = dot(self._arriving, self._along)
        return ((self._arrived(inward) - inward * cosine) / self._turn
                + (after - inward * cosine[at_end]) / self._turn[at_end])

    def _arrived(self, leaving: np.ndarray) -> np.ndarray:
        """Values of the edges that arrive at each corner from those of the edges that leave them."""
        arriving = np.empty_like(leaving)
        arriving[self.following] = leaving
        return arriving

    @cached_property
    def _along(self) -> np.ndarray:
        corners = self.topology.corners
        return unit(self.vertices[corners.next] - self.vertices[corners.vertex])

    @cached_property
    def _arriving(self) -> np.ndarray:
        return self._arrived(self._along)

    @cached_property
    def _turn(self) -> np.ndarray:
        """Sine (C,) of the exterior angle at each corner."""
        return dot(np.cross(self._arriving, self._along), self.normals)

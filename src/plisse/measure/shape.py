"""Every measure of a folded shape, each taken once and only when asked for."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.measure.folds import crease_opening_angles
from plisse.measure.intersection import intersecting_faces
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import Regularity, inverted_faces
from plisse.measure.sectors import angle_defect, principal_defect, sector_angles
from plisse.structure.topology import Topology

__all__ = ["Shape"]


@dataclass(frozen=True, eq=False)
class Shape:
    """Vertices (V, 3) joined as a topology says; arrays over faces, vertices, corners and inner crease edges, in radians."""

    topology: Topology
    vertices: np.ndarray

    @cached_property
    def planarity(self) -> np.ndarray:
        """Planarity defect (F,)."""
        return planarity_defect(self.topology, self.vertices)

    @cached_property
    def sectors(self) -> np.ndarray:
        """Sector angles (C,)."""
        return sector_angles(self.topology, self.vertices)

    @cached_property
    def angle(self) -> np.ndarray:
        """Angle defect (V,), equation (2)."""
        return angle_defect(self.topology, self.vertices, self.sectors)

    @cached_property
    def principal(self) -> np.ndarray:
        """Principal defect (V,), equation (4)."""
        return principal_defect(self.topology, self.vertices, self.sectors)

    @cached_property
    def openings(self) -> np.ndarray:
        """Opening angles (K,) of inner crease edges."""
        return crease_opening_angles(self.topology, self.vertices)

    @cached_property
    def inverted(self) -> np.ndarray:
        """Mask (F,) of faces that are folded over."""
        return inverted_faces(self.topology, self.vertices)

    @cached_property
    def intersections(self) -> np.ndarray:
        """Pairs of faces (N, 2) that cut through each other."""
        return intersecting_faces(self.topology, self.vertices)

    @property
    def regularity(self) -> Regularity:
        """What makes an exact mesh foldable."""
        return Regularity.of(self.sectors, self.openings, self.inverted)

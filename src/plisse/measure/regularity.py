"""Regularity: what makes an exact mesh foldable. Sector angles, opening angles, inverted faces."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.components import cross, dot
from plisse.measure.folds import crease_opening_angles
from plisse.measure.planarity import face_normals
from plisse.measure.sectors import sector_angles
from plisse.structure.topology import Topology

__all__ = ["MIN_SECTOR", "OPENING_RANGE", "Regularity", "inverted_faces", "regularity"]

MIN_SECTOR = np.radians(5.0)
OPENING_RANGE = (np.radians(2.0), np.radians(178.0))


@dataclass(frozen=True)
class Regularity:
    """Smallest sector angle, extremes of the opening angles (radians), number of inverted faces."""

    min_sector: float
    min_opening: float
    max_opening: float
    inverted: int

    @classmethod
    def of(cls, sectors: np.ndarray, openings: np.ndarray, inverted: np.ndarray) -> "Regularity":
        """From all of them; without inner creases openings count as half open (π/2)."""
        opening = openings if len(openings) else np.array([np.pi / 2])
        return cls(float(sectors.min()), float(opening.min()), float(opening.max()), int(inverted.sum()))

    @property
    def is_regular(self) -> bool:
        """Whether every limit of the contract is kept."""
        return bool(self.min_sector >= MIN_SECTOR and self.min_opening > OPENING_RANGE[0]
                    and self.max_opening < OPENING_RANGE[1] and self.inverted == 0)


def regularity(topology: Topology, vertices: np.ndarray) -> Regularity:
    """Regularity of a structure."""
    return Regularity.of(sector_angles(topology, vertices), crease_opening_angles(topology, vertices),
                         inverted_faces(topology, vertices))


def inverted_faces(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Mask (F,) of faces with a corner that turns the wrong way: non-convex or folded over."""
    corners = topology.corners
    points, normals = np.ascontiguousarray(vertices.T), np.ascontiguousarray(face_normals(topology, vertices).T)
    origin, ahead, behind = (points.take(ends, axis=1) for ends in (corners.vertex, corners.next, corners.previous))
    wrong = dot(cross(ahead - origin, behind - origin), normals.take(corners.face, axis=1)) <= 0
    return np.bincount(corners.face, wrong, topology.face_count) > 0

"""Plates as closed polyhedra: what printers, mills and CAD programs take."""

from itertools import pairwise
from typing import NamedTuple

import numpy as np

from plisse.transform.plates import Plates

__all__ = ["Solid", "solids"]


class Solid(NamedTuple):
    """Corners (2k, 3) of a plate, its lower outline before its upper one, and plane polygons seen from outside."""

    vertices: np.ndarray
    faces: list[list[int]]

    @property
    def triangles(self) -> np.ndarray:
        """The polygons as triangles (T, 3), each a fan from its first corner."""
        return np.array([[face[0], b, c] for face in self.faces for b, c in pairwise(face[1:])])


def solids(plates: Plates) -> list[Solid]:
    """One closed, outward oriented solid per plate; walls are plane quads."""
    face = plates.structure.topology.corners.face
    cuts = np.flatnonzero(np.diff(face)) + 1
    outlines = zip(np.split(plates.lower, cuts), np.split(plates.upper, cuts), strict=True)
    return [Solid(np.concatenate([lower, upper]), _polygons(len(lower))) for lower, upper in outlines]


def _polygons(sides: int) -> list[list[int]]:
    lower = list(range(sides))
    walls = [[k, (k + 1) % sides, sides + (k + 1) % sides, sides + k] for k in lower]
    return [lower[::-1], [sides + k for k in lower], *walls]

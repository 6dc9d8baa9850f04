"""All numbers about a structure, taken once."""

from dataclasses import dataclass

import numpy as np

from plisse.measure.folds import crease_opening_angles
from plisse.measure.intersection import intersecting_faces
from plisse.measure.isometry import isometry_defect
from plisse.measure.overlap import Overlap, development_overlap
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import inverted_faces
from plisse.measure.sectors import angle_defect, principal_defect, sector_angles
from plisse.structure.pleated import PleatedStructure

__all__ = ["Measurements", "measure"]


@dataclass(frozen=True, eq=False)
class Measurements:
    """Arrays over faces, vertices, corners and inner crease edges; angles in radians.

    `intersections` are pairs of faces; `isometry` and `overlap` are None for a structure without development.
    """

    planarity: np.ndarray
    angle: np.ndarray
    principal: np.ndarray
    sectors: np.ndarray
    openings: np.ndarray
    inverted: np.ndarray
    intersections: np.ndarray
    isometry: float | None
    overlap: Overlap | None


def measure(structure: PleatedStructure) -> Measurements:
    """Every measure of a structure."""
    topology, vertices, flat = structure.topology, structure.vertices, structure.development
    opened = structure.cut.topology
    return Measurements(
        planarity_defect(topology, vertices), angle_defect(topology, vertices), principal_defect(topology, vertices),
        sector_angles(topology, vertices), crease_opening_angles(topology, vertices), inverted_faces(topology, vertices),
        intersecting_faces(topology, vertices),
        None if flat is None else isometry_defect(opened, vertices[structure.cut.source], flat),
        None if flat is None else development_overlap(opened, flat))

"""Energies and constraints of §3.4, one file each; every kernel carries its exact Jacobian."""

from plisse.solve.energies.angle_sum import angle_sum, developability
from plisse.solve.energies.closeness import Guides, closeness, offset_along
from plisse.solve.energies.displacement import displacement_fairness
from plisse.solve.energies.fairness import fairness
from plisse.solve.energies.flat_fold import flat_fold, flat_foldability
from plisse.solve.energies.length import equal_length, given_length, isometry
from plisse.solve.energies.plane import edge_in_plane, plane_fit
from plisse.solve.energies.principal import constant_fold, equal_cosine
from plisse.solve.energies.volume import planarity, tetrahedron_volume

__all__ = ["Guides", "angle_sum", "closeness",
           "constant_fold", "developability", "displacement_fairness", "edge_in_plane", "equal_cosine",
           "equal_length", "fairness", "flat_fold", "flat_foldability", "given_length", "isometry",
           "offset_along", "planarity", "plane_fit",
           "tetrahedron_volume"]

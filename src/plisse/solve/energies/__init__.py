"""Energies and constraints of §3.4, one file each; every kernel carries its exact Jacobian."""

from plisse.solve.energies.angle_sum import angle_sum, developability
from plisse.solve.energies.binormal import binormal_fit, orthogonal_to_edge
from plisse.solve.energies.closeness import Guides, closeness, offset_along
from plisse.solve.energies.displacement import displacement_fairness
from plisse.solve.energies.fairness import fairness
from plisse.solve.energies.flat_fold import flat_fold, flat_foldability
from plisse.solve.energies.kernel import KERNELS, Kernel, Rows, Term
from plisse.solve.energies.length import equal_length, given_length, isometry, isometry_pairs
from plisse.solve.energies.plane import edge_in_plane, plane_fit, unit_length
from plisse.solve.energies.principal import constant_fold, equal_cosine
from plisse.solve.energies.volume import planarity, tetrahedron_volume

__all__ = ["KERNELS", "Guides", "Kernel", "Rows", "Term", "angle_sum", "binormal_fit", "closeness",
           "constant_fold", "developability", "displacement_fairness", "edge_in_plane", "equal_cosine",
           "equal_length", "fairness", "flat_fold", "flat_foldability", "given_length", "isometry",
           "isometry_pairs", "offset_along", "orthogonal_to_edge", "planarity", "plane_fit",
           "tetrahedron_volume", "unit_length"]

"""Energies and constraints of §3.4, one file each; every kernel carries its exact Jacobian."""

from plisse.solve.energies.angle_sum import angle_sum, developability
from plisse.solve.energies.displacement import displacement_fairness
from plisse.solve.energies.flat_fold import flat_fold, flat_foldability
from plisse.solve.energies.kernel import KERNELS, Kernel, Rows, Term
from plisse.solve.energies.length import equal_length, given_length, isometry, isometry_pairs
from plisse.solve.energies.volume import planarity, tetrahedron_volume

__all__ = ["KERNELS", "Kernel", "Rows", "Term", "angle_sum", "developability", "displacement_fairness", "equal_length",
           "flat_fold", "flat_foldability", "given_length", "isometry", "isometry_pairs", "planarity",
           "tetrahedron_volume"]

"""Energies and constraints of §3.4, one file each; every kernel carries its exact Jacobian."""

from plisse.solve.energies.angle_sum import angle_sum, developability
from plisse.solve.energies.flat_fold import flat_fold, flat_foldability
from plisse.solve.energies.kernel import KERNELS, Kernel, Rows, Term
from plisse.solve.energies.displacement import displacement_fairness
from plisse.solve.energies.volume import tetrahedron_volume, planarity

__all__ = ["KERNELS", "Kernel", "Rows", "Term", "angle_sum", "developability", "displacement_fairness", "flat_fold",
           "flat_foldability", "planarity", "tetrahedron_volume"]

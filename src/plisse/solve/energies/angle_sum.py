"""Developability: the angles around every inner vertex sum to 2π (§2.3 (2)), without an unfolding."""

import numpy as np

from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.solve.energies.sector import signed_angle_gradients, signed_angles
from plisse.structure.topology import Topology

__all__ = ["angle_sum", "developability"]


@kernel
def angle_sum(centre, *ring):
    """Σω − 2π."""
    return signed_angles(centre, ring, [1.0] * len(ring)) - 2 * np.pi


@angle_sum.jacobian
def _(centre, *ring):
    return signed_angle_gradients(centre, ring, [1.0] * len(ring))


def developability(topology: Topology, weight: float = 1.0) -> list[Term]:
    """One term per valence of inner vertices."""
    return [Term("angle_sum", angle_sum, tuple(Rows("vertices", column) for column in stars.T), weight)
            for stars in topology.stars.values()]

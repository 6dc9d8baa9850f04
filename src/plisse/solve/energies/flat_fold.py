"""Flat-foldability, equivalent to the principal property: ω1 + ω3 = ω2 + ω4 (§2.4 (3))."""

from plisse.leastsquares.kernel import Rows, Term, kernel
from plisse.solve.energies.sector import signed_angle_gradients, signed_angles
from plisse.structure.topology import Topology

__all__ = ["flat_fold", "flat_foldability"]

ALTERNATING = (1.0, -1.0, 1.0, -1.0)


@kernel
def flat_fold(centre, first, second, third, fourth):
    """ω1 − ω2 + ω3 − ω4."""
    return signed_angles(centre, (first, second, third, fourth), ALTERNATING)


@flat_fold.jacobian
def _(centre, first, second, third, fourth):
    return signed_angle_gradients(centre, (first, second, third, fourth), ALTERNATING)


def flat_foldability(topology: Topology, weight: float = 1.0) -> list[Term]:
    """One condition per 4-valent inner vertex."""
    stars = topology.stars.get(4)
    if stars is None:
        return []
    return [Term("flat_fold", flat_fold, tuple(Rows("vertices", column) for column in stars.T), weight)]

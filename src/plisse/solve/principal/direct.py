"""Direct fit: greedy first numbers, then all numbers together, then with a displaced seed."""

import numpy as np

from plisse.solve.principal.greedy import greedy_fit, opened
from plisse.solve.principal.joint import joint_fit
from plisse.solve.principal.numbers import PrincipalNumbers, start, with_terms
from plisse.solve.principal.realise import crease_deviation, realise
from plisse.solve.principal.target import Target

__all__ = ["LOST", "direct_fit", "is_lost"]

LOST = 10.0  # amplitudes from which more iterations do not bring a fit back


def direct_fit(target: Target, terms: int, stiffness: float) -> PrincipalNumbers:
    """All numbers of a structure along the guides, with `terms` displacement coefficients per normal.

    Closed creases need no greedy start: typical widths suffice, direction and fold follow from closing.
    """
    numbers = start(target)
    if not target.closed:
        numbers = greedy_fit(target, opened(target, numbers))
    numbers, _ = joint_fit(target, numbers, 20)
    if is_lost(target, numbers):
        return numbers
    return joint_fit(target, with_terms(numbers, terms), 25, stiffness)[0]


def is_lost(target: Target, numbers: PrincipalNumbers) -> bool:
    """Whether some crease of the target, inside its window, has run away from its guide."""
    deviation = crease_deviation(target, realise(target, numbers))[target.first:target.last + 1]
    return not np.nan_to_num(deviation[:, target.weights > 0], nan=np.inf).max() < LOST

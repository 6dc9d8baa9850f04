"""Progressive fit: creases join one by one, then the fitted part of their length grows."""

from plisse.solve.principal.direct import is_lost
from plisse.solve.principal.greedy import greedy_fit, opened
from plisse.solve.principal.joint import joint_fit
from plisse.solve.principal.numbers import PrincipalNumbers, start, with_terms
from plisse.solve.principal.target import Target

__all__ = ["progressive_fit"]

_ITERATIONS = 4  # of the joint fit per added pair of creases


def progressive_fit(target: Target, terms: int, stiffness: float,
                    windows: tuple[float, ...]) -> PrincipalNumbers:
    """Add creases outwards on both sides, refitting all numbers each time; then widen the window."""
    last = len(target.guides) - 1
    numbers = with_terms(start(target), terms)
    known: frozenset[int] = frozenset()
    for reach in range(2, max(target.seed, last - target.seed) + 1):
        part = target.within(max(0, target.seed - reach), min(last, target.seed + reach), windows[0])
        if not target.closed:
            numbers = greedy_fit(part, opened(part, numbers) if reach == 2 else numbers, known)
        numbers, _ = joint_fit(part, numbers, _ITERATIONS, stiffness)
        if is_lost(part, numbers):
            return numbers
        known = frozenset(range(part.first + 1, part.last))
    for window in windows:
        whole = target.within(0, last, window)
        numbers, _ = joint_fit(whole, numbers, 20 if window == 1 else 2 * _ITERATIONS, stiffness)
    return numbers

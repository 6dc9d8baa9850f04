"""How far a mechanism moves before its faces run into each other (§2.5)."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from plisse.measure.intersection import intersecting_faces
from plisse.structure.place import place_of
from plisse.transform.mechanism import FLAT_FOLDED, Mechanism

__all__ = ["DESIGNED", "FreeRange", "first_of", "free_range", "narrowed"]

DESIGNED = 100.0
STEP = 2.0
TOLERANCE = 0.02
AT_ONCE = 5


@dataclass(frozen=True)
class FreeRange:
    """Percents between which no faces cut through each other, and a sentence for each end that a collision sets.

    Both ends are equal where the designed state itself cuts through itself.
    """

    low: float
    high: float
    collisions: tuple[str, ...] = ()

    def __contains__(self, percent: float) -> bool:
        return self.low <= percent <= self.high


def free_range(mechanism: Mechanism) -> FreeRange:
    """The free range around the designed state, its ends to 0.02 percent.

    Every second percent is looked at, from the designed state outwards: a collision that comes and goes within two
    percent may be missed. Faces that only touch, as the layers of the flat-folded state do, do not collide.
    """
    if struck := _collision(mechanism, DESIGNED):
        return FreeRange(DESIGNED, DESIGNED, (_sentence(mechanism, DESIGNED, struck),))
    low, below = _first_collision(mechanism, 0.0)
    high, above = _first_collision(mechanism, FLAT_FOLDED)
    ends = ((low, below), (high, above))
    return FreeRange(low, high, tuple(_sentence(mechanism, end, struck) for end, struck in ends if struck))


def _first_collision(mechanism: Mechanism, goal: float) -> tuple[float, tuple[int, int] | None]:
    """The last free percent between the designed state and `goal`, and the faces that meet there."""
    count = round(abs(goal - DESIGNED) / STEP)
    # the end itself has all faces in one plane, where nothing cuts through anything: stop just before it
    stops = np.append(np.linspace(DESIGNED, goal, count + 1)[1:-1], goal + 0.2 * np.sign(DESIGNED - goal) * STEP)
    free = DESIGNED
    for start in range(0, len(stops), AT_ONCE):
        some = stops[start:start + AT_ONCE]
        for percent, vertices in zip(some.tolist(), mechanism.states(some), strict=True):
            if struck := _first_pair(mechanism, vertices):
                return narrowed(lambda middle: _collision(mechanism, middle), free, percent, struck, TOLERANCE)
            free = percent
    return goal, None


def narrowed(collision: Callable[[float], tuple[int, int] | None], free: float, struck_at: float,
             struck: tuple[int, int], tolerance: float) -> tuple[float, tuple[int, int]]:
    """The last free percent between a free one and one with a collision, by halving, and the pair that meets beyond it."""
    while abs(struck_at - free) > tolerance:
        middle = 0.5 * (free + struck_at)
        if found := collision(middle):
            struck_at, struck = middle, found
        else:
            free = middle
    return free, struck


def _collision(mechanism: Mechanism, percent: float) -> tuple[int, int] | None:
    return _first_pair(mechanism, mechanism.states(np.array([percent]))[0])


def _first_pair(mechanism: Mechanism, vertices: np.ndarray) -> tuple[int, int] | None:
    return first_of(intersecting_faces(mechanism.topology, vertices))


def first_of(pairs: np.ndarray) -> tuple[int, int] | None:
    """The first of pairs (K, 2), None where there are none."""
    return (int(pairs[0, 0]), int(pairs[0, 1])) if len(pairs) else None


def _sentence(mechanism: Mechanism, percent: float, struck: tuple[int, int]) -> str:
    topology = mechanism.topology
    one, other = (place_of(topology, topology.faces[face][0]) for face in struck)
    where = f"{one} and {other}" if one != other else one
    if percent == DESIGNED:
        return f"the designed state itself cuts through itself: faces at {where}"
    side = "below" if percent < DESIGNED else "above"
    return f"{side} {percent:.1f} % faces run into each other: {where}"

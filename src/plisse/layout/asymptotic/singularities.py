"""Singularities of asymptotic directions: flat points, with their index, and the curves that end there (§2.6)."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.chart import Chart
from plisse.layout.asymptotic.directions import Directions, Field

__all__ = ["Singularity", "radial_directions", "singularities"]

CELLS = 240
NEWTON_STEPS = 30
CLOSEST = 0.01  # cells between singularities that are told apart
AROUND = 2880  # directions looked at on a circle


@dataclass(frozen=True)
class Singularity:
    """A place where asymptotic directions are not determined, and the index of the fields around it, −½, −1, …

    With `others` it is the middle of several such places too close to be told apart by a pattern, with their index.
    """

    place: complex
    index: float
    others: tuple[complex, ...] = ()

    @property
    def sectors(self) -> int:
        """Number of curves of each family that end there."""
        return round(2 - 2 * self.index)

    @property
    def spread(self) -> float:
        """Largest distance of the others from the middle, in the plane."""
        return max((abs(other - self.place) for other in self.others), default=0.0)


def singularities(chart: Chart) -> tuple[Singularity, ...]:
    """All singularities in a chart: zeros of A + iB = (L − N)/2 + iM, whose turns are counted on a fine grid."""
    low, high = chart.domain
    # off the symmetry axes of the domain, where singularities like to lie
    u = np.linspace(low.real, high.real, CELLS + 1) + 0.0137 * (high.real - low.real) / CELLS
    v = np.linspace(low.imag, high.imag, CELLS + 1) + 0.0171 * (high.imag - low.imag) / CELLS
    places = u[:, None] + 1j * v
    value = _deviator(chart, places.ravel()).reshape(places.shape)
    turn = (_turn(value[:-1, :-1], value[1:, :-1]) + _turn(value[1:, :-1], value[1:, 1:])
            + _turn(value[1:, 1:], value[:-1, 1:]) + _turn(value[:-1, 1:], value[:-1, :-1]))
    size = abs(high - low) / CELLS
    zeros: list[complex] = []
    for i, j in np.argwhere(np.abs(turn) > np.pi):
        place = _zero(chart, places[i, j] + 0.5 * (u[1] - u[0] + 1j * (v[1] - v[0])), size)
        if chart.inside(np.array([place]))[0] and all(abs(place - other) > 2 * size for other in zeros):
            zeros.append(place)
    found = (_around(chart, place, size) for place in zeros)
    return tuple(single for single in found if single.index != 0)


def radial_directions(directions: Directions, singularity: Singularity, radius: float, field: Field) -> np.ndarray:
    """Unit directions (K,) in which curves of a field leave a singularity, looked for on a circle (in the plane)."""
    angle = 0.01234 + np.linspace(0, 2 * np.pi, AROUND + 1)
    outward = np.exp(1j * angle)
    along = directions.at(singularity.place + radius * outward, outward, field)
    gap = np.unwrap(2 * np.angle(along)) - 2 * angle
    turns = np.floor(gap / (2 * np.pi))
    at = np.flatnonzero(np.diff(turns))
    aim = 2 * np.pi * np.maximum(turns[at], turns[at + 1])
    found = angle[at] + (aim - gap[at]) / (gap[at + 1] - gap[at]) * (angle[1] - angle[0])
    return np.exp(1j * found)


def _deviator(chart: Chart, places: np.ndarray) -> np.ndarray:
    """(L − N)/2 + iM at places (N,)."""
    one, mixed, two = chart.at(places).second
    return 0.5 * (one - two) + 1j * mixed


def _turn(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    return np.angle(end * np.conj(start))


def _around(chart: Chart, place: complex, size: float) -> Singularity:
    """The singularity at a zero, or the middle of all those within two cells of it, found from starts around it."""
    index = _index(chart, place, 2 * size)
    if index == _index(chart, place, CLOSEST * size):
        return Singularity(place, index)
    zeros = [place]
    for start in place + np.outer([0.2, 0.6, 1.2], np.exp(2j * np.pi * np.arange(8) / 8)).ravel() * size:
        zero = _zero(chart, complex(start), size)
        if abs(zero - place) < 2 * size and all(abs(zero - other) > CLOSEST * size for other in zeros):
            zeros.append(zero)
    return Singularity(complex(np.mean(zeros)), index, tuple(zeros)) if len(zeros) > 1 else Singularity(place, index)


def _index(chart: Chart, place: complex, radius: float) -> float:
    """Half the number of turns of A + iB around a circle, because directions turn half as fast as 2φ."""
    value = _deviator(chart, place + radius * np.exp(2j * np.pi * np.arange(240) / 240))
    return round(float(_turn(value, np.roll(value, -1)).sum() / (2 * np.pi))) / 2


def _zero(chart: Chart, place: complex, size: float) -> complex:
    """A zero of A + iB near a place: Newton steps with differences, none longer than a cell."""
    shift = 1e-4 * size
    for _ in range(NEWTON_STEPS):
        here, right, left, up, down = _deviator(chart, place + shift * np.array([0, 1, -1, 1j, -1j]))
        du, dv = (right - left) / (2 * shift), (up - down) / (2 * shift)
        matrix = np.array([[du.real, dv.real], [du.imag, dv.imag]])
        step = complex(*np.linalg.lstsq(matrix, -np.array([here.real, here.imag]), rcond=None)[0])
        place += step * min(1.0, size / max(abs(step), 1e-300))
        if abs(step) < 1e-11 * size + 4 * np.finfo(float).eps * abs(place):
            break
    return place

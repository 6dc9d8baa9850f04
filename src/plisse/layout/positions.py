"""Where the creases of a family start on a guide or around a point, so that strips mirror there (Fig. 11)."""

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.layout.widths import mirrored_width
from plisse.memory import peak_bytes, refuse_too_large

__all__ = ["crease_positions", "fan_radius", "refuse_too_many", "upright_amplitude"]

MOST_VERTICES = 250_000


def refuse_too_many(vertices: float, remedy: str) -> None:
    """Raise InvalidDesign where a layout would have more vertices than are solved for, or more than memory holds.

    `remedy` says what to change.
    """
    if vertices > MOST_VERTICES:
        raise InvalidDesign(f"pleats that narrow have about {vertices:.2g} vertices, more than the {MOST_VERTICES:,} that "
                            f"plisse solves for; {remedy}")
    refuse_too_large(peak_bytes(vertices, vertices**0.5), f"a layout of about {vertices:.2g} vertices", remedy)


def crease_positions(length: float, closed: bool, *, theta: float, width: float, amplitude: float,
                     creases: int | None = None, above: bool = False) -> tuple[np.ndarray, np.ndarray]:
    """Where creases cross a guide of the given length, and the widths of the strips between them.

    Climbing strips have the width s1 = `width`, falling ones s2 with sin θ = d (1/s2 − 1/s1) (Fig. 11); the first strip
    climbs unless the first crease lies `above`. On open guides they stand about the middle, as many as there is room for
    unless `creases` says how many. Around closed guides their number is even and the width follows from it. Raises
    Infeasible where they do not fit.
    """
    pair = width + _falling(width, theta, amplitude)
    if closed:
        count = max(4, 2 * round(length / pair)) if creases is None else creases
        if count % 2 or count < 4:
            raise Infeasible(f"a closed family needs an even number of creases, at least 4, not {count}")
        width = _climbing(2 * length / count, theta, amplitude)
        falling = _falling(width, theta, amplitude)
        spacing = np.tile([falling, width] if above else [width, falling], count // 2)
        return np.concatenate([[0.0], np.cumsum(spacing)[:-1]]), spacing
    strips = [pair - width, width] if above else [width, pair - width]
    fits = int(2 * np.floor(length / pair) + (length % pair >= strips[0]) + 1)
    count = fits if creases is None else creases
    spacing = np.tile(strips, count // 2 + 1)[:max(count - 1, 0)]
    if count < 3 or spacing.sum() > length * (1 + 1e-9):
        raise Infeasible(f"the guide is {length:.4g} long and has room for {fits} creases, not for {max(count, 3)}: give "
                         "a longer guide, a smaller width or fewer creases")
    return 0.5 * (length - spacing.sum()) + np.concatenate([[0.0], np.cumsum(spacing)]), spacing


def fan_radius(creases: int, *, theta: float, width: float, amplitude: float,
               sector: tuple[float, float] | None = None) -> float:
    """The distance from a point at which creases in all directions, or in a sector (radians), have their width."""
    pair = width + _falling(width, theta, amplitude)
    low, high = (0.0, 2 * np.pi) if sector is None else sector
    return 0.5 * pair * (creases if sector is None else creases - 1) / (high - low)


def upright_amplitude(theta: float, width: float) -> float:
    """The amplitude from which pleats of inclination theta (radians) overhang; none is small enough from 45° on.

    A falling strip runs across the surface by s2 − 2 d sin θ, and with the mirror spacing of Fig. 11 that is negative for
    s1 cos 2θ < 2 d sin θ.
    """
    return max(width * float(np.cos(2 * theta)) / max(2 * float(np.sin(theta)), 1e-300), 0.0)


def _falling(width: float, theta: float, amplitude: float) -> float:
    """Width s2 of the falling strip beside a climbing one of width s1."""
    return float(mirrored_width(np.array(width), np.array(theta), amplitude))


def _climbing(pair: float, theta: float, amplitude: float) -> float:
    """Width s1 of the climbing strip when both together are `pair` wide."""
    slope = np.sin(theta) / amplitude
    half = 0.5 * pair
    return pair - half if slope * half < 1e-9 else float(half + (np.sqrt((slope * half) ** 2 + 1) - 1) / slope)

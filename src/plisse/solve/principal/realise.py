"""From numbers to vertices: the exact structure, its free rims, and how far it is from the guides."""

import numpy as np

from plisse.geometry.components import norm
from plisse.solve.principal.closed import close_crease, closed_crease
from plisse.solve.principal.march import next_crease
from plisse.solve.principal.numbers import PrincipalNumbers
from plisse.solve.principal.residuals import off_guide, rim_reach
from plisse.solve.principal.series import basis, places
from plisse.solve.principal.strip import Strip
from plisse.solve.principal.target import Target

__all__ = ["crease_deviation", "realise"]

_RIM_TERMS = 8


def realise(target: Target, numbers: PrincipalNumbers) -> np.ndarray:
    """Creases (m, 3, n) of the structure with these numbers; nan where it does not exist."""
    creases = np.full(target.guides.shape, np.nan)
    half, displacement = np.array([numbers.half_opening]), numbers.displacement[None]
    with np.errstate(all="ignore"):
        creases[target.seed] = target.seed_points(displacement)[:, 0]
        for strip, side in zip(target.seed_strips(displacement, half), target.sides(), strict=True):
            for crease in side[:-1]:
                strip = _next(target, strip, numbers.creases[crease])
                creases[crease] = strip.points[:, 0]
            for crease in side[-1:]:
                creases[crease] = (strip.points + _rim(target, crease, strip) * strip.rulings)[:, 0]
    return creases


def crease_deviation(target: Target, creases: np.ndarray) -> np.ndarray:
    """Distances (m, n) of creases (m, 3, n) from their guides, extended tangentially, in amplitudes."""
    offsets = [off_guide(target, crease, points[:, None]).reshape(3, -1)
               for crease, points in enumerate(creases)]
    return norm(np.stack(offsets, axis=1))


def _next(target: Target, strip: Strip, trio: np.ndarray) -> Strip:
    if not target.closed:
        return next_crease(strip, *trio[:, None]).beyond
    distance = trio[:1]
    direction, fold = close_crease(strip, distance, trio[None, 1:])[0].T
    return closed_crease(strip, distance, direction, fold).beyond


def _rim(target: Target, crease: int, strip: Strip) -> np.ndarray:
    """Distances (n,) of a smooth rim: a short series through where rulings are nearest to the guide."""
    width = target.widths[crease]
    reach = np.clip(np.nan_to_num(rim_reach(target, crease, strip)[1][0], nan=width), 0.3 * width, 2 * width)
    terms = 2 * _RIM_TERMS + 1 if target.closed else _RIM_TERMS
    shapes = basis(terms, places(target.samples, target.closed), target.closed)
    smooth = np.linalg.lstsq(shapes.T, reach, rcond=None)[0] @ shapes
    return np.clip(smooth, 0.25 * width, 2.2 * width)

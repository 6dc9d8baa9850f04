"""Asymptotic directions: two line fields that never mix, and where they are not determined (§2.6).

With A = (L − N)/2, B = M and C = (L + N)/2 the asymptotic directions make the angles φ with the u axis for which
2φ = atan2(B, A) ± acos(−C/√(A² + B²)); one sign belongs to each family. Where K > 0 the two meet half way.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

from plisse.geometry.chart import Chart, ChartPoints

__all__ = ["Directions", "Field"]

Field = Literal["creases", "columns"]


@dataclass(frozen=True, eq=False)
class Directions:
    """The asymptotic directions of one `family`, 1 or 2, and those orthogonal to them on the surface."""

    chart: Chart
    family: int = 1

    def at(self, places: np.ndarray, ahead: np.ndarray, field: Field = "creases") -> np.ndarray:
        """Unit directions (N,) in the plane, those of the two senses that agree with `ahead` (N,)."""
        return self.along(self.chart.at(places), ahead, field)

    def along(self, points: ChartPoints, ahead: np.ndarray, field: Field = "creases") -> np.ndarray:
        """The same where the surface is known already."""
        direction = asymptotic(points.second, self.family)
        if field == "columns":
            direction = _orthogonal(points, direction)
        return np.where((direction * np.conj(ahead)).real < 0, -direction, direction)


def asymptotic(second: np.ndarray, family: int) -> np.ndarray:
    """Unit asymptotic directions (N,) of a family for L, M and N (3, N)."""
    one, mixed, two = second
    half = 0.5 * (one - two)
    size = np.hypot(half, mixed)
    spread = np.arccos(np.clip(-0.5 * (one + two) / np.maximum(size, np.finfo(float).tiny), -1, 1))
    return np.exp(0.5j * (np.arctan2(mixed, half) + (spread if family == 1 else -spread)))


def _orthogonal(points: ChartPoints, direction: np.ndarray) -> np.ndarray:
    """Unit directions (N,) orthogonal to given ones on the surface."""
    e, f, g = points.metric
    turned = -(f * direction.real + g * direction.imag) + 1j * (e * direction.real + f * direction.imag)
    return turned / np.abs(turned)

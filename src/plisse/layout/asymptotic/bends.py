"""How creases bend and twist along a net: what labels, legs and rulings depend on (§2.6)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.chart import Chart
from plisse.geometry.vectors import dot, norm
from plisse.layout.asymptotic.overlay import Net

__all__ = ["Bends"]

WINDOW = 8  # samples of a crease on either side from which it is judged


@dataclass(frozen=True, eq=False)
class Bends:
    """Curvature vectors (V, 3) of the creases at the vertices of a net, and their torsion (V,), √−K."""

    curvature: np.ndarray
    torsion: np.ndarray

    @classmethod
    def of(cls, net: Net, chart: Chart) -> "Bends":
        """Curvature by differences along the creases of a net, torsion from the surface."""
        curvature = np.zeros((len(net.places), 3))
        for number, leaf in enumerate(net.creases):
            on = np.flatnonzero(net.crease == number)
            k = np.arange(len(leaf.arc))
            before, after = np.clip(k - WINDOW, 0, None), np.clip(k + WINDOW, None, len(k) - 1)
            inner = (before == k - WINDOW) & (after == k + WINDOW)
            if not len(on) or inner.sum() < 2:
                continue
            k, before, after = k[inner], before[inner], after[inner]
            back, ahead = leaf.arc[k] - leaf.arc[before], leaf.arc[after] - leaf.arc[k]
            bend = 2 * ((leaf.points[after] - leaf.points[k]) / ahead[:, None]
                        - (leaf.points[k] - leaf.points[before]) / back[:, None]) / (ahead + back)[:, None]
            curvature[on] = np.stack([np.interp(net.along[on], leaf.plane[k], column) for column in bend.T], axis=1)
        return cls(curvature, np.sqrt(np.maximum(-chart.at(net.places).curvature, 0)))

    @cached_property
    def twist(self) -> np.ndarray:
        """τ/κ (V,)."""
        return self.torsion / np.maximum(norm(self.curvature), 1e-12 * max(float(self.torsion.max(initial=0)), 1e-300))

    def facing(self, points: np.ndarray, one: np.ndarray, other: np.ndarray) -> np.ndarray:
        """Signed weights (E,): positive where creases at the ends of edges turn to the same side, negative where not.

        `one` and `other` (E,) are vertices at `points` (V, 3).
        """
        along = points[other] - points[one]
        along = along / norm(along)[:, None]
        first, second = dot(along, self.curvature[one]), dot(along, self.curvature[other])
        return np.sign(first * second) * np.minimum(np.abs(first), np.abs(second))

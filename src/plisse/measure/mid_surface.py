"""How far the mid-surface of a structure is from the surface it was made for (reconstruction, Fig. 20)."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.surface import Surface
from plisse.geometry.vectors import dot

__all__ = ["MidSurfaceDeviation", "mid_surface_deviation"]


@dataclass(frozen=True, eq=False)
class MidSurfaceDeviation:
    """Distances (F,) of the middles of faces from the reference in model units; nan where it had to be continued."""

    distances: np.ndarray

    @property
    def mean(self) -> float:
        """Mean distance over the faces that lie on the reference."""
        return float(np.nanmean(self.distances)) if np.isfinite(self.distances).any() else 0.0

    @property
    def max(self) -> float:
        """Largest distance over the faces that lie on the reference."""
        return float(np.nanmax(self.distances)) if np.isfinite(self.distances).any() else 0.0


def mid_surface_deviation(surface: Surface, vertices: np.ndarray, quads: np.ndarray) -> MidSurfaceDeviation:
    """Deviation of quads (F, 4) over vertices (V, 3): the middle of a quad lies half way between its two creases.

    Distances are taken along the surface normal, for projections need not go to the closest point.
    """
    middles = vertices[quads].mean(axis=1)
    points = surface.project(middles)
    return MidSurfaceDeviation(np.where(points.known, np.abs(dot(points.positions - middles, points.normals)), np.nan))

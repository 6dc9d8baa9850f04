"""What every reference surface can do: take points onto itself and say how it bends there (§3.1)."""

from dataclasses import dataclass
from typing import Protocol

import numpy as np

__all__ = ["Surface", "SurfacePoints"]


@dataclass(frozen=True, eq=False)
class SurfacePoints:
    """Points on a surface: `positions` and unit `normals` (N, 3), second fundamental tensors `bending` (N, 3, 3).

    For a unit tangent vector t the normal curvature is κ_n = tᵀ B t; B annihilates the normal. A sphere of radius R
    with outward normals has κ_n = −1/R. `known` (N,) is false where the surface had to be continued beyond its data.
    """

    positions: np.ndarray
    normals: np.ndarray
    bending: np.ndarray
    known: np.ndarray


class Surface(Protocol):
    """A smooth reference surface, given by formula or fitted to a mesh."""

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box in model units."""

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Points (N, 3) taken to nearby points of the surface, with normals and bending there."""

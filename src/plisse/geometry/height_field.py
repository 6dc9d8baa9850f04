"""Reference surfaces z(x, y) given as an expression."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.errors import InvalidDesign
from plisse.geometry.expression import height_expression
from plisse.geometry.mesh import ReferenceMesh, grid_lines, grid_mesh
from plisse.geometry.monge import monge
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.vectors import norm

__all__ = ["HeightField"]

EDGE = 1e-9  # relative width by which points on a boundary may lie outside


@dataclass(frozen=True)
class HeightField:
    """Graph z(x, y) of an expression over the rectangle x × y, normals upward."""

    z: str
    x: tuple[float, float] = (-1.0, 1.0)
    y: tuple[float, float] = (-1.0, 1.0)

    def __post_init__(self):
        for name, (low, high) in (("x", self.x), ("y", self.y)):
            if not (np.isfinite([low, high]).all() and low < high):
                raise InvalidDesign(f"the range of {name} is [{low:g}, {high:g}]; give two rising numbers")
        _, _, z = self._grid(60)
        if not np.isfinite(z).all():
            row, column = np.argwhere(~np.isfinite(z))[0]
            x, y, _ = self._grid(60)
            raise InvalidDesign(f"the height {self.z[:40]!r} is not defined at x = {x[row, column]:.4g}, "
                                f"y = {y[row, column]:.4g}")

    @cached_property
    def _heights(self) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
        return height_expression(self.z)

    @cached_property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        z = self._grid(60)[2]
        return float(norm(np.array([np.ptp(self.x), np.ptp(self.y), np.ptp(z)])))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Points moved up or down onto the graph; nan where the expression is not defined."""
        part = self._heights(points[:, 0], points[:, 1])
        with np.errstate(invalid="ignore"):
            normals, bending = monge(part[1:3], part[3:6])
        known = np.isfinite(part[0])
        for axis, (low, high) in enumerate((self.x, self.y)):
            slack = EDGE * (high - low)
            known &= (points[:, axis] >= low - slack) & (points[:, axis] <= high + slack)
        return SurfacePoints(np.stack([points[:, 0], points[:, 1], part[0]], axis=1), normals, bending, known)

    def derivatives(self, x: np.ndarray, y: np.ndarray) -> np.ndarray:
        """z, zx, zy, zxx, zxy and zyy (6, N) at points (N,) each; nan where the expression is not defined."""
        return self._heights(x, y)

    def mesh(self, cells: int = 40) -> ReferenceMesh:
        """Grid with `cells` cells along the longer side."""
        x, y, z = self._grid(cells)
        return grid_mesh(np.stack([x, y, z], axis=-1))

    def _grid(self, cells: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        x, y = np.meshgrid(*grid_lines(self.x, self.y, cells), indexing="ij")
        return x, y, self._heights(x, y)[0].reshape(x.shape)

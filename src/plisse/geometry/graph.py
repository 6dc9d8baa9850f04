"""Smooth graphs over the mean plane of a mesh, continued beyond its boundary like a thin plate."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import NdBSpline

from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.monge import monge
from plisse.geometry.outline import Outline
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.thin_plate import smoothing_spline
from plisse.geometry.vectors import dot, unit

__all__ = ["GraphSurface", "facing_up"]

MAX_CELLS = 220


def facing_up(mesh: ReferenceMesh) -> float:
    """Share of the area whose normals lie on the upper side of the mean plane: 1 for graphs."""
    up = unit(mesh.face_vectors.sum(axis=0)[None])[0]
    return float(mesh.areas[mesh.normals @ up > 0].sum() / mesh.area)


@dataclass(frozen=True, eq=False)
class GraphSurface:
    """Quintic spline z(x, y) over the mean plane, close to the vertices and with little energy.

    It minimises Σ |z − z_k|² + λ ∫ |∂³z|² + |∂²z|² / L², with λ such that waves shorter than 2π · `smoothing` edge
    lengths vanish. Beyond the boundary curvature dies away over the length L, `decay` diagonals, as in a thin plate;
    with the plate's energy alone it would vanish at the boundary already. The continuation is `margin` diagonals
    wide; after that the surface runs on straight. Raises Infeasible where the mesh is no graph: where more than the share
    `steep` of it faces away from the mean plane.
    """

    mesh: ReferenceMesh
    margin: float = 0.15
    smoothing: float = 0.4
    decay: float = 0.2
    steep: float = 1e-4

    def __post_init__(self):
        share = facing_up(self.mesh)
        if share < 1 - self.steep:
            raise Infeasible(f"{100 * (1 - share):.2g} % of the surface faces away from its mean plane (limit "
                             f"{100 * self.steep:g} %), so it is no graph over it; give a flatter part of it, or a mesh "
                             "with less noise")

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return self.mesh.diagonal

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Points (N, 3) moved onto the surface along the normal of the mean plane."""
        plane = self.to_plane(points)[:, :2]
        height, slopes, hessians = self.heights(plane)
        normals, bending = monge(slopes, hessians)
        return SurfacePoints(self.to_space(np.concatenate([plane, height[:, None]], axis=1)), normals @ self.frame,
                             self.frame.T @ bending @ self.frame, self.is_over(plane))

    def is_over(self, plane: np.ndarray) -> np.ndarray:
        """Mask (N,) of the points (N, 2) of the mean plane that lie under the mesh."""
        return self._outline.inside(np.concatenate([plane, np.zeros((len(plane), 1))], axis=1))

    def at(self, places: np.ndarray) -> SurfacePoints:
        """The surface over points (N, 2) of the mean plane."""
        return self.project(self.to_space(np.column_stack([places, np.zeros(len(places))])))

    def heights(self, plane: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """z (N,), first derivatives (2, N) and second ones (3, N) at points (N, 2) of the mean plane."""
        low, high = self.domain
        held = np.clip(plane, low, high)
        z, zx, zy, zxx, zxy, zyy = (self._spline(held, nu=nu)
                                    for nu in ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)))
        slopes = np.stack([zx, zy])
        return z + dot(plane - held, slopes.T), slopes, np.stack([zxx, zxy, zyy])

    def to_plane(self, points: np.ndarray) -> np.ndarray:
        """Coordinates (N, 3) in the frame of the mean plane."""
        return (points - self.origin) @ self.frame.T

    def to_space(self, coordinates: np.ndarray) -> np.ndarray:
        """Points (N, 3) from coordinates in the frame of the mean plane."""
        return self.origin + coordinates @ self.frame

    @cached_property
    def origin(self) -> np.ndarray:
        """Centre of the vertices."""
        return self.mesh.vertices.mean(axis=0)

    @cached_property
    def frame(self) -> np.ndarray:
        """Rows: the long and the short direction in the mean plane, and its normal."""
        up = unit(self.mesh.face_vectors.sum(axis=0)[None])[0]
        gap = self.mesh.vertices - self.origin
        gap = gap - np.outer(gap @ up, up)
        x = np.linalg.eigh(gap.T @ gap)[1][:, 2]
        x = unit((x - (x @ up) * up)[None])[0]
        if ((gap @ x) ** 3).sum() < 0:  # towards the longer tail, so that turned copies get turned frames
            x = -x
        return np.stack([x, np.cross(up, x), up])

    @cached_property
    def domain(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corner (2,) of the rectangle on which the spline lives."""
        plane = self._plane
        margin = self.margin * self._extent
        return plane[:, :2].min(axis=0) - margin, plane[:, :2].max(axis=0) + margin

    @cached_property
    def deviation(self) -> float:
        """Largest distance of a vertex from the surface, to first order."""
        height, slopes, _ = self.heights(self._plane[:, :2])
        return float((np.abs(height - self._plane[:, 2]) / np.sqrt(1 + (slopes**2).sum(axis=0))).max())

    @cached_property
    def _extent(self) -> float:
        """Diagonal of the box in the frame of the mean plane, which turns with the mesh."""
        return float(np.linalg.norm(np.ptp(self._plane, axis=0)))

    @cached_property
    def _plane(self) -> np.ndarray:
        return self.to_plane(self.mesh.vertices)

    @cached_property
    def _outline(self) -> Outline:
        return Outline(ReferenceMesh(self._plane * [1, 1, 0], self.mesh.triangles))

    @cached_property
    def _spline(self) -> NdBSpline:
        low, high = self.domain
        spacing = max(self.mesh.edge_length, float((high - low).max()) / MAX_CELLS)
        density = len(self._plane) / self._outline.mesh.area
        strength = density * (self.smoothing * self.mesh.edge_length) ** 6
        return smoothing_spline(self._plane[:, :2], self._plane[:, 2], low, high, spacing, strength,
                                (self.decay * self._extent) ** -2)

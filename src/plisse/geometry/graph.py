"""Smooth graphs over the mean plane of a mesh, continued beyond its boundary like a thin plate."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import BSpline, NdBSpline
from scipy.sparse import csc_array, csr_array, kron
from scipy.sparse.linalg import splu

from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.monge import monge
from plisse.geometry.outline import Outline
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.vectors import dot, unit

__all__ = ["GraphSurface", "facing_up"]

DEGREE = 5
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
    wide; after that the surface runs on straight. Raises Infeasible where the mesh is no graph.
    """

    mesh: ReferenceMesh
    margin: float = 0.15
    smoothing: float = 0.4
    decay: float = 0.2

    def __post_init__(self):
        share = facing_up(self.mesh)
        if share < 0.9999:
            raise Infeasible(f"{100 * (1 - share):.2g} % of the surface faces away from its mean plane, so it is no "
                             "graph over it")

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return self.mesh.diagonal

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Points (N, 3) moved onto the surface along the normal of the mean plane."""
        plane = self.to_plane(points)[:, :2]
        height, slopes, hessians = self.heights(plane)
        normals, bending = monge(slopes, hessians)
        inside = self._outline.inside(np.concatenate([plane, np.zeros((len(plane), 1))], axis=1))
        return SurfacePoints(self.to_space(np.concatenate([plane, height[:, None]], axis=1)), normals @ self.frame,
                             self.frame.T @ bending @ self.frame, inside)

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
        return np.stack([x, np.cross(up, x), up])

    @cached_property
    def domain(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corner (2,) of the rectangle on which the spline lives."""
        plane = self._plane
        margin = self.margin * self.diagonal
        return plane[:, :2].min(axis=0) - margin, plane[:, :2].max(axis=0) + margin

    @cached_property
    def deviation(self) -> float:
        """Largest distance of a vertex from the surface, to first order."""
        height, slopes, _ = self.heights(self._plane[:, :2])
        return float((np.abs(height - self._plane[:, 2]) / np.sqrt(1 + (slopes**2).sum(axis=0))).max())

    @cached_property
    def _plane(self) -> np.ndarray:
        return self.to_plane(self.mesh.vertices)

    @cached_property
    def _outline(self) -> Outline:
        return Outline(ReferenceMesh(self._plane * [1, 1, 0], self.mesh.triangles))

    @cached_property
    def _spline(self) -> NdBSpline:
        low, high = self.domain
        edge = self._outline.mesh.edge_length
        spacing = max(edge, float((high - low).max()) / MAX_CELLS)
        one, two = (_Axis(a, b, max(3, int(np.ceil((b - a) / spacing)))) for a, b in zip(low, high, strict=True))
        plane, z = self._plane[:, :2], self._plane[:, 2]
        rows = _row_products(one.values(plane[:, 0]), two.values(plane[:, 1]))
        energy = _energy(one, two, (self.decay * self.diagonal) ** -2)
        density = len(z) / self._outline.mesh.area
        strength = density * (self.smoothing * edge) ** 6
        system = csc_array(rows.T @ rows + strength * energy)
        factor = splu(system, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True})
        right = rows.T @ z
        solution = factor.solve(right)
        solution += factor.solve(right - system @ solution)
        coefficients = solution.reshape(one.count, two.count)
        return NdBSpline((one.knots, two.knots), coefficients, DEGREE, extrapolate=True)


@dataclass(frozen=True)
class _Axis:
    """Uniform B-splines on [low, high] with `cells` knot spans."""

    low: float
    high: float
    cells: int

    @property
    def count(self) -> int:
        return self.cells + DEGREE

    @property
    def knots(self) -> np.ndarray:
        return self.low + (self.high - self.low) / self.cells * np.arange(-DEGREE, self.cells + DEGREE + 1)

    def values(self, at: np.ndarray) -> csr_array:
        return csr_array(BSpline.design_matrix(np.clip(at, self.low, self.high), self.knots, DEGREE))

    def energies(self) -> list[csr_array]:
        """Gram matrices of the splines and of their derivatives up to the third, by Gauss's rule."""
        node, weight = np.polynomial.legendre.leggauss(DEGREE + 1)
        size = (self.high - self.low) / self.cells
        at = (self.low + size * (np.arange(self.cells)[:, None] + 0.5 * (node + 1))).ravel()
        root = np.sqrt(0.5 * size * np.tile(weight, self.cells))[:, None]
        basis = BSpline(self.knots, np.eye(self.count), DEGREE)
        grams = []
        for order in range(4):
            values = csr_array(root * basis(at, nu=order))
            grams.append(csr_array(values.T @ values))
        return grams


def _energy(one: _Axis, two: _Axis, plate: float) -> csr_array:
    """∫ |∂³z|² + plate |∂²z|² as a quadratic form in the spline coefficients."""
    x, y = one.energies(), two.energies()
    third = kron(x[3], y[0]) + 3 * kron(x[2], y[1]) + 3 * kron(x[1], y[2]) + kron(x[0], y[3])
    second = kron(x[2], y[0]) + 2 * kron(x[1], y[1]) + kron(x[0], y[2])
    return csr_array(third + plate * second)


def _row_products(one: csr_array, two: csr_array) -> csr_array:
    """Rows r of the result are kron(one[r], two[r]); every row has DEGREE + 1 entries."""
    count, width = one.shape[0], DEGREE + 1
    a, b = one.indices.reshape(count, width, 1), two.indices.reshape(count, 1, width)
    values = one.data.reshape(count, width, 1) * two.data.reshape(count, 1, width)
    columns = a.astype(np.int64) * two.shape[1] + b
    return csr_array((values.ravel(), columns.ravel(), np.arange(count + 1) * width**2),
                     shape=(count, one.shape[1] * two.shape[1]))

"""Smooth surfaces through meshes: cubic jets at the vertices, blended into one C² implicit function."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.jet_fit import fitted_jets
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.outline import Outline
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.vectors import dot, norm

__all__ = ["JetSurface"]

OVERLAP = 40  # jets that may reach one vertex
MARGIN = 0.03  # share of the reach by which a point may move before its neighbours are looked up again
AT_MOST = 64  # jets that may reach any point
BLENDED = 250  # points treated at once: what fits into a processor's cache


@dataclass(frozen=True, eq=False)
class JetSurface:
    """The mesh as zero set of f = Σ w_i f_i / Σ w_i, f_i the height over the cubic fitted about vertex i.

    Cubics are fitted over `radius` edge lengths, the Wendland weights w_i reach over `reach` of them (both adapt to
    the local density), so that f is C² and of third order in the edge length, its bending of second order.
    """

    mesh: ReferenceMesh
    radius: float = 3.0
    reach: float = 2.2

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return self.mesh.diagonal

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Points (N, 3) moved onto the surface along the gradient of f; from afar by way of the nearest vertex."""
        points = np.array(points, dtype=float)
        starts = range(0, max(len(points), 1), BLENDED)
        parts = [self._project(points[i:i + BLENDED]) for i in starts]
        positions, normals, bending = (np.concatenate(field) for field in zip(*parts, strict=True))
        return SurfacePoints(positions, normals, bending, self._outline.inside(positions))

    def _project(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        distance, nearest = self._tree.query(points)
        points = np.where((distance > 0.5 * self._reaches[nearest])[:, None], self._drawn_in(points, nearest), points)
        near, moved = self._near(points), 0.0
        for _ in range(12):
            value, gradient, _ = self._blend(points, near, bending=False)
            step = (value / dot(gradient, gradient))[:, None] * gradient
            points = points - step
            size = np.abs(step).max(initial=0) / self.mesh.edge_length
            moved += size
            if moved > MARGIN / 3:
                near, moved = self._near(points), 0.0
            if not size > 1e-7:  # Newton doubles the digits: the error left is about the square
                break
        return points, *self._shape(points, near)

    def _drawn_in(self, points: np.ndarray, nearest: np.ndarray) -> np.ndarray:
        """Points too far away for the blend, taken to the nearest vertex plus a bounded tangential remainder."""
        normal = self._frames[nearest, 2]
        gap = points - self.mesh.vertices[nearest]
        gap = gap - dot(gap, normal)[:, None] * normal
        limit = 0.5 * self._reaches[nearest]
        return self.mesh.vertices[nearest] + gap * np.minimum(1, limit / np.maximum(norm(gap), 1e-300))[:, None]

    def _shape(self, points: np.ndarray, near: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        _, gradient, hessian = self._blend(points, near, bending=True)
        size = norm(gradient)[:, None]
        normals = gradient / size
        tangent = np.eye(3) - normals[:, :, None] * normals[:, None, :]
        return normals, -tangent @ (hessian / size[:, :, None]) @ tangent

    def _near(self, points: np.ndarray) -> np.ndarray:
        """Vertices (N, K) whose jets reach the points or almost do, K as small as these points allow."""
        distance, near = self._tree.query(points, k=self._overlap)
        needed = np.flatnonzero((distance < (1 + MARGIN) * self._reaches[near]).any(axis=0))
        return near[:, :needed[-1] + 1 if len(needed) else 1]

    def _blend(self, points: np.ndarray, near: np.ndarray, bending: bool):
        """f (N,) and its gradient (N, 3); with `bending` the blended Hessians (N, 3, 3) of the jets as well.

        The Hessian leaves out derivatives of the weights: they only multiply differences between neighbouring jets.
        """
        gap = points[:, None] - self.mesh.vertices[near]
        distance = norm(gap)
        reach = self._reaches[near]
        ratio = np.minimum(distance / reach, 1.0)
        weight = (1 - ratio) ** 4 * (4 * ratio + 1)
        total = np.maximum(weight.sum(axis=1), 1e-300)
        weight /= total[:, None]
        frames, scale = self._frames[near], self._radii[near]
        x, y, z = np.moveaxis(np.einsum("nkij,nkj->nki", frames, gap), -1, 0) / scale
        c = np.moveaxis(self._jets[near], -1, 0)
        height = (c[0] + x * (c[1] + x * (c[3] + c[6] * x) + y * (c[4] + c[7] * x + c[8] * y))
                  + y * (c[2] + y * (c[5] + c[9] * y)))
        hx = c[1] + 2 * c[3] * x + c[4] * y + 3 * c[6] * x**2 + 2 * c[7] * x * y + c[8] * y**2
        hy = c[2] + c[4] * x + 2 * c[5] * y + c[7] * x**2 + 2 * c[8] * x * y + 3 * c[9] * y**2
        value = (z - height) * scale
        mean = np.einsum("nk,nk->n", weight, value)
        slope = -20 * ratio * (1 - ratio) ** 3 / (reach * total[:, None]) * (value - mean[:, None])
        slope /= np.maximum(distance, 1e-300)
        gradient = np.einsum("nk,nkj->nj", slope, gap)
        for axis, factor in enumerate((-weight * hx, -weight * hy, weight)):
            gradient += np.einsum("nk,nkj->nj", factor, frames[:, :, axis])
        if not bending:
            return mean, gradient, None
        weight = -weight / scale
        hxx = weight * (2 * c[3] + 6 * c[6] * x + 2 * c[7] * y)
        hxy = weight * (c[4] + 2 * c[7] * x + 2 * c[8] * y)
        hyy = weight * (2 * c[5] + 2 * c[8] * x + 6 * c[9] * y)
        along, across = frames[:, :, 0], frames[:, :, 1]
        one = hxx[..., None] * along + hxy[..., None] * across
        two = hxy[..., None] * along + hyy[..., None] * across
        return mean, gradient, one.swapaxes(1, 2) @ along + two.swapaxes(1, 2) @ across

    @cached_property
    def _tree(self) -> cKDTree:
        return cKDTree(self.mesh.vertices)

    @cached_property
    def _outline(self) -> Outline:
        return Outline(self.mesh)

    @cached_property
    def _spacing(self) -> np.ndarray:
        """Local edge length (V,): never below the mean, larger where vertices are sparse."""
        count = len(self.mesh.vertices)
        sparse = self._tree.query(self.mesh.vertices, k=min(15, count))[0][:, -1] / 2.2
        longest = np.zeros(count)
        np.maximum.at(longest, self.mesh.edges.ravel(), np.repeat(self.mesh.edge_lengths, 2))
        return np.maximum.reduce([sparse, 0.6 * longest, np.full(count, self.mesh.edge_length)])

    @cached_property
    def _radii(self) -> np.ndarray:
        return self.radius * self._spacing

    @cached_property
    def _reaches(self) -> np.ndarray:
        """Reach of every jet's weight (V,), cut where too many vertices crowd together."""
        farthest = self._tree.query(self.mesh.vertices, k=min(OVERLAP, len(self.mesh.vertices)))[0][:, -1]
        return np.minimum(self.reach * self._spacing, 0.85 * farthest)

    @cached_property
    def _overlap(self) -> int:
        """How many nearest vertices have to be looked at so that none whose jet reaches the point is missed."""
        places = np.concatenate([self.mesh.corners.mean(axis=1), self.mesh.vertices])
        distance, near = self._tree.query(places, k=min(AT_MOST, len(self.mesh.vertices)))
        return int(np.flatnonzero((distance < 1.1 * self._reaches[near]).any(axis=0))[-1]) + 1

    @cached_property
    def _fit(self) -> tuple[np.ndarray, np.ndarray]:
        return fitted_jets(self.mesh.vertices, self.mesh.vertex_normals, self._radii, self._tree)

    @property
    def _jets(self) -> np.ndarray:
        return self._fit[0]

    @property
    def _frames(self) -> np.ndarray:
        return self._fit[1]

"""On which side of a mesh's boundary a point lies."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import dot, norm, unit

__all__ = ["Outline"]

NEAREST = 4


@dataclass(frozen=True, eq=False)
class Outline:
    """Boundary of a mesh with directions pointing away from the surface.

    A point is outside where it lies beyond its closest boundary segment; at boundary vertices the mean of the two
    segments' directions decides, which is exact in the plane.
    """

    mesh: ReferenceMesh

    @cached_property
    def _segments(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Start, edge vector and outward direction (S, 3) of every segment, and those at its two ends (S, 2, 3)."""
        half = self.mesh.boundary
        start, end = self.mesh.half_edges[half].T
        origin, along = self.mesh.vertices[start], self.mesh.vertices[end] - self.mesh.vertices[start]
        outward = unit(np.cross(along, self.mesh.normals[half // 3]))
        total = np.zeros_like(self.mesh.vertices)
        np.add.at(total, start, outward)
        np.add.at(total, end, outward)
        return origin, along, outward, np.stack([total[start], total[end]], axis=1)

    @cached_property
    def _samples(self) -> tuple[cKDTree, np.ndarray]:
        """Points along all segments, no two further apart than half an edge, and the segment of each."""
        origin, along, *_ = self._segments
        pieces = np.maximum(2, np.ceil(2 * norm(along) / self.mesh.edge_length)).astype(int)
        owner = np.repeat(np.arange(len(pieces)), pieces)
        place = np.arange(len(owner)) - np.repeat(np.cumsum(pieces) - pieces, pieces)
        fraction = (place + 0.5) / pieces[owner]
        return cKDTree(origin[owner] + fraction[:, None] * along[owner]), owner

    def beyond(self, points: np.ndarray) -> np.ndarray:
        """Signed distances (N,) from the boundary: positive outside, −∞ for surfaces without boundary."""
        if len(self.mesh.boundary) == 0:
            return np.full(len(points), -np.inf)
        origin, along, outward, at_ends = self._segments
        tree, owner = self._samples
        near = owner[tree.query(points, k=min(NEAREST, tree.n))[1]].reshape(len(points), -1)
        gap = points[:, None] - origin[near]
        fraction = np.clip(dot(gap, along[near]) / dot(along[near], along[near]), 0, 1)
        foot = gap - fraction[..., None] * along[near]
        rows, best = np.arange(len(points)), np.argmin(dot(foot, foot), axis=1)
        segment, fraction, foot = near[rows, best], fraction[rows, best], foot[rows, best]
        side = np.where((fraction <= 0)[:, None], at_ends[segment, 0],
                        np.where((fraction >= 1)[:, None], at_ends[segment, 1], outward[segment]))
        return np.where(dot(foot, side) > 0, 1.0, -1.0) * norm(foot)

    def inside(self, points: np.ndarray) -> np.ndarray:
        """Whether points (N, 3) on or near the surface lie within its boundary, up to 1e-9 of the diagonal."""
        return self.beyond(points) <= 1e-9 * self.mesh.diagonal

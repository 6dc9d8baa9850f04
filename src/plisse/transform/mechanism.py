"""A principal structure as a mechanism: folded states placed face by face from the flat sheet (§2.5).

All fold angles change by tan(φ/2) → λ tan(φ/2) with one factor λ. As a quaternion (cos φ/2, sin φ/2 · edge) a fold of
the state λ = tan μ is (cos μ cos φ/2, sin μ sin φ/2 · edge), normalised: no angle is computed, and λ = ∞ is no exception.
Faces are turned along a tree that starts in the middle, all states at the same time, none from another.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from scipy.sparse import csr_array, hstack

from plisse.geometry.vectors import dot, unit
from plisse.measure.planarity import face_normals
from plisse.structure.face_tree import FaceTree, face_tree
from plisse.structure.topology import Topology

__all__ = ["FLAT_FOLDED", "Mechanism", "turning"]

FLAT_FOLDED = 200.0
UNFOLDED = 1e-9
PATCH = 4
TOGETHER = 2_000_000


@dataclass(frozen=True, eq=False)
class Mechanism:
    """A simply connected topology, its sheet `flat` (V, 2), and the state `designed` (V, 3) that has λ = 1."""

    topology: Topology
    flat: np.ndarray
    designed: np.ndarray

    def states(self, percent: np.ndarray) -> np.ndarray:
        """Vertices (K, V, 3) at percent (K,), the faces in the middle held where the designed state has them."""
        percent = np.asarray(percent, dtype=float)
        together = max(1, TOGETHER // self.topology.face_count)
        parts = [self._states(percent[k:k + together]) for k in range(0, len(percent), together)]
        return np.concatenate(parts) if parts else np.empty((0, *self.designed.shape))

    def _states(self, percent: np.ndarray) -> np.ndarray:
        columns, shift = self._placed_faces(turning(percent))
        parts = [self._gather @ np.concatenate([*columns[:, axis], shift[axis]]) for axis in range(3)]
        vertices = np.stack(parts, axis=-1).swapaxes(0, 1)
        vertices = _registered(vertices, self.designed, self._patch)
        vertices[:, self._unused] = self.designed[self._unused]
        return vertices

    def _placed_faces(self, turn: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Images (2, 3, F, K) of both axes of the sheet, and of its origin (3, F, K), under the motion of each face."""
        count, states = self.topology.face_count, turn.shape[1]
        spin = np.zeros((4, count, states))
        columns, shift = np.empty((2, 3, count, states)), np.zeros((3, count, states))
        spin[0, self._tree.root] = 1.0
        columns[:, :, self._tree.root] = np.eye(3)[:2, :, None]
        for level, hinge in zip(self._tree.levels, self._hinges, strict=True):
            child = _turned(spin[:, level.parent], *hinge.folded(turn))
            spin[:, level.child] = child
            axes = _axes(child)
            before = columns[:, :, level.parent] - axes
            columns[:, :, level.child] = axes
            at = hinge.middle[:, None, :, None]
            shift[:, level.child] = shift[:, level.parent] + at[0] * before[0] + at[1] * before[1]
        return columns, shift

    @cached_property
    def _tree(self) -> FaceTree:
        return face_tree(self.topology)

    @cached_property
    def _sheet(self) -> np.ndarray:
        """The flat vertices (V, 2) around the middle face, where coordinates are small."""
        return self.flat - self.flat[self.topology.faces[self._tree.root]].mean(axis=0)

    @cached_property
    def _hinges(self) -> list["_Hinge"]:
        corners, normals = self.topology.corners, face_normals(self.topology, self.designed)
        hinges = []
        for level in self._tree.levels:
            a, b = corners.vertex[level.at_parent], corners.next[level.at_parent]
            edge = unit(self.designed[b] - self.designed[a])
            first, second = normals[level.parent], normals[level.child]
            half = 0.5 * np.arctan2(dot(np.cross(first, second), edge), dot(first, second))
            sine = np.where(np.abs(half) < UNFOLDED, 0.0, np.sin(half))
            middle, along = 0.5 * (self._sheet[a] + self._sheet[b]), unit(self._sheet[b] - self._sheet[a])
            hinges.append(_Hinge(middle.T, along.T, np.cos(half), sine))
        return hinges

    @cached_property
    def _gather(self) -> csr_array:
        """Matrix (V, 3F) that takes both axes and the origin of all faces to the vertices, mean over the faces there."""
        corners, shape = self.topology.corners, (self.topology.vertex_count, self.topology.face_count)
        share = 1.0 / np.bincount(corners.vertex, minlength=shape[0]).clip(1)[corners.vertex]
        x, y = self._sheet[corners.vertex].T
        return csr_array(hstack([csr_array((share * value, (corners.vertex, corners.face)), shape=shape)
                                 for value in (x, y, np.ones(len(share)))]))

    @cached_property
    def _patch(self) -> np.ndarray:
        """Vertices of the faces near the middle one."""
        near = np.concatenate([[self._tree.root], *(level.child for level in self._tree.levels[:PATCH])])
        corners = self.topology.corners
        return np.unique(corners.vertex[np.isin(corners.face, near)])

    @cached_property
    def _unused(self) -> np.ndarray:
        return np.setdiff1d(np.arange(self.topology.vertex_count), self.topology.corners.vertex)


class _Hinge(NamedTuple):
    """Edges (N,) of a level in the sheet: midpoints and directions (2, N), and cos φ/2, sin φ/2 as designed."""

    middle: np.ndarray
    along: np.ndarray
    cosine: np.ndarray
    sine: np.ndarray

    def folded(self, turn: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Quaternions (w, x, y), each (N, K), of the folds in the states with (cos μ, sin μ) = `turn` (2, K)."""
        w, s = self.cosine[:, None] * turn[0], self.sine[:, None] * turn[1]
        length = np.hypot(w, s)
        return w / length, s / length * self.along[0][:, None], s / length * self.along[1][:, None]


def turning(percent: np.ndarray) -> np.ndarray:
    """(cos μ, sin μ) (2, K) with λ = tan μ = tan(π percent / 400): 0 flat, 100 as designed, 200 folded flat."""
    angle = np.pi * np.asarray(percent, dtype=float) / (2 * FLAT_FOLDED)
    return np.stack([np.cos(angle), np.sin(angle)])


def _turned(spin: np.ndarray, w: np.ndarray, x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """Quaternions (4, N, K) times (w, x, y, 0)."""
    a, b, c, d = spin
    return np.stack([a * w - b * x - c * y, b * w + a * x - d * y, c * w + a * y + d * x, d * w + b * y - c * x])


def _axes(spin: np.ndarray) -> np.ndarray:
    """Images (2, 3, N, K) of the x and y axes under unit quaternions (4, N, K)."""
    w, x, y, z = spin
    return 2 * np.stack([np.stack([0.5 - y * y - z * z, x * y + w * z, x * z - w * y]),
                         np.stack([x * y - w * z, 0.5 - x * x - z * z, y * z + w * x])])


def _registered(states: np.ndarray, designed: np.ndarray, patch: np.ndarray) -> np.ndarray:
    """States (K, V, 3) moved rigidly so that the vertices of the patch are as near to the designed ones as can be."""
    centre, goal = states[:, patch].mean(axis=1, keepdims=True), designed[patch].mean(axis=0)
    covariance = np.einsum("kvi,vj->kij", states[:, patch] - centre, designed[patch] - goal)
    left, _, right = np.linalg.svd(covariance)
    left[:, :, 2] *= np.linalg.det(left @ right)[:, None]
    return (states - centre) @ (left @ right) + goal

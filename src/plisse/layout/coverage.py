"""Which quads of a net meet the reference, and how much of the reference lies under a structure."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from plisse.geometry.vectors import cross_flat, dot, norm, unit

__all__ = ["AreaSamples", "covered", "located", "reach_of"]

NEIGHBOURS = 12  # centres of quads among which the one that covers a point is sought
SLIMNESS = 4  # further centres per unit of length over width
MOST = 400


@dataclass(frozen=True, eq=False)
class AreaSamples:
    """Points (N, 3) spread evenly over triangles with the area each stands for and the triangle's unit normal."""

    points: np.ndarray
    areas: np.ndarray
    normals: np.ndarray

    @classmethod
    def of(cls, vertices: np.ndarray, triangles: np.ndarray, levels: int = 1) -> "AreaSamples":
        """Centres of the 4^levels similar parts of every triangle."""
        corners = vertices[triangles]
        for _ in range(levels):
            a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
            ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
            corners = np.concatenate([np.stack(part, axis=1)
                                      for part in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
        area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        return cls(corners.mean(axis=1), 0.5 * norm(area), unit(area))

    @property
    def total(self) -> float:
        """The whole area."""
        return float(self.areas.sum())


def located(samples: AreaSamples, quads: np.ndarray, reach: float) -> np.ndarray:
    """Quad (N,) of (Q, 4, 3) that the line through each sample along its normal meets within `reach`, −1 if none."""
    found = np.full(len(samples.points), -1)
    if len(quads) == 0:
        return found
    centres = quads.mean(axis=1)
    radius = norm(quads - centres[:, None]).max(axis=1)
    farthest = np.sqrt(radius.max() ** 2 + reach**2)
    candidates = cKDTree(centres).query(samples.points, k=_candidates(quads), distance_upper_bound=farthest)[1]
    x, y = _frames(samples.normals)
    for column in candidates.reshape(len(found), -1).T:
        open_ = np.flatnonzero((found < 0) & (column < len(centres)))
        away = centres[column[open_]] - samples.points[open_]
        height = dot(away, samples.normals[open_])
        near = (np.abs(height) < reach) & (dot(away, away) - height**2 <= radius[column[open_]] ** 2)
        open_ = open_[near]
        offset = quads[column[open_]] - samples.points[open_, None]
        plane = np.stack([np.einsum("nki,ni->nk", offset, axis[open_]) for axis in (x, y)], axis=-1)
        hit = _contains(plane[:, [0, 1, 2]]) | _contains(plane[:, [0, 2, 3]])
        found[open_[hit]] = column[open_[hit]]
    return found


def reach_of(amplitude: float, mean_edge: float) -> float:
    """How far from a reference a structure over it can be, in model units."""
    return 3 * amplitude + 3 * mean_edge


def covered(samples: AreaSamples, vertices: np.ndarray, quads: np.ndarray, reach: float) -> float:
    """Fraction of the sampled area that lies under quads (Q, 4) over vertices (V, 3), seen along the normals."""
    hit = located(samples, vertices[quads], reach) >= 0
    return float(samples.areas[hit].sum() / samples.total)


def _candidates(quads: np.ndarray) -> int:
    """How many quads have to be looked at: over long thin ones the centres of many others are nearer."""
    longest = norm(np.roll(quads, -1, axis=1) - quads).max(axis=1)
    area = 0.5 * norm(np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1]))
    slimness = float(np.quantile(longest**2 / np.maximum(area, 1e-9 * longest**2), 0.98))
    return min(int(NEIGHBOURS + SLIMNESS * slimness), MOST, len(quads))


def _frames(normals: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Two unit vectors (N, 3) each that span the planes orthogonal to normals (N, 3)."""
    axis = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    x = unit(np.cross(normals, axis))
    return x, np.cross(normals, x)


def _contains(triangles: np.ndarray) -> np.ndarray:
    """Whether triangles (N, 3, 2) contain the origin, whatever their orientation."""
    turns = np.stack([cross_flat(triangles[:, k], triangles[:, (k + 1) % 3]) for k in range(3)])
    return np.asarray((turns >= 0).all(axis=0) | (turns <= 0).all(axis=0))

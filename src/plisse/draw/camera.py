"""Where to look from: an orthographic view in which the shape and its pleats are well seen."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.vectors import unit
from plisse.measure.planarity import face_areas, face_normals
from plisse.structure.pleated import PleatedStructure

__all__ = ["Camera", "best_view"]

SAMPLES = 4000


@dataclass(frozen=True, eq=False)
class Camera:
    """Rows `axes` (3, 3): right, up and towards the viewer."""

    axes: np.ndarray

    def project(self, points: np.ndarray) -> np.ndarray:
        """Points (…, 3) in the camera's frame: x right, y up, z towards the viewer; lengths unchanged."""
        return points @ self.axes.T

    @classmethod
    def looking_from(cls, direction: np.ndarray, up: np.ndarray) -> "Camera":
        """Camera that looks against `direction` with `up` as vertical as can be."""
        towards = unit(direction)
        right = unit(np.cross(up, towards))
        return cls(np.stack([right, np.cross(towards, right), towards]))


def best_view(structure: PleatedStructure) -> Camera:
    """The camera, out of some seventy above and below the main plane, that shows most: see `_score`."""
    topology, vertices = structure.topology, structure.vertices
    areas, normals = face_areas(topology, vertices), face_normals(topology, vertices)
    every = max(1, topology.face_count // SAMPLES)
    chosen = np.arange(0, topology.face_count, every)
    centres = _centres(structure)[chosen]
    samples = centres, normals[chosen], areas[chosen]
    return max(_candidates(vertices), key=lambda camera: _score(camera, *samples))


def _centres(structure: PleatedStructure) -> np.ndarray:
    corners = structure.topology.corners
    count = np.bincount(corners.face)
    sums = [np.bincount(corners.face, structure.vertices[corners.vertex, k]) for k in range(3)]
    return np.stack(sums, axis=1) / count[:, None]


def _candidates(vertices: np.ndarray) -> list[Camera]:
    """Views that see the shape as if it lay on a table, its smallest extent upright."""
    _, axes = np.linalg.eigh(np.cov((vertices - vertices.mean(axis=0)).T))
    upright = axes[:, 0] * (1 if axes[2, 0] >= -1e-9 else -1)
    first = axes[:, 2]
    second = np.cross(upright, first)
    cameras = []
    for side in (1, -1):
        for elevation in np.radians([38, 48, 58, 68]):
            for azimuth in np.radians(np.arange(0, 360, 30) + 15):
                level = np.cos(azimuth) * first + np.sin(azimuth) * second
                direction = np.cos(elevation) * level + side * np.sin(elevation) * upright
                cameras.append(Camera.looking_from(direction, side * upright))
    return cameras


def _score(camera: Camera, centres: np.ndarray, normals: np.ndarray, areas: np.ndarray) -> float:
    """Area as seen times share of the paper seen times contrast of its light, with a little for wide pictures."""
    seen, facing = camera.project(centres), np.abs(camera.project(normals)[:, 2])
    cell = 1.6 * np.sqrt(areas.mean())
    index = np.floor((seen[:, :2] - seen[:, :2].min(axis=0)) / cell).astype(np.int64)
    key = index[:, 1] * (index[:, 0].max() + 1) + index[:, 0]
    front = np.full(key.max() + 1, -np.inf)
    np.maximum.at(front, key, seen[:, 2])
    in_front = seen[:, 2] > front[key] - 1.5 * cell
    visible = areas * facing * in_front
    turned = camera.project(normals)
    turned = turned * np.sign(turned[:, 2:])
    light = turned @ unit(np.array([-0.5, 0.6, 0.62]))
    mean = np.average(light, weights=visible + 1e-12)
    contrast = np.sqrt(np.average((light - mean) ** 2, weights=visible + 1e-12))
    width, height = np.ptp(seen[:, :2], axis=0)
    shown = visible.sum() / areas.sum()
    share = (areas * in_front * (facing > 0.12)).sum() / areas.sum()
    return float(shown * share * np.sqrt(0.05 + contrast) * (width / (width + height)) ** 0.25)

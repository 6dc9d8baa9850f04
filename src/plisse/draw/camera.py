"""Where to look from: an orthographic view in which the shape and its pleats are well seen."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plisse.geometry.vectors import dot, unit
from plisse.measure.planarity import face_areas, face_normals
from plisse.structure.pleated import PleatedStructure

__all__ = ["Camera", "best_view"]

SAMPLES = 3000
ELEVATIONS = (32, 40, 48, 56, 64)  # degrees above the table
VERTICAL, NEARLY = np.array([0.0, 0.0, 1.0]), np.cos(np.radians(35))
DEPTH = np.array([0.45, 0.3, 0.3])  # how much it counts that the longest, middle and smallest extent are seen
STANDING = 0.2  # and that what is above is above


@dataclass(frozen=True, eq=False)
class Camera:
    """Rows `axes` (3, 3): right, up and towards the viewer; `upright` (3,) is what stands orthogonal on the table."""

    axes: np.ndarray
    upright: np.ndarray | None = None

    def project(self, points: np.ndarray) -> np.ndarray:
        """Points (…, 3) in the camera's frame: x right, y up, z towards the viewer; lengths unchanged."""
        return points @ self.axes.T

    @property
    def elevation_degrees(self) -> float:
        """Angle in degrees from which the xy plane is seen from above, −90 to 90."""
        return float(np.degrees(np.arctan2(self.axes[2, 2], np.hypot(*self.axes[2, :2]))))

    @classmethod
    def looking_from(cls, direction: np.ndarray, up: np.ndarray) -> "Camera":
        """Camera that looks against `direction` with `up` as vertical as can be."""
        towards = unit(direction)
        right = unit(np.cross(up, towards))
        return cls(np.stack([right, np.cross(towards, right), towards]), unit(up))

    @classmethod
    def at(cls, azimuth: float, elevation: float) -> "Camera":
        """Camera at angles in radians: azimuth from the x axis around z, elevation above the xy plane."""
        level = np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
        towards = np.cos(elevation) * level + np.sin(elevation) * VERTICAL
        up = np.cos(elevation) * VERTICAL - np.sin(elevation) * level
        return cls(np.stack([np.cross(up, towards), up, towards]), VERTICAL)


def best_view(structure: PleatedStructure, others: Sequence[PleatedStructure] = ()) -> Camera:
    """The camera, out of some hundred above and below the main plane, that shows most: see `_score` and `_depth`.

    With `others` it is the one that shows the worst seen of all as well as can be, measured by their own best views.
    """
    axes = _main_axes(structure.vertices)
    cameras = _candidates(axes)
    scores = np.array([[_score(camera, *samples) for camera in cameras] for samples in map(_samples, (structure, *others))])
    scores *= [_depth(camera, axes) for camera in cameras]
    return cameras[int(np.argmax((scores / scores.max(axis=1, keepdims=True)).min(axis=0)))]


def _samples(structure: PleatedStructure) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (N, 3) spread over the faces, the normals there and the area that each stands for."""
    topology, vertices = structure.topology, structure.vertices
    areas, normals = face_areas(topology, vertices), face_normals(topology, vertices)
    quads = np.arange(0, len(topology.quads), max(1, len(topology.quads) // SAMPLES))
    side = int(np.clip(np.sqrt(SAMPLES / max(1, len(quads))), 1, 24))
    at = (np.arange(side) + 0.5) / side
    along, across = (share[..., None] for share in np.meshgrid(at, at))
    a, b, c, d = (vertices[topology.quads[quads, k]][:, None, None] for k in range(4))
    points = (1 - across) * ((1 - along) * a + along * b) + across * ((1 - along) * d + along * c)
    count = side * side
    hubs = np.arange(len(topology.quads), topology.face_count)
    middles = np.array([vertices[hub].mean(axis=0) for hub in topology.hubs]).reshape(-1, 3)
    faces = np.concatenate([np.repeat(quads, count), hubs])
    share = areas[faces] / np.concatenate([np.full(len(quads) * count, count), np.ones(len(hubs))])
    return np.concatenate([points.reshape(-1, 3), middles]), normals[faces], share


def _main_axes(vertices: np.ndarray) -> np.ndarray:
    """Orthonormal rows (3, 3): the longest, the middle and the smallest extent, which is vertical where it nearly is."""
    _, axes = np.linalg.eigh(np.cov((vertices - vertices.mean(axis=0)).T))
    upright = axes[:, 0] * (1 if axes[2, 0] >= -1e-9 else -1)
    upright = VERTICAL if upright[2] > NEARLY else upright
    first = unit(axes[:, 2] - dot(axes[:, 2], upright) * upright)
    return np.stack([first, np.cross(upright, first), upright])


def _candidates(axes: np.ndarray) -> list[Camera]:
    """Views that see the shape as if it lay on a table, its smallest extent upright."""
    first, second, upright = axes
    cameras = []
    for side in (1, -1):
        for elevation in np.radians(ELEVATIONS):
            for azimuth in np.radians(np.arange(0, 360, 30) + 15):
                level = np.cos(azimuth) * first + np.sin(azimuth) * second
                direction = np.cos(elevation) * level + side * np.sin(elevation) * upright
                cameras.append(Camera.looking_from(direction, side * upright))
    return cameras


def _depth(camera: Camera, axes: np.ndarray) -> float:
    """Near 0 where one of the main extents is seen end-on, largest where all three are; more where up is above."""
    seen = 1 - (axes @ camera.axes[2]) ** 2  # squares of how long each axis appears
    is_above = camera.upright is None or camera.upright[2] > -1e-9
    return float(np.prod(seen**DEPTH) * (1 + STANDING * is_above))


def _score(camera: Camera, points: np.ndarray, normals: np.ndarray, areas: np.ndarray) -> float:
    """Area as seen times share of the paper seen; more for contrast, the front side and wide pictures."""
    seen, facing = camera.project(points), np.abs(camera.project(normals)[:, 2])
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
    bright = visible[camera.project(normals)[:, 2] > 0].sum() / (visible.sum() + 1e-300)
    bonus = (1 + 0.25 * bright) * np.sqrt(0.05 + contrast) * (width / (width + height)) ** 0.5
    return float(shown * share * bonus)

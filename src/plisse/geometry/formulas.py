"""Surfaces by formula: sphere, cylinder, cone, torus and height fields, all with exact bending."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.height_field import HeightField
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.vectors import dot, norm, unit

__all__ = ["Cone", "Cylinder", "HeightField", "Sphere", "Torus"]

UP = np.array([0.0, 0.0, 1.0])
EDGE = 1e-9  # relative width by which points on a boundary may lie outside


@dataclass(frozen=True)
class Sphere:
    """Sphere about the origin, normals outward; `cap` is the angle from the z axis up to which it is there."""

    radius: float
    cap: float = np.pi

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        half = self.radius * (np.sin(self.cap) if self.cap < np.pi / 2 else 1.0)
        return float(np.sqrt(8 * half**2 + (self.radius * (1 - np.cos(self.cap))) ** 2))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Closest points; the centre goes nowhere in particular."""
        normals = _unit_or(points, UP)
        bending = -_tangent(normals) / self.radius
        angle = np.arctan2(np.hypot(normals[:, 0], normals[:, 1]), normals[:, 2])
        return SurfacePoints(self.radius * normals, normals, bending, angle <= self.cap * (1 + EDGE))

    def mesh(self, cells: int = 40) -> ReferenceMesh:
        """A whole sphere of subdivided icosahedron faces; a cap as a square grid bent into a disk."""
        if self.cap >= np.pi:
            from trimesh.creation import icosphere

            whole = icosphere(subdivisions=max(1, round(np.log2(cells / 4))), radius=self.radius)
            return ReferenceMesh(whole.vertices, whole.faces)
        u, v = np.meshgrid(*2 * [np.linspace(-1, 1, cells + 1)], indexing="ij")
        x, y = u * np.sqrt(1 - v**2 / 2), v * np.sqrt(1 - u**2 / 2)
        angle = self.cap * np.hypot(x, y)
        across = np.divide(np.sin(angle), np.hypot(x, y), out=np.zeros_like(x), where=angle > 0)
        return grid_mesh(self.radius * np.stack([across * x, across * y, np.cos(angle)], axis=-1))


@dataclass(frozen=True)
class Cylinder:
    """Circular cylinder about the z axis, |z| ≤ height / 2, normals outward."""

    radius: float
    height: float

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return float(np.sqrt(8 * self.radius**2 + self.height**2))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Closest points of the endless cylinder."""
        normals = _radial(points)
        around = np.cross(UP, normals)
        positions = self.radius * normals + points[:, 2:] * UP
        known = np.abs(points[:, 2]) <= 0.5 * self.height * (1 + EDGE)
        return SurfacePoints(positions, normals, -_square(around) / self.radius, known)

    def mesh(self, cells: int = 40) -> ReferenceMesh:
        """Closed ring of cells about as long as high."""
        turn, z = _ring(cells), np.linspace(-self.height / 2, self.height / 2, _steps(cells, self.height, self.radius))
        turn, z = np.meshgrid(turn, z, indexing="ij")
        return grid_mesh(np.stack([self.radius * np.cos(turn), self.radius * np.sin(turn), z], axis=-1), (True, False))


@dataclass(frozen=True)
class Cone:
    """Cone about the z axis with its tip in the origin, opening upward by `half_angle`; slant lengths low … high."""

    half_angle: float
    low: float
    high: float

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        rise = (self.high - self.low) * np.cos(self.half_angle)
        return float(np.sqrt(8 * (self.high * np.sin(self.half_angle)) ** 2 + rise**2))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Closest points of the endless cone; nan in its tip."""
        radial = _radial(points)
        sine, cosine = np.sin(self.half_angle), np.cos(self.half_angle)
        ray = sine * radial + cosine * UP
        slant = dot(points, ray)
        slant = np.where(slant > 0, slant, np.nan)
        normals = cosine * radial - sine * UP
        bending = -_square(np.cross(UP, radial)) * (cosine / (slant * sine))[:, None, None]
        known = (slant >= self.low * (1 - EDGE)) & (slant <= self.high * (1 + EDGE))
        return SurfacePoints(slant[:, None] * ray, normals, bending, known)

    def mesh(self, cells: int = 40) -> ReferenceMesh:
        """Closed ring of cells between the two rims."""
        steps = _steps(cells, self.high - self.low, self.high * np.sin(self.half_angle))
        slant = np.linspace(self.low, self.high, steps)
        turn, slant = np.meshgrid(_ring(cells), slant, indexing="ij")
        across = slant * np.sin(self.half_angle)
        return grid_mesh(np.stack([across * np.cos(turn), across * np.sin(turn), slant * np.cos(self.half_angle)],
                                  axis=-1), (True, False))


@dataclass(frozen=True)
class Torus:
    """Torus about the z axis: tube of radius `r` around the circle of radius `R`, normals outward."""

    R: float
    r: float

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return float(2 * np.sqrt(2 * (self.R + self.r) ** 2 + self.r**2))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Closest points."""
        radial = _radial(points)
        normals = _unit_or(points - self.R * radial, UP)
        outward = dot(normals, radial)
        around = np.cross(UP, radial)
        bending = (-_square(np.cross(around, normals)) / self.r
                   - _square(around) * (outward / (self.R + self.r * outward))[:, None, None])
        return SurfacePoints(self.R * radial + self.r * normals, normals, bending, np.ones(len(points), bool))

    def mesh(self, cells: int = 40) -> ReferenceMesh:
        """Grid that is closed both ways, with `cells` cells around the tube."""
        turn, tube = np.meshgrid(_ring(max(6, round(cells * self.R / self.r / 2) * 2)), _ring(cells), indexing="ij")
        across = self.R + self.r * np.cos(tube)
        return grid_mesh(np.stack([across * np.cos(turn), across * np.sin(turn), self.r * np.sin(tube)], axis=-1),
                         (True, True))


def _ring(count: int) -> np.ndarray:
    return 2 * np.pi / count * np.arange(count)


def _steps(cells: int, length: float, radius: float) -> int:
    """Points along `length` when `cells` cells of the same size go around the radius."""
    return max(4, round(length * cells / (2 * np.pi * radius))) + 1


def _tangent(normals: np.ndarray) -> np.ndarray:
    return np.eye(3) - _square(normals)


def _square(vectors: np.ndarray) -> np.ndarray:
    """Dyads v ⊗ v (N, 3, 3)."""
    return vectors[:, :, None] * vectors[:, None, :]


def _radial(points: np.ndarray) -> np.ndarray:
    """Unit vectors pointing away from the z axis."""
    return _unit_or(points * [1, 1, 0], np.array([1.0, 0, 0]))


def _unit_or(vectors: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    """Directions, `otherwise` for zero vectors."""
    return np.where((norm(vectors) > 0)[:, None], unit(vectors), otherwise)

"""Smooth curves by few coefficients: Legendre series along open creases, Fourier series around closed ones.

A seed must be smooth up to its ends: splines and one-sided differences ripple the last edges, and the
march amplifies ripples. A series also is the same curve at every resolution.
"""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial.legendre import legder, legval, legvander

from plisse.geometry.components import cross, dot, unit

__all__ = ["SmoothCurve", "basis", "places"]


def places(samples: int, closed: bool, shift: float = 0.0) -> np.ndarray:
    """Parameters (samples,) of the vertices in [0, 1]; a shift of 0.5 gives edge midpoints."""
    if closed:
        return (np.arange(samples) + shift) / samples
    return (np.arange(samples - (shift > 0)) + shift) / (samples - 1)


def basis(terms: int, at: np.ndarray, closed: bool) -> np.ndarray:
    """Values (terms, k): Legendre polynomials of degree below `terms`, or 1, cos, sin, cos 2, sin 2, …"""
    if not closed:
        return legvander(2 * at - 1, terms - 1).T
    phases = 2 * np.pi * np.arange(1, (terms + 1) // 2 + 1)[:, None] * at
    waves = np.stack([np.cos(phases), np.sin(phases)], axis=1).reshape(-1, len(at))
    return np.concatenate([np.ones((1, len(at))), waves])[:terms]


@dataclass(frozen=True)
class SmoothCurve:
    """A curve with a reference field: coefficients (terms, 3) of both."""

    position: np.ndarray
    reference: np.ndarray
    closed: bool

    @classmethod
    def fitted(cls, points: np.ndarray, reference: np.ndarray, closed: bool,
               tolerance: float) -> "SmoothCurve":
        """Least squares through points (3, n) and a field (3, faces) at edge midpoints, with few terms."""
        count = points.shape[1]
        at, between = places(count, closed), places(count, closed, 0.5)
        position = _coefficients(points, at, closed, 4)
        for terms in range(12, min(28, count // 3) + 1, 4):
            position = _coefficients(points, at, closed, terms)
            if np.abs(position.T @ basis(len(position), at, closed) - points).max() < tolerance:
                break
        return cls(position, _coefficients(reference, between, closed, min(12, count // 3)), closed)

    def points(self, samples: int) -> np.ndarray:
        """Points (3, 1, samples)."""
        return self._at(self.position, places(samples, self.closed))

    def midpoint_reference(self, samples: int) -> np.ndarray:
        """Unit reference field (3, 1, faces) at edge midpoints."""
        return unit(self._at(self.reference, places(samples, self.closed, 0.5)))

    def normals(self, samples: int) -> tuple[np.ndarray, np.ndarray]:
        """Two unit fields (3, 1, samples) orthogonal to the curve: the reference, and tangent × reference."""
        at = places(samples, self.closed)
        tangent = unit(self._velocity(at))
        first = self._at(self.reference, at)
        first = unit(first - dot(first, tangent) * tangent)
        return first, cross(tangent, first)

    def _at(self, coefficients: np.ndarray, at: np.ndarray) -> np.ndarray:
        return (coefficients.T @ basis(len(coefficients), at, self.closed))[:, None]

    def _velocity(self, at: np.ndarray) -> np.ndarray:
        if not self.closed:
            return 2 * legval(2 * at - 1, legder(self.position))[:, None]
        slopes = np.zeros_like(self.position)
        order = 2 * np.pi * np.arange(1, (len(self.position) + 1) // 2)[:, None]
        slopes[1::2], slopes[2::2] = order * self.position[2::2], -order * self.position[1::2]
        return self._at(slopes, at)


def _coefficients(values: np.ndarray, at: np.ndarray, closed: bool, terms: int) -> np.ndarray:
    count = 2 * terms + 1 if closed else terms
    count = min(count, len(at) - 1 + len(at) % 2)
    return np.linalg.lstsq(basis(count, at, closed).T, values.T, rcond=None)[0]

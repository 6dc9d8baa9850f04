"""Coordinates from files: finite, of sensible size, and not all in one place."""

from pathlib import Path

import numpy as np

from plisse.errors import InvalidStructure

__all__ = ["checked_coordinates"]

LARGEST = 1e12


def checked_coordinates(vertices: np.ndarray, path: Path) -> np.ndarray:
    """The same vertices (V, d); raises InvalidStructure where they cannot be points of a mesh."""
    if not np.isfinite(vertices).all():
        bad = int(np.argmin(np.isfinite(vertices).all(axis=1)))
        raise InvalidStructure(f"vertex {bad + 1} of {path.name} has a coordinate that is not finite")
    largest = np.abs(vertices).max(initial=0.0)
    if largest > LARGEST:
        raise InvalidStructure(f"{path.name} has coordinates up to {largest:.1e}; scale it to lengths below {LARGEST:.0e}")
    if len(vertices) and np.ptp(vertices, axis=0).max() <= 1e-9 * max(largest, 1e-300):
        raise InvalidStructure(f"all vertices of {path.name} lie in one place; give a mesh with faces of some size")
    return vertices

"""What stands in the way of light: rays cast into triangles by embree, where it is installed."""

from functools import cache
from importlib.util import find_spec

import numpy as np

__all__ = ["Occluder", "can_cast", "fibonacci_sphere"]

CHUNK = 2_000_000


@cache
def can_cast() -> bool:
    """Whether rays can be cast at all: the extra `render` is installed."""
    return find_spec("embreex") is not None


class Occluder:
    """Triangles (T, 3, 3) that stop rays; raises MissingExtra without embree."""

    def __init__(self, triangles: np.ndarray):
        from plisse.extras import optional

        scene = optional("embreex.rtcore_scene", extra="render", purpose="pictures with cast rays")
        mesh = optional("embreex.mesh_construction", extra="render", purpose="pictures with cast rays")
        self._scene = scene.EmbreeScene(robust=True)
        mesh.TriangleMesh(self._scene, np.ascontiguousarray(triangles, np.float32))

    def blocked(self, origins: np.ndarray, directions: np.ndarray) -> np.ndarray:
        """Which of the rays (N, 3) meet a triangle (N,)."""
        hit = [self._scene.run(np.ascontiguousarray(origins[k:k + CHUNK], np.float32),
                               np.ascontiguousarray(directions[k:k + CHUNK], np.float32), query="OCCLUDED") >= 0
               for k in range(0, len(origins), CHUNK)]
        return np.concatenate(hit) if hit else np.zeros(0, bool)


def fibonacci_sphere(count: int) -> np.ndarray:
    """Unit vectors (count, 3), evenly spread; every k-th of them are well spread too."""
    index = np.arange(count)
    height, turn = 1 - (2 * index + 1) / count, np.pi * (3 - np.sqrt(5)) * index
    radius = np.sqrt(1 - height * height)
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), height], axis=1).astype(np.float32)

"""How far creases are from the curves that guide them."""

import numpy as np

from plisse.geometry.polyline import distance_to_polylines

__all__ = ["crease_deviation"]


def crease_deviation(creases: np.ndarray, guides: np.ndarray, closed: bool = False) -> np.ndarray:
    """Distances (m, n) of crease points (m, n, 3) from their guiding polylines (m, n', 3), in model units.

    Open guides are extended by their end tangents, so that sliding along a crease is no deviation.
    """
    return distance_to_polylines(creases, guides, closed)

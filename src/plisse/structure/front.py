"""The development as a sheet of paper on the table: front side up."""

import numpy as np

from plisse.errors import InvalidStructure
from plisse.geometry.vectors import cross_flat
from plisse.structure.pleated import PleatedStructure

__all__ = ["front_up"]


def front_up(structure: PleatedStructure) -> np.ndarray:
    """The development (V', 2) in model units, mirrored where needed so that faces run counterclockwise.

    Then mountains and valleys are as seen by the reader. Raises InvalidStructure when there is no
    development.
    """
    flat = structure.development
    if flat is None:
        raise InvalidStructure("the structure has no development yet; flatten it first")
    corners = structure.cut.topology.corners
    doubled_area = cross_flat(flat[corners.vertex], flat[corners.next]).sum()
    return flat if doubled_area >= 0 else flat * [-1.0, 1.0]

"""Pleated helicoids: the exact principal structures with helical symmetry (§2.3, left half of Fig. 7)."""

import numpy as np

from plisse.geometry.vectors import dot, unit
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure

__all__ = ["helical_pleats"]


def helical_pleats(creases: int = 9, columns: int = 61, *, radius: float = 30.0, pitch: float = 90.0, width: float = 5.0,
                   slope: float = 0.9, turns: float = 1.0) -> PleatedStructure:
    """Creases on coaxial helices of equal pitch, beginning at `radius` and going outward; exact, principal, free of solvers.

    One screw takes every column to the next. The rectifying plane of an edge contains it and is normal to the radius
    through its middle; it mirrors the face on one side into the face on the other, and rulings are where neighbouring
    planes meet. `slope` in radians is the rise of the first strip against that radius, `width` the length of all rulings.
    """
    step = 2 * np.pi * turns / (columns - 1)
    rise = np.array([0.0, 0.0, pitch * step / (2 * np.pi)])
    screw = _turn(step)
    point, normal, climbing = np.array([radius, 0.0, 0.0]), np.zeros(3), 1.0
    starts = [point]
    for level in range(creases - 1):
        after = screw @ point + rise
        edge, outward = unit(after - point), unit((after + point) * [1, 1, 0])
        binormal = np.cross(outward, edge)
        if level == 0:
            normal = np.cross(edge, np.sin(slope) * binormal + np.cos(slope) * outward)
        else:
            normal = normal - 2 * (normal @ outward) * outward
        before = screw.T @ normal
        ruling = unit(np.cross(before, normal - before))
        point = point + width * climbing * np.sign(dot(ruling, binormal)) * ruling
        climbing = -climbing
        starts.append(point)
    angle = step * np.arange(columns)
    x, y, z = np.array(starts).T[:, :, None]
    vertices = np.stack(np.broadcast_arrays(np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y,
                                            z + rise[2] * np.arange(columns)), axis=-1)
    return PleatedStructure(grid(creases, columns), vertices.reshape(-1, 3))


def _turn(angle: float) -> np.ndarray:
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]])

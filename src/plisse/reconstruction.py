"""A surface section of a design, from the recipe to numbers of the report (§3.1)."""

import numpy as np

from plisse.geometry.graph import GraphSurface
from plisse.geometry.height_field import HeightField
from plisse.geometry.mesh import ReferenceMesh
from plisse.io.meshes import read_mesh
from plisse.recipe import Surface
from plisse.result import Deviation, Interval
from plisse.solve.whole_surface import WholeSurface

__all__ = ["deviation_of", "inclinations_of", "reference_surface"]

CELLS = 60


def reference_surface(section: Surface) -> tuple[ReferenceMesh, GraphSurface]:
    """The mesh of a surface section and the smooth surface fitted to it.

    Raises InvalidMesh or InvalidDesign for files and formulas that are no surface, Infeasible where the surface is no
    graph over its mean plane.
    """
    if section.file is not None:
        mesh = read_mesh(section.file)
    else:
        assert section.height is not None
        mesh = HeightField(section.height, section.x, section.y).mesh(CELLS)
    return mesh, GraphSurface(mesh)


def deviation_of(found: WholeSurface, diagonal: float) -> Deviation:
    """Distance of the mid-surface from the reference in three units."""
    largest, mean = found.deviation.max, found.deviation.mean
    amplitude = found.best.layout.sizes.amplitude
    return Deviation(largest, mean, largest / diagonal, mean / diagonal, largest / amplitude, mean / amplitude)


def inclinations_of(found: WholeSurface) -> list[Interval]:
    """Smallest and largest inclination in degrees along every inner crease, in the order of the rows."""
    rows = (np.degrees(row) for row in found.inclination_by_crease.values())
    return [Interval(float(row.min()), float(row.max())) for row in rows]

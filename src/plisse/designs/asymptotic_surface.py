"""The surface of a pattern along asymptotic curves: its chart, and what coverage and deviations are measured from (§2.6)."""

from plisse.geometry.chart import Chart, FormulaChart, GraphChart
from plisse.geometry.chart_surface import ChartSurface
from plisse.geometry.denoised import denoised_graph
from plisse.geometry.height_field import HeightField
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.surface import Surface
from plisse.geometry.weierstrass import MinimalSurface
from plisse.io.meshes import read_mesh
from plisse.recipe import AsymptoticSurface

__all__ = ["charted_surface"]

CELLS = 60  # of the mesh that stands for a formula


def charted_surface(section: AsymptoticSurface) -> tuple[Chart, ReferenceMesh, Surface]:
    """The chart of a surface section, a mesh of the surface and the surface itself; raises InvalidDesign or Infeasible."""
    if section.weierstrass is not None:
        surface = ChartSurface(MinimalSurface(section.weierstrass.g, section.weierstrass.f, section.x, section.y))
        return surface.chart, surface.mesh(CELLS), surface
    if section.formula is not None:
        field = HeightField(section.formula, section.x, section.y)
        return FormulaChart(field), field.mesh(CELLS), field
    assert section.file is not None
    mesh = read_mesh(section.file)
    graph = denoised_graph(mesh, section.smoothing)
    return GraphChart(graph), mesh, graph

"""A surface section of a design, from the recipe to numbers of the report (§3.1)."""

import numpy as np

from plisse.errors import InvalidDesign
from plisse.geometry.expression import height_expression
from plisse.geometry.formulas import Torus
from plisse.geometry.graph import GraphSurface, facing_up
from plisse.geometry.height_field import HeightField
from plisse.geometry.jets import JetSurface
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.geometry.surface import Surface as Reference
from plisse.io.meshes import read_mesh
from plisse.layout.coverage import AreaSamples, covered
from plisse.layout.family import guide_through
from plisse.layout.family_columns import fan_pattern, guided_pattern
from plisse.measure.mid_surface import MidSurfaceDeviation, mid_surface_deviation
from plisse.recipe import Surface, SurfacePattern
from plisse.result import Deviation, Interval
from plisse.solve.attempt import Start
from plisse.solve.whole_surface import WholeSurface
from plisse.structure.pleated import PleatedStructure

__all__ = ["deviation_of", "guided_start", "inclinations_of", "lies_over", "reference_surface"]

GRAPH = 0.9999
FAN_GAPS = (0.5, 2.0)  # where a fan begins and ends, in gaps of a flat disk

CELLS = 60


def reference_surface(section: Surface) -> tuple[ReferenceMesh, Reference]:
    """The mesh of a surface section and the smooth surface that belongs to it.

    Formulas stand for themselves; meshes that are graphs over their mean plane get a smooth graph, others jets. Raises
    InvalidMesh or InvalidDesign for files and formulas that are no surface.
    """
    if section.torus is not None:
        torus = Torus(*section.torus)
        return torus.mesh(CELLS), torus
    if section.height is not None and (section.guide is not None or section.fan is not None):
        field = HeightField(section.height, section.x, section.y)
        return field.mesh(CELLS), field
    mesh = _mesh(section)
    return mesh, GraphSurface(mesh) if facing_up(mesh) >= GRAPH else JetSurface(mesh)


def _mesh(section: Surface) -> ReferenceMesh:
    if section.file is not None:
        return read_mesh(section.file)
    if section.height is not None:
        return HeightField(section.height, section.x, section.y).mesh(CELLS)
    assert section.radius is not None
    along = np.linspace(*section.x, CELLS)
    radius = height_expression(section.radius)(along, 0 * along)[0]
    if not (radius > 0).all():
        raise InvalidDesign(f"surface.radius is not positive everywhere between {section.x[0]:g} and {section.x[1]:g}; "
                            "give a formula in x that is")
    turn = np.linspace(0, 2 * np.pi, 2 * CELLS, endpoint=False)
    points = np.stack([np.outer(np.cos(turn), radius), np.outer(np.sin(turn), radius),
                       np.broadcast_to(along, (len(turn), CELLS))], axis=-1)
    return grid_mesh(points, (True, False))


def guided_start(section: Surface, recipe: SurfacePattern, mesh: ReferenceMesh, surface: Reference) -> Start:
    """Creases of constant inclination along the guide, or around the point, of a surface section.

    Raises Infeasible where the family falls into disarray.
    """
    assert recipe.theta is not None
    assert recipe.amplitude is not None
    if section.fan is not None:
        assert recipe.creases is not None
        assert section.fan_radius is not None
        pattern = fan_pattern(surface, section.fan, theta=recipe.theta, amplitude=recipe.amplitude, creases=recipe.creases,
                              radius=section.fan_radius, samples=recipe.samples, length=section.reach, beyond=section.beyond,
                              gaps=FAN_GAPS)
    else:
        assert section.guide is not None
        assert recipe.width is not None
        guide = guide_through(surface, section.guide, section.guide_closed) if section.guide_closed else section.guide
        pattern = guided_pattern(surface, mesh, guide, theta=recipe.theta, width=recipe.width, amplitude=recipe.amplitude,
                                 creases=recipe.creases, samples=recipe.samples, closed_family=section.guide_closed,
                                 tuned=section.tuned, length=section.reach, beyond=section.beyond)
    return Start(pattern, recipe.amplitude, pattern.samples)


def lies_over(structure: PleatedStructure, mesh: ReferenceMesh, surface: Reference,
              amplitude: float) -> tuple[float, Deviation]:
    """Fraction of the mesh's area under a structure, and the distance of its mid-surface."""
    quads = structure.topology.quads
    samples = AreaSamples.of(mesh.vertices, mesh.triangles)
    reach = 3 * amplitude + 3 * structure.mean_edge
    found = mid_surface_deviation(surface, structure.vertices, quads)
    return covered(samples, structure.vertices, quads, reach), _deviation(found, mesh.diagonal, amplitude)


def deviation_of(found: WholeSurface, diagonal: float) -> Deviation:
    """Distance of the mid-surface from the reference in three units."""
    return _deviation(found.deviation, diagonal, found.best.layout.sizes.amplitude)


def _deviation(found: MidSurfaceDeviation, diagonal: float, amplitude: float) -> Deviation:
    return Deviation(found.max, found.mean, found.max / diagonal, found.mean / diagonal, found.max / amplitude,
                     found.mean / amplitude)


def inclinations_of(found: WholeSurface) -> list[Interval]:
    """Smallest and largest inclination in degrees along every inner crease, in the order of the rows."""
    rows = (np.degrees(row) for row in found.inclination_by_crease.values())
    return [Interval(float(row.min()), float(row.max())) for row in rows]

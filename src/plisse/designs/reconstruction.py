"""A surface section of a design, from the recipe to numbers of the report (§3.1)."""

from collections.abc import Callable
from dataclasses import replace

import msgspec
import numpy as np
from scipy.spatial import cKDTree

from plisse.errors import InvalidDesign
from plisse.geometry.expression import height_expression
from plisse.geometry.formulas import Torus
from plisse.geometry.graph import GraphSurface, facing_up
from plisse.geometry.handles import Handle, follow, moved
from plisse.geometry.height_field import HeightField
from plisse.geometry.jets import JetSurface
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.geometry.parametric import ParametricSurface
from plisse.geometry.surface import Surface as Reference
from plisse.io.meshes import read_mesh
from plisse.layout.coverage import AreaSamples, covered, reach_of
from plisse.layout.positions import refuse_too_many, upright_amplitude
from plisse.layout.rows import ChartedSurface
from plisse.measure.inclination import crease_inclinations, overhanging
from plisse.measure.mid_surface import MidSurfaceDeviation, mid_surface_deviation
from plisse.measure.regularity import OPENING_RANGE
from plisse.recipe import Surface, SurfaceDesign, SurfacePattern
from plisse.result import ChosenLayout, Deviation, Interval
from plisse.solve.candidate import centre_of
from plisse.solve.edited import edited_structure
from plisse.solve.finer import Sampled, finer
from plisse.solve.principal_surface import nearest_principal
from plisse.solve.whole_surface import FOLDABLE, REACH, WholeSurface, whole_surface
from plisse.structure.pleated import PleatedStructure

__all__ = ["as_chosen", "chosen_layout", "deviation_of", "edited_vertices", "inclinations_of", "laid_out_over",
           "lies_over", "made_principal", "overhang_notes", "reference_surface", "sampled", "solved_again"]

GRAPH = 0.9999

CELLS = 60


def reference_surface(section: Surface) -> tuple[ReferenceMesh, Reference]:
    """The mesh of a surface section and the smooth surface that belongs to it.

    Along guides formulas stand for themselves; meshes that are graphs over their mean plane get a smooth graph, others
    jets. Over whole surfaces those that are no graphs are flattened. Raises InvalidMesh or InvalidDesign for files and
    formulas that are no surface, Infeasible for whole surfaces that cannot be flattened.
    """
    if section.torus is not None and section.is_guided:
        torus = Torus(*section.torus)
        return torus.mesh(CELLS), torus
    if section.height is not None and section.is_guided:
        field = HeightField(section.height, section.x, section.y)
        return field.mesh(CELLS), field
    mesh = _mesh(section)
    if section.is_guided and facing_up(mesh) < GRAPH:
        return mesh, JetSurface(mesh)
    return mesh, _charted(mesh)


def _charted(mesh: ReferenceMesh) -> ChartedSurface:
    """A smooth surface with a chart, for rows over all of it."""
    return GraphSurface(mesh) if facing_up(mesh) >= GRAPH else ParametricSurface(mesh)


def _mesh(section: Surface) -> ReferenceMesh:
    if section.file is not None:
        return read_mesh(section.file)
    if section.height is not None:
        return HeightField(section.height, section.x, section.y).mesh(CELLS)
    if section.torus is not None:
        return Torus(*section.torus).mesh(CELLS)
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


def laid_out_over(recipe: SurfaceDesign, mesh: ReferenceMesh, surface: ChartedSurface, candidates: int = 20,
                  progress: Callable[[str, float], None] | None = None) -> WholeSurface:
    """The best of the layouts of fitted inclination that a design asks for; raises Infeasible where none is solved."""
    section, pattern = recipe.surface, recipe.pattern
    if pattern.width is not None:
        refuse_too_many(mesh.area / pattern.width**2, "give a larger pattern.width")
    return whole_surface(
        mesh, surface, width=pattern.width, amplitude=pattern.amplitude, overhang=bool(section.overhang),
        above=section.side == "above", inside=section.boundary, candidates=candidates, seams=section.seams,
        theta=None if pattern.theta is None else float(np.radians(pattern.theta)),
        centre=None if section.centre is None else np.array(section.centre), progress=progress)


def chosen_layout(found: WholeSurface, surface: ChartedSurface) -> ChosenLayout:
    """The sizes and the centre, if any, of the layout that was chosen."""
    layout, centre = found.best.layout, centre_of(found.best, surface)
    return ChosenLayout(layout.label, float(layout.sizes.width), float(layout.sizes.amplitude),
                        None if centre is None else centre.tolist())


def as_chosen(recipe: SurfaceDesign, found: WholeSurface, chosen: ChosenLayout) -> SurfaceDesign:
    """The recipe that leads to the chosen layout without a search: with its sizes and seams where rows have a centre.

    Sizes of other layouts belong to the search, so their recipe stays as it is.
    """
    centre = recipe.surface.centre or chosen.centre
    if centre is None:
        return recipe
    seams = len(found.best.seams) or recipe.surface.seams
    return msgspec.structs.replace(
        recipe, surface=msgspec.structs.replace(recipe.surface, centre=centre, seams=seams),
        pattern=msgspec.structs.replace(recipe.pattern, width=chosen.width, amplitude=chosen.amplitude))


def edited_vertices(section: Surface, mesh: ReferenceMesh) -> np.ndarray | None:
    """Vertices (V, 3) of the mesh after the edits of a surface section, or None where there are none.

    Raises InvalidDesign where the edited file has other faces.
    """
    if section.handles is not None:
        return moved(mesh.vertices, [Handle(np.array(pull.point), np.array(pull.displacement), pull.radius)
                                     for pull in section.handles])
    if section.edited_file is None:
        return None
    import trimesh

    _ = read_mesh(section.edited_file)  # a file that is no mesh is one sentence
    before, after = (trimesh.load_mesh(path, process=False) for path in (section.file, section.edited_file))
    if before.faces.shape != after.faces.shape or not np.array_equal(before.faces, after.faces):
        raise InvalidDesign(f"surface.edited_file has {len(after.faces)} faces that are not the {len(before.faces)} of "
                            "surface.file; move vertices without adding or removing any")
    return np.asarray(after.vertices)[cKDTree(before.vertices).query(mesh.vertices)[1]]


def solved_again(found: WholeSurface, mesh: ReferenceMesh, vertices: np.ndarray,
                 overhang: bool) -> tuple[ReferenceMesh, WholeSurface]:
    """The edited mesh and the structure carried along with it and solved from there (Fig. 23).

    Raises Infeasible, saying how far it got.
    """
    edited = ReferenceMesh(vertices, mesh.triangles)
    surface = _charted(edited)
    rest = follow(found.structure.vertices, mesh, vertices)
    least = OPENING_RANGE[0] if overhang else FOLDABLE
    structure = edited_structure(found.structure, rest, normals=surface.project(rest).normals, least_opening=least).structure
    quads, part, layout = structure.topology.quads, found.best.solved.grid, found.best.layout
    inclination = crease_inclinations(structure.topology, structure.vertices, surface.project(structure.vertices).normals,
                                      layout.net.outward.reshape(-1, 3)[part.used])
    coverage = covered(AreaSamples.of(vertices, mesh.triangles), structure.vertices, quads, REACH * layout.sizes.width)
    notes = (f"solved again on the edited surface: θ runs from {np.degrees(inclination.min()):.0f}° to "
             f"{np.degrees(inclination.max()):.0f}°",)
    return edited, replace(found, structure=structure, inclination=inclination, coverage=coverage, notes=notes,
                           deviation=mid_surface_deviation(surface, structure.vertices, quads))


def sampled(found: WholeSurface, mesh: ReferenceMesh, surface: Reference, samples: int, overhang: bool) -> WholeSurface:
    """The same structure with at least so many columns, or with as many as it stays exact and regular with."""
    layout, least = found.best.layout, OPENING_RANGE[0] if overhang else FOLDABLE
    net, before = layout.net, found.best.solved
    if before.grid.shape[1] >= samples:
        return found
    fine = finer(Sampled(before.grid, before.vertices, layout.zigzag, net.normals, net.outward), samples, least)
    structure = PleatedStructure(fine.grid.topology, fine.vertices)
    normals, outward = (field.reshape(-1, 3)[fine.grid.used] for field in (fine.normals, fine.outward))
    inclination = crease_inclinations(structure.topology, structure.vertices, normals, outward)
    coverage, deviation = lies_over(structure, mesh, surface, layout.sizes.amplitude)
    columns = fine.grid.shape[1]
    notes = () if columns >= samples else (f"pattern.samples = {samples} was not reached: with more than {columns} columns "
                                           "the structure is not exact and regular any more",)
    return replace(found, structure=structure, rows=fine.grid.rows, inclination=inclination, coverage=coverage,
                   deviation=deviation, notes=found.notes + notes)


def made_principal(found: WholeSurface, mesh: ReferenceMesh, surface: Reference, overhang: bool) -> WholeSurface:
    """A principal structure near one over a whole surface, or the same one with a note where none was found."""
    structure = nearest_principal(found.structure, OPENING_RANGE[0] if overhang else FOLDABLE)
    if structure is None:
        note = ("no principal structure was found near the general one: fold angles would have to be constant along "
                "creases, and the surface bends too unevenly for that; try another centre, or solve.principal = false")
        return replace(found, notes=(*found.notes, note))
    part, layout = found.best.solved.grid, found.best.layout
    inclination = crease_inclinations(structure.topology, structure.vertices, surface.project(structure.vertices).normals,
                                      layout.net.outward.reshape(-1, 3)[part.used])
    coverage, deviation = lies_over(structure, mesh, surface, layout.sizes.amplitude)
    note = f"principal: θ runs from {np.degrees(inclination.min()):.0f}° to {np.degrees(inclination.max()):.0f}°"
    return replace(found, structure=structure, inclination=inclination, coverage=coverage,
                   deviation=deviation, notes=(*found.notes, note))


def lies_over(structure: PleatedStructure, mesh: ReferenceMesh, surface: Reference,
              amplitude: float) -> tuple[float, MidSurfaceDeviation]:
    """Fraction of the mesh's area under a structure, and the distance of its mid-surface."""
    quads = structure.topology.quads
    samples = AreaSamples.of(mesh.vertices, mesh.triangles)
    return (covered(samples, structure.vertices, quads, reach_of(amplitude, structure.mean_edge)),
            mid_surface_deviation(surface, structure.vertices, quads))


def deviation_of(found: MidSurfaceDeviation, diagonal: float, amplitude: float) -> Deviation:
    """Distance of the mid-surface from the reference in three units."""
    return Deviation(found.max, found.mean, found.max / diagonal, found.mean / diagonal, found.max / amplitude,
                     found.mean / amplitude)


def overhang_notes(structure: PleatedStructure, surface: Reference, pattern: SurfacePattern) -> list[str]:
    """Which part of the faces leans over the reference so far that it hides another, and what would keep it from that."""
    assert pattern.theta is not None
    assert pattern.width is not None
    quads = structure.topology.quads
    below = surface.project(structure.vertices[quads].mean(axis=1)).normals
    share = overhanging(structure.topology, structure.vertices, below)
    if share == 0:
        return []
    limit = upright_amplitude(float(np.radians(pattern.theta)), pattern.width)
    return [f"{100 * share:.0f} % of the faces overhang; " + ("pleats do from pattern.theta = 45 on" if limit == 0 else
            f"at this theta and width an amplitude below {limit:.3g} keeps them from that")]


def inclinations_of(found: WholeSurface) -> list[Interval]:
    """Smallest and largest inclination in degrees along every inner crease, in the order of the rows."""
    rows = (np.degrees(row) for row in found.inclination_by_crease.values())
    return [Interval(float(row.min()), float(row.max())) for row in rows]

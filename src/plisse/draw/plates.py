"""Pictures of plates: in place, moved and exploded; and flat on the film that holds them."""

from pathlib import Path

import numpy as np

from plisse.draw.camera import Camera, best_view
from plisse.draw.drawing import Drawing, Layer
from plisse.draw.row import write_row
from plisse.draw.shapes import Line, Text
from plisse.draw.strokes import Stroke
from plisse.geometry.vectors import dot, unit
from plisse.recipe import MILLIMETRES
from plisse.structure.chains import boundary_loops
from plisse.structure.front import front_up
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.flex import flex
from plisse.transform.hinged_range import HingedRange, placed
from plisse.transform.outlines import Outlines
from plisse.transform.plates import Plates
from plisse.transform.solids import solids

__all__ = ["film", "plates_mesh", "write_plates_picture"]

APART, NODE_APART, ENLARGED = 0.32, 0.09, 0.6
NODE_TILT = np.radians(35)
MARGIN = 5.0
STROKES = {"film": Stroke("#909090", 0.1), "plate": Stroke("#000000", 0.1), "number": Stroke("#2f5f8a", 0.1)}


def write_plates_picture(plates: Plates, path: str | Path, *, movement: HingedRange | None = None, title: str = "",
                         units: str = "mm") -> None:
    """Write a PNG of all plates in place and exploded, of one node enlarged, and of hinged ones half way as they open."""
    camera, everything = best_view(plates.structure), np.arange(plates.count)
    shapes, captions = [plates_mesh(plates)], ["in place"]
    if movement is not None and (percent := 0.5 * (movement.low + 100)) < 99:
        lower, upper = placed(plates, flex(plates.structure, percent))
        shapes.append(_body(plates, lower[0], upper[0], everything))
        captions.append(f"opened to {percent:.0f} %")
    middles = _middles(plates)
    away = APART * (middles - middles.mean(axis=0))
    shapes.append(_body(plates, *_moved(plates, away), everything))
    captions.append("exploded")
    if 4 in plates.structure.topology.stars:
        shapes.append(_node(plates, camera))
        captions.append("a node, enlarged")
    write_row(shapes, captions, path, camera=camera, title=title, facts=_facts(plates, units))


def plates_mesh(plates: Plates) -> PleatedStructure:
    """The solids of all plates in place, as one mesh of loose faces."""
    return _body(plates, plates.lower, plates.upper, np.arange(plates.count))


def _facts(plates: Plates, units: str) -> list[str]:
    cut = plates.cut
    facts = [f"{plates.count:,} plates", f"{cut.thickness:g} {units} thick",
             "square, on a film" if cut.hinged else "mitred along the cone axes"]
    return facts + ([f"gap {cut.gap:g} {units}"] if cut.gap else [])


def film(plates: Plates, units: str = "mm", *, title: str = "") -> Drawing:
    """The film at 1:1 in millimetres with the place of every plate and its number: layers film, plate and number.

    Plates are drawn with their outline at the film, or with that in the plane of the face where they are mitred.
    Raises InvalidStructure when the structure has no development.
    """
    opened = plates.structure.opened
    flat = front_up(plates.structure) * MILLIMETRES[units]
    flat = flat - flat.min(axis=0) + MARGIN
    sheet = Outlines(opened.topology, np.column_stack([flat, np.zeros(len(flat))]))
    outlines = sheet.shifted(plates.cut.setback * MILLIMETRES[units])[:, :2]
    face = opened.topology.corners.face
    lines = tuple(Line(outline, closed=True) for outline in np.split(outlines, np.flatnonzero(np.diff(face)) + 1))
    middles = outlines[plates.corners].mean(axis=1)
    heights = 0.3 * plates.widths * MILLIMETRES[units] / np.maximum(1, 0.4 * len(str(plates.count)))
    numbers = tuple(Text(str(number), (float(x), float(y - 0.5 * height)), float(height), anchor="middle")
                    for number, ((x, y), height) in enumerate(zip(middles, heights, strict=True), 1))
    rim = tuple(Line(flat[loop], closed=True) for loop in boundary_loops(opened.topology))
    width, height = (np.ptp(flat, axis=0) + 2 * MARGIN).tolist()
    layers = (Layer("film", rim, (), STROKES["film"]), Layer("plate", lines, (), STROKES["plate"]),
              Layer("number", (), numbers, STROKES["number"]))
    return Drawing(title, (width, height), layers)


def _body(plates: Plates, lower: np.ndarray, upper: np.ndarray, chosen: np.ndarray) -> PleatedStructure:
    """The solids of the chosen plates as one mesh of loose faces, for nothing is smooth between them; quads first."""
    cuts = np.flatnonzero(np.diff(plates.structure.topology.corners.face)) + 1
    pairs, parts = list(zip(np.split(lower, cuts), np.split(upper, cuts), strict=True)), solids(plates)
    faces = [np.concatenate(pairs[plate])[polygon] for plate in chosen for polygon in parts[plate].faces]
    faces = sorted(faces, key=lambda polygon: len(polygon) != 4)
    ends = np.cumsum([len(polygon) for polygon in faces])
    quads = sum(len(polygon) == 4 for polygon in faces)
    hubs = np.split(np.arange(ends[-1]), ends[quads - 1:-1])[1:]
    return PleatedStructure(Topology(int(ends[-1]), np.arange(4 * quads).reshape(-1, 4), tuple(hubs)), np.concatenate(faces))


def _node(plates: Plates, camera: Camera) -> PleatedStructure:
    """The four plates around a vertex in the middle, a little apart, turned so that their ridge points to the viewer."""
    structure, topology = plates.structure, plates.structure.topology
    middle = len(topology.stars[4]) // 2
    star, chosen = topology.stars[4][middle], topology.corners.face[topology.star_corners[4][middle]]
    vertex = structure.vertices[star[0]]
    body = _body(plates, *_moved(plates, NODE_APART * (_middles(plates) - vertex)), chosen)
    along = unit(structure.vertices[star[1]] - structure.vertices[star[3]])
    inside = _middles(plates)[chosen].mean(axis=0) - vertex
    ridge = unit(dot(inside, along) * along - inside)
    frame = Camera.looking_from(ridge - np.tan(NODE_TILT) * along, np.cross(along, inside))
    turned = frame.project(body.vertices - vertex)
    extent, whole = np.ptp(turned[:, :2], axis=0).max(), np.ptp(camera.project(structure.vertices)[:, :2], axis=0).max()
    return body.with_vertices(turned @ camera.axes * (ENLARGED * whole / extent))


def _middles(plates: Plates) -> np.ndarray:
    """The middle (F, 3) of every plate."""
    return (0.5 * (plates.lower + plates.upper))[plates.corners].mean(axis=1)


def _moved(plates: Plates, away: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Lower and upper outlines after every plate has moved by `away` (F, 3)."""
    shift = away[plates.structure.topology.corners.face]
    return plates.lower + shift, plates.upper + shift

"""3DM for Rhino: a mesh, ruled strips, crease curves, rulings, and the flat sheet beside them, one layer per kind."""

from collections import Counter
from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline

from plisse.draw.colours import EDGE, MOUNTAIN, PAPER, RULING, VALLEY, rgb
from plisse.draw.runs import Run, lettered_runs
from plisse.errors import InvalidStructure, PlisseError
from plisse.extras import optional
from plisse.geometry.polyline import arc_length
from plisse.io.atomic import written
from plisse.io.coordinates import checked_coordinates
from plisse.io.labels import folding_evidence, labelled_topology
from plisse.io.model import Model
from plisse.io.welding import used_only, welded
from plisse.structure.bands import Band, bands
from plisse.structure.front import front_up
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["load_3dm", "write_3dm"]

UNITS = {"mm": "Millimeters", "cm": "Centimeters", "m": "Meters", "in": "Inches", "ft": "Feet"}
LINES = {"M": ("mountain", MOUNTAIN), "V": ("valley", VALLEY), "F": ("flat", RULING), "R": ("ruling", RULING),
         "B": ("boundary", EDGE)}


def write_3dm(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the structure for Rhino 7 and later in its own unit, all digits kept.

    Layers under `folded`: mesh, strip (ruled NURBS surfaces through the rulings), mountain, valley, boundary, ruling;
    under `sheet` the lines again, flat and to the right, where there is a development. Creases are cubic NURBS curves
    through their vertices. Raises MissingExtra without rhino3dm, PlisseError where the file cannot be written.
    """
    rhino = optional("rhino3dm", extra="cad", purpose="3DM files")
    model = rhino.File3dm()
    model.ApplicationName, model.StartSectionComments = "plisse", title
    model.Settings.ModelUnitSystem = getattr(rhino.UnitSystem, UNITS[units])
    model.Settings.ModelAbsoluteTolerance = 1e-5 * structure.diagonal
    folded = _Layers(rhino, model, "folded")
    folded.add("mesh", PAPER, _mesh(rhino, structure), title)
    for band in bands(structure.topology):
        folded.add("strip", PAPER, _ruled(rhino, structure.vertices, band))
    _add_lines(folded, structure, structure.vertices)
    if structure.development is not None:
        _add_lines(_Layers(rhino, model, "sheet"), structure.opened, _beside(structure))
    with written(path) as aside:
        if not model.Write(str(aside), 7):
            raise PlisseError(f"{path} cannot be written; choose another place")


class _Layers:
    """Layers below a common parent, made when something is put on them."""

    def __init__(self, rhino, model, parent: str):
        self.rhino, self.model, self.parent = rhino, model, parent
        self._numbers: dict[str, int] = {}
        self._parent_id = model.Layers[self._new(parent, EDGE)].Id

    def add(self, name: str, colour: str, geometry, label: str = "") -> None:
        """Put geometry on the layer of that name."""
        if name not in self._numbers:
            self._numbers[name] = self._new(name, colour, below=True)
        attributes = self.rhino.ObjectAttributes()
        attributes.LayerIndex, attributes.Name = self._numbers[name], label
        self.model.Objects.Add(geometry, attributes)

    def _new(self, name: str, colour: str, below: bool = False) -> int:
        layer = self.rhino.Layer()
        layer.Name, layer.Color = name, (*np.round(255 * rgb(colour)).astype(int).tolist(), 255)
        if below:
            layer.ParentLayerId = self._parent_id
        return self.model.Layers.Add(layer)


def _add_lines(layers: _Layers, structure: PleatedStructure, points: np.ndarray) -> None:
    """Creases as NURBS curves, rulings and boundaries as polylines, through `points` (V, 3)."""
    for run in lettered_runs(structure):
        name, colour = LINES[run.letter]
        smooth = run.letter in "MVF" and len(run.vertices) > 2
        layers.add(name, colour, (_curve if smooth else _polyline)(layers.rhino, points, run))


def _beside(structure: PleatedStructure) -> np.ndarray:
    """The development (V', 3) on the ground, to the right of the folded structure."""
    flat, low, high = front_up(structure), structure.vertices.min(axis=0), structure.vertices.max(axis=0)
    shift = np.array([high[0] + 0.1 * structure.diagonal, low[1]]) - flat.min(axis=0)
    return np.column_stack([flat + shift, np.full(len(flat), low[2])])


def _mesh(rhino, structure: PleatedStructure):
    """Quads as quads; hubs in triangles, because Rhino's faces end at four corners."""
    mesh, topology = rhino.Mesh(), structure.topology
    vertices, faces = mesh.Vertices, mesh.Faces
    vertices.UseDoublePrecisionVertices = True
    for x, y, z in structure.vertices.tolist():
        vertices.AddPoint3d(x, y, z)
    for quad in topology.quads.tolist():
        faces.AddFace(*quad)
    triangles, owner = triangulated(topology)
    for triangle in triangles[owner >= len(topology.quads)].tolist():
        faces.AddFace(*triangle)
    mesh.Normals.ComputeNormals()
    return mesh


def _polyline(rhino, points: np.ndarray, run: Run):
    path = np.append(run.vertices, run.vertices[:1]) if run.closed else run.vertices
    return rhino.PolylineCurve(rhino.Point3dList([rhino.Point3d(*point) for point in points[path].tolist()]))


def _curve(rhino, points: np.ndarray, run: Run):
    """Cubic NURBS curve through the vertices of a crease, parametrised by chord length."""
    knots, controls = _interpolated(points[run.vertices], arc_length(points[run.vertices], run.closed), run.closed)
    curve = rhino.NurbsCurve(3, False, 4 if len(controls) > 3 else len(controls), len(controls))
    net, values = curve.Points, curve.Knots
    for k, (x, y, z) in enumerate(controls.tolist()):
        net[k] = rhino.Point4d(x, y, z, 1.0)
    for k, knot in enumerate(knots.tolist()):
        values[k] = knot
    return curve


def _ruled(rhino, vertices: np.ndarray, band: Band):
    """Surface of degree 3 along the creases and 1 across; its edges share parameters, so it holds every ruling."""
    left, right = vertices[band.left], vertices[band.right]
    parameter = (arc_length(left, band.closed) + arc_length(right, band.closed)) / 2
    (knots, first), (_, second) = (_interpolated(side, parameter, band.closed) for side in (left, right))
    order = min(4, len(first))
    surface = rhino.NurbsSurface.Create(3, False, order, 2, len(first), 2)
    net, values = surface.Points, surface.KnotsU
    for j, side in enumerate((first, second)):
        for i, (x, y, z) in enumerate(side.tolist()):
            net[i, j] = rhino.Point4d(x, y, z, 1.0)
    for k, knot in enumerate(knots.tolist()):
        values[k] = knot
    surface.KnotsV[0], surface.KnotsV[1] = 0.0, float(np.linalg.norm(left - right, axis=1).mean())
    return surface


def _interpolated(points: np.ndarray, parameter: np.ndarray, closed: bool) -> tuple[np.ndarray, np.ndarray]:
    """Knots as Rhino counts them (without the first and last) and control points of the spline through points."""
    path = np.concatenate([points, points[:1]]) if closed else points
    spline = make_interp_spline(parameter, path, k=min(3, len(path) - 1), bc_type="periodic" if closed else None)
    return spline.t[1:-1], spline.c


def load_3dm(path: str | Path) -> Model:
    """The one quad mesh in a 3DM file, with its unit; creases are the family of edges that folds more; not developed.

    Raises MissingExtra without rhino3dm, InvalidStructure for files without a mesh, with several, or with triangles.
    """
    path = Path(path)
    rhino = optional("rhino3dm", extra="cad", purpose="3DM files")
    if not path.is_file():
        raise InvalidStructure(f"there is no file {path}; give a FOLD, OBJ or 3DM file")
    model = rhino.File3dm.Read(str(path))
    if model is None:
        raise InvalidStructure(f"{path.name} is not a 3DM file, or of a Rhino newer than the installed rhino3dm")
    mesh = _only_mesh(rhino, model, path)
    corners = [mesh.Faces[k] for k in range(mesh.Faces.Count)]
    faces = [list(face if face[2] != face[3] else face[:3]) for face in corners]
    points = [mesh.Vertices.Point3dAt(k) for k in range(len(mesh.Vertices))]
    vertices = checked_coordinates(np.array([[p.X, p.Y, p.Z] for p in points]).reshape(-1, 3), path)
    vertices, (faces,) = welded(vertices, faces)
    vertices, (faces,) = used_only(vertices, faces)
    topology = labelled_topology(len(vertices), faces, folding_evidence(vertices, faces))
    names = {getattr(rhino.UnitSystem, name): unit for unit, name in UNITS.items()}
    return Model(PleatedStructure(topology, vertices), names.get(model.Settings.ModelUnitSystem, "mm"))


def _only_mesh(rhino, model, path: Path):
    shapes = [item.Geometry for item in model.Objects]
    meshes = [shape for shape in shapes if isinstance(shape, rhino.Mesh)]
    if len(meshes) == 1:
        return meshes[0]
    if meshes:
        raise InvalidStructure(f"{path.name} holds {len(meshes)} meshes, but a structure is one; save one of them alone")
    found = Counter(type(shape).__name__ for shape in shapes)
    listed = ", ".join(f"{count} {name}" for name, count in sorted(found.items())) or "nothing"
    raise InvalidStructure(f"{path.name} holds no mesh, but {listed}; make a quad mesh of it (QuadRemesh) and save that")

import sys
from collections import Counter

import numpy as np
import pytest
import rhino3dm

from plisse.assess import assess
from plisse.errors import InvalidStructure, MissingExtra
from plisse.io.rhino import load_3dm, write_3dm


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def objects_of(path):
    """Geometry by full layer name."""
    model = rhino3dm.File3dm.Read(str(path))
    layers, out = [layer.FullPath for layer in model.Layers], {}
    for item in model.Objects:
        assert item.Geometry.IsValid, item.Geometry.IsValidWithLog
        out.setdefault(layers[item.Attributes.LayerIndex], []).append(item.Geometry)
    return model, out


def xyz(point):
    return np.array([point.X, point.Y, point.Z])


def test_there_is_one_layer_per_kind_and_everything_is_valid(structure, tmp_path):
    write_3dm(structure, tmp_path / "s.3dm")
    _, objects = objects_of(tmp_path / "s.3dm")
    count = {name: len(shapes) for name, shapes in objects.items()}
    creases, rulings = structure.topology.creases, structure.topology.rulings
    assert count["folded::mesh"] == 1
    assert count["folded::strip"] == len(creases) - 1
    assert count["folded::mountain"] + count["folded::valley"] == len(creases) - 2
    assert count["sheet::mountain"] + count["sheet::valley"] == len(creases) - 2
    assert count["folded::ruling"] == len(rulings) - 2 * (not creases[0].closed)
    assert count["sheet::boundary"] == 1
    kinds = Counter(type(shape).__name__ for name in ("folded::mountain", "folded::strip", "folded::mesh")
                    for shape in objects[name])
    assert set(kinds) == {"NurbsCurve", "NurbsSurface", "Mesh"}


@pytest.mark.parametrize(("units", "name"), [("mm", "Millimeters"), ("m", "Meters"), ("in", "Inches")])
def test_the_unit_is_set_and_comes_back(cones, tmp_path, units, name):
    write_3dm(cones, tmp_path / "s.3dm", units=units)
    model, _ = objects_of(tmp_path / "s.3dm")
    assert model.Settings.ModelUnitSystem == getattr(rhino3dm.UnitSystem, name)
    assert load_3dm(tmp_path / "s.3dm").units == units


def test_a_round_trip_keeps_every_digit_and_every_label(structure, tmp_path):
    write_3dm(structure, tmp_path / "s.3dm")
    back = load_3dm(tmp_path / "s.3dm").structure
    assert np.array_equal(back.vertices, structure.vertices)
    assert np.array_equal(back.topology.quads, structure.topology.quads)
    assert assess(back).planarity.max < 1e-14


def test_crease_curves_run_through_the_vertices_of_their_crease(structure, tmp_path):
    write_3dm(structure, tmp_path / "s.3dm")
    _, objects = objects_of(tmp_path / "s.3dm")
    curves = objects["folded::mountain"] + objects["folded::valley"]
    missing = {v for crease in structure.topology.creases[1:-1] for v in crease.vertices.tolist()}
    for curve in curves:
        assert curve.Degree == 3 and curve.IsClosed == structure.topology.creases[0].closed
        domain = curve.Domain
        knots = np.unique([curve.Knots[k] for k in range(len(curve.Knots))])
        points = np.array([xyz(curve.PointAt(t)) for t in np.linspace(domain.T0, domain.T1, 3001)])
        for vertex in list(missing):
            if np.linalg.norm(points - structure.vertices[vertex], axis=1).min() < 0.1:
                missing.discard(vertex)
        middle = curve.PointAt(float(knots[len(knots) // 2]))
        assert np.linalg.norm(structure.vertices - xyz(middle), axis=1).min() < 1e-9
    assert not missing


def test_strips_hold_their_rulings_and_are_straight_across(structure, tmp_path):
    write_3dm(structure, tmp_path / "s.3dm")
    _, objects = objects_of(tmp_path / "s.3dm")
    for surface in objects["folded::strip"]:
        assert (surface.Degree(0), surface.Degree(1)) == (3, 1)
        knots = [surface.KnotsU[k] for k in range(4, len(surface.KnotsU) - 4)]
        ends = np.array([[xyz(surface.PointAt(t, v)) for v in (surface.Domain(1).T0, surface.Domain(1).T1)] for t in knots])
        near = np.linalg.norm(structure.vertices - ends[:, :, None], axis=-1)
        assert near.min(axis=-1).max() < 1e-9


def test_the_sheet_lies_beside_at_one_to_one(structure, tmp_path):
    write_3dm(structure, tmp_path / "s.3dm")
    _, objects = objects_of(tmp_path / "s.3dm")
    outline, = objects["sheet::boundary"]
    points = np.array([xyz(outline.Point(k)) for k in range(outline.PointCount)])
    edges = structure.cut.topology.edges
    a, b = structure.development[edges.vertices[edges.is_boundary].T]
    length = np.linalg.norm(np.diff(points, axis=0), axis=1).sum()
    assert length == pytest.approx(np.linalg.norm(a - b, axis=1).sum(), abs=1e-9)
    assert points[:, 0].min() > structure.vertices[:, 0].max() and np.ptp(points[:, 2]) == 0


def test_without_development_only_the_folded_layers_are_there(cones, tmp_path):
    write_3dm(cones.with_vertices(cones.vertices), tmp_path / "s.3dm")
    assert not any(name.startswith("sheet") for name in objects_of(tmp_path / "s.3dm")[1])


def mesh_of(points, faces):
    mesh = rhino3dm.Mesh()
    for point in points:
        mesh.Vertices.Add(*point)
    for face in faces:
        mesh.Faces.AddFace(*face)
    return mesh


def test_meshes_whose_faces_came_apart_are_welded(cones, tmp_path):
    model = rhino3dm.File3dm()
    points = cones.vertices[cones.topology.quads].reshape(-1, 3)
    model.Objects.AddMesh(mesh_of(points.tolist(), np.arange(len(points)).reshape(-1, 4).tolist()))
    model.Write(str(tmp_path / "s.3dm"), 7)
    back = load_3dm(tmp_path / "s.3dm").structure
    assert back.topology.vertex_count == cones.topology.vertex_count and back.topology.components == 1
    assert len(back.topology.creases) == len(cones.topology.creases)


SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


@pytest.mark.parametrize(("shapes", "sentence"), [
    ([], "holds no mesh, but nothing"),
    ([rhino3dm.LineCurve(rhino3dm.Point3d(0, 0, 0), rhino3dm.Point3d(1, 0, 0))], "no mesh, but 1 LineCurve.*QuadRemesh"),
    ([mesh_of(SQUARE, [(0, 1, 2, 3)]), mesh_of(SQUARE, [(0, 1, 2, 3)])], "holds 2 meshes"),
    ([mesh_of(SQUARE, [(0, 1, 2), (0, 2, 3)])], "face 1 has 3 edges"),
])
def test_what_is_no_quad_mesh_is_one_sentence(tmp_path, shapes, sentence):
    model = rhino3dm.File3dm()
    for shape in shapes:
        model.Objects.Add(shape)
    model.Write(str(tmp_path / "s.3dm"), 7)
    with pytest.raises(InvalidStructure, match=sentence):
        load_3dm(tmp_path / "s.3dm")


def test_missing_files_junk_and_a_missing_library_are_one_sentence(cones, tmp_path, monkeypatch):
    with pytest.raises(InvalidStructure, match="there is no file"):
        load_3dm(tmp_path / "missing.3dm")
    (tmp_path / "junk.3dm").write_bytes(bytes(range(256)))
    with pytest.raises(InvalidStructure, match="not a 3DM file"):
        load_3dm(tmp_path / "junk.3dm")
    monkeypatch.setitem(sys.modules, "rhino3dm", None)
    with pytest.raises(MissingExtra, match=r'rhino3dm.*pip install "plisse\[cad\]"'):
        write_3dm(cones, tmp_path / "s.3dm")
    assert not (tmp_path / "s.3dm").exists()

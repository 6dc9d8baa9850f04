"""STL, PLY and 3MF, read back by trimesh and by lib3mf."""

import xml.etree.ElementTree as ET
import zipfile

import numpy as np
import pytest
import trimesh

from plisse.io.ply import write_ply
from plisse.io.stl import write_stl
from plisse.io.threemf import write_3mf

CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def area_of(structure):
    """Area of the quads by half cross products of their diagonals."""
    a, b, c, d = structure.vertices[structure.topology.quads].swapaxes(0, 1)
    return np.linalg.norm(np.cross(c - a, d - b), axis=1).sum() / 2


def test_ply_keeps_every_digit_every_face_and_every_crease(structure, tmp_path):
    write_ply(structure, tmp_path / "s.ply", title="ünï cødé")
    mesh = trimesh.load(tmp_path / "s.ply", process=False)
    assert np.array_equal(mesh.vertices, structure.vertices)
    assert len(mesh.faces) == 2 * structure.topology.face_count
    assert mesh.area == pytest.approx(area_of(structure), rel=1e-12)
    header, _, body = (tmp_path / "s.ply").read_bytes().partition(b"end_header\n")
    assert b"comment units: mm" in header
    count = structure.topology.edges.is_crease.sum()
    edges = np.frombuffer(body[-8 * count:], "<i4").reshape(-1, 2)
    assert np.array_equal(edges, structure.topology.edges.vertices[structure.topology.edges.is_crease])


@pytest.mark.parametrize(("units", "factor"), [("mm", 1.0), ("cm", 10.0), ("in", 25.4)])
def test_stl_is_in_millimetres_and_its_normals_are_those_of_the_faces(cones, tmp_path, units, factor):
    write_stl(cones, tmp_path / "s.stl", units=units)
    mesh = trimesh.load(tmp_path / "s.stl", process=False)
    assert len(mesh.faces) == 2 * cones.topology.face_count
    assert np.allclose(mesh.bounds, factor * np.array([cones.vertices.min(axis=0), cones.vertices.max(axis=0)]), rtol=1e-6)
    assert mesh.area == pytest.approx(factor**2 * area_of(cones), rel=1e-6)  # single precision
    record = np.frombuffer((tmp_path / "s.stl").read_bytes()[84:134], "<f4", 12).reshape(4, 3)
    assert np.allclose(record[0], np.cross(record[2] - record[1], record[3] - record[1])
                       / np.linalg.norm(np.cross(record[2] - record[1], record[3] - record[1])), atol=1e-5)


@pytest.mark.parametrize(("units", "name"), [("mm", "millimeter"), ("cm", "centimeter"), ("ft", "foot")])
def test_3mf_says_its_unit_and_keeps_every_length(structure, tmp_path, units, name):
    write_3mf(structure, tmp_path / "s.3mf", units=units)
    with zipfile.ZipFile(tmp_path / "s.3mf") as package:
        assert package.testzip() is None
        root = ET.fromstring(package.read("3D/3dmodel.model"))
    assert root.get("unit") == name
    points = np.array([[float(v.get(axis)) for axis in "xyz"] for v in root.iter(f"{CORE}vertex")])
    assert points.min() == 0  # parts lie on the bed, in the first octant
    shift = points - structure.vertices
    assert np.abs(shift - shift[0]).max() < 1e-12
    assert len(list(root.iter(f"{CORE}triangle"))) == 2 * structure.topology.face_count


def test_lib3mf_reads_3mf_strictly_and_without_a_warning(structure, tmp_path):
    lib3mf = pytest.importorskip("lib3mf")  # no wheel for Linux on ARM
    write_3mf(structure, tmp_path / "s.3mf", title='5 < 6 & "7" – é', units="cm")
    model = lib3mf.get_wrapper().CreateModel()
    reader = model.QueryReader("3mf")
    reader.SetStrictModeActive(True)
    reader.ReadFromFile(str(tmp_path / "s.3mf"))
    assert reader.GetWarningCount() == 0
    assert model.GetUnit() == lib3mf.ModelUnit.CentiMeter
    objects = model.GetMeshObjects()
    assert objects.Count() == 1 and objects.MoveNext()
    mesh = objects.GetCurrentMeshObject()
    assert mesh.GetName() == '5 < 6 & "7" – é'
    assert (mesh.GetVertexCount(), mesh.GetTriangleCount()) == (len(structure.vertices), 2 * structure.topology.face_count)
    assert mesh.GetType() == lib3mf.ObjectType.Surface and mesh.IsValid()


@pytest.mark.parametrize(("write", "suffix"), [(write_ply, "ply"), (write_stl, "stl"), (write_3mf, "3mf")])
def test_equal_structures_give_equal_bytes(cones, tmp_path, write, suffix):
    for name in ("a", "b"):
        write(cones, tmp_path / f"{name}.{suffix}", title="same")
    assert (tmp_path / f"a.{suffix}").read_bytes() == (tmp_path / f"b.{suffix}").read_bytes()


def test_to_trimesh_has_the_same_surface_and_knows_its_faces(structure):
    mesh = structure.to_trimesh()
    assert np.array_equal(mesh.vertices, structure.vertices)
    assert mesh.area == pytest.approx(area_of(structure), rel=1e-12)
    assert np.array_equal(np.bincount(mesh.face_attributes["face"]), np.full(structure.topology.face_count, 2))
    assert mesh.euler_number == structure.topology.euler_characteristic

import json
import struct

import numpy as np
import pytest
import trimesh

from plisse.draw.colours import MOUNTAIN, VALLEY, quality, rgb
from plisse.io.glb_structure import write_glb
from plisse.measure.folds import assignments


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def srgb(linear):
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def document_of(path):
    """The JSON chunk, and a function that reads an accessor; the five lines that glTF's container takes."""
    data = path.read_bytes()
    magic, version, total, size, kind = struct.unpack_from("<4sIII4s", data)
    assert (magic, version, total, kind) == (b"glTF", 2, len(data), b"JSON")
    document, start = json.loads(data[20:20 + size]), 20 + size + 8

    def values(index):
        accessor = document["accessors"][index]
        view = document["bufferViews"][accessor["bufferView"]]
        dtype = {5126: "<f4", 5125: "<u4"}[accessor["componentType"]]
        width = {"SCALAR": 1, "VEC3": 3}[accessor["type"]]
        return np.frombuffer(data, dtype, accessor["count"] * width, start + view["byteOffset"]).reshape(-1, width)

    return document, values


@pytest.mark.parametrize(("units", "metres"), [("mm", 1e-3), ("ft", 0.3048)])
def test_trimesh_sees_the_surface_in_metres_with_y_upwards(structure, tmp_path, units, metres):
    write_glb(structure, tmp_path / "s.glb", title="fan", units=units)
    scene = trimesh.load(tmp_path / "s.glb", process=False)
    paper = next(shape for shape in scene.geometry.values() if isinstance(shape, trimesh.Trimesh))
    x, y, z = structure.vertices.T * metres
    expected = np.stack([x, z, -y], axis=1)
    assert np.allclose(paper.bounds, [expected.min(axis=0), expected.max(axis=0)], rtol=1e-6)  # single precision
    assert paper.area == pytest.approx(metres**2 * structure.to_trimesh().area, rel=1e-6)
    assert len(paper.faces) == 2 * structure.topology.face_count


def test_creases_are_lines_in_the_colours_of_mountain_and_valley(structure, tmp_path):
    write_glb(structure, tmp_path / "s.glb")
    document, values = document_of(tmp_path / "s.glb")
    letters = assignments(structure.topology, structure.vertices)
    paper, *lines = document["meshes"][0]["primitives"]
    assert paper["mode"] == 4 and len(lines) == 2
    for line, letter, colour in zip(lines, "MV", (MOUNTAIN, VALLEY), strict=True):
        material = document["materials"][line["material"]]
        factor = np.array(material["pbrMetallicRoughness"]["baseColorFactor"][:3])
        assert line["mode"] == 1 and np.allclose(srgb(factor), rgb(colour), atol=1e-4)  # factors have five decimals
        chosen = (letters == letter) & structure.topology.edges.is_crease
        assert len(values(line["indices"])) == 2 * chosen.sum()


def test_exact_paper_is_pale_and_a_lifted_vertex_is_seen(cones, tmp_path):
    write_glb(cones, tmp_path / "good.glb")
    document, values = document_of(tmp_path / "good.glb")
    good = values(document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"])
    assert np.allclose(srgb(good), quality(np.zeros(1)), atol=1e-6)
    bent = cones.vertices.copy()
    bent[3 * 25 + 12, 2] += 0.5
    write_glb(cones.with_vertices(bent), tmp_path / "bent.glb")
    document, values = document_of(tmp_path / "bent.glb")
    bad = values(document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"])
    changed = np.abs(bad - good).max(axis=1) > 1e-3
    at_vertex = cones.topology.corners.vertex == 3 * 25 + 12
    assert changed[at_vertex].all() and changed.mean() < 0.1
    assert np.allclose(srgb(bad[at_vertex]), quality(np.ones(1)), atol=0.25)  # an angle defect of some 1e-2

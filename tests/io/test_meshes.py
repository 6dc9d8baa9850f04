"""Meshes from files: cleaned ones agree with the surface they stand for, bad ones are one sentence."""

import gzip
import os
import re
import struct

import numpy as np
import pytest
import trimesh

from plisse.errors import InvalidMesh, PlisseError
from plisse.geometry.cleaning import cleaned
from plisse.geometry.formulas import Cylinder, HeightField, Sphere
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.io.meshes import read_mesh

WAVE = HeightField("0.2 * sin(x) * cos(y)", (-2, 2), (-1, 1)).mesh(12)


def obj(vertices, faces, extra=""):
    """Text of an OBJ file; faces count from 0."""
    lines = [f"v {x} {y} {z}" for x, y, z in vertices] + ["f " + " ".join(str(i + 1) for i in face) for face in faces]
    return "\n".join(lines) + "\n" + extra


def moved(mesh, shift):
    return mesh.vertices + shift


def two_pieces():
    return obj(np.concatenate([WAVE.vertices, moved(WAVE, [9, 0, 0])]),
               np.concatenate([WAVE.triangles, WAVE.triangles + len(WAVE.vertices)]))


def with_vertex(index, *xyz):
    vertices = WAVE.vertices.tolist()
    vertices[index] = list(xyz)
    return obj(vertices, WAVE.triangles)


def moebius():
    turn, across = np.meshgrid(2 * np.pi / 30 * np.arange(30), np.linspace(-0.3, 0.3, 4), indexing="ij")
    ring = 1 + across * np.cos(turn / 2)
    points = np.stack([ring * np.cos(turn), ring * np.sin(turn), across * np.sin(turn / 2)], axis=-1).reshape(-1, 3)
    faces = []
    for i in range(30):
        for j in range(3):
            following = [4 * (i + 1) + j, 4 * (i + 1) + j + 1] if i < 29 else [3 - j, 2 - j]
            faces.append([4 * i + j, following[0], following[1], 4 * i + j + 1])
    return obj(points, faces)


def third_face_on_an_edge():
    a, b = WAVE.triangles[5][:2]
    return obj([*WAVE.vertices, [0, 0, 5]], [*WAVE.triangles, [a, b, len(WAVE.vertices)]])


def collapsed():
    return obj(WAVE.vertices * [1, 0, 0], WAVE.triangles)


def many_flat_faces():
    return obj(WAVE.vertices, [*WAVE.triangles, *[[int(t[0]), int(t[0]), int(t[1])] for t in WAVE.triangles[::3]]])


def stl(count, body=b""):
    return b"\0" * 80 + struct.pack("<I", count) + body


PLY = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"

BAD = {
    "wrong type": ("roof.docx", "text", "is not a mesh file"),
    "no suffix": ("roof", "v 0 0 0", "is not a mesh file"),
    "picture": ("roof.png", b"\x89PNG\r\n", "is not a mesh file"),
    "script": ("roof.py", "print(1)", "is not a mesh file"),
    "empty": ("roof.obj", "", "is empty"),
    "empty ply": ("roof.ply", b"", "is empty"),
    "blank": ("roof.obj", "\n\n  \n", ""),
    "prose": ("roof.obj", "Dear roof,\nthis is a letter.\n", ""),
    "binary junk obj": ("roof.obj", bytes(range(256)) * 20, ""),
    "binary junk ply": ("roof.ply", bytes(range(256)) * 20, "does not hold a mesh"),
    "binary junk stl": ("roof.stl", os.urandom(2000), ""),
    "binary junk glb": ("roof.glb", os.urandom(2000), "does not hold a mesh"),
    "binary junk off": ("roof.off", os.urandom(500), "does not hold a mesh"),
    "zipped": ("roof.obj", gzip.compress(b"v 0 0 0\n" * 50), ""),
    "truncated stl": ("roof.stl", stl(1000, b"\1" * 500), ""),
    "stl without faces": ("roof.stl", stl(0), ""),
    "truncated ply": ("roof.ply", PLY + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0", ""),
    "header only": ("roof.ply", PLY, ""),
    "gltf of nothing": ("roof.gltf", "{}", ""),
    "json": ("roof.gltf", "[1, 2", "does not hold a mesh"),
    "points only": ("roof.obj", obj(WAVE.vertices, []), ""),
    "ply points only": ("roof.ply", PLY + "end_header\n0 0 0\n1 0 0\n0 1 0\n", "no faces"),
    "lines only": ("roof.obj", obj(WAVE.vertices, [], "l 1 2 3\nl 4 5\n"), ""),
    "one triangle": ("roof.obj", obj(np.eye(3), [[0, 1, 2]]), "only 1 face;"),
    "two quads": ("roof.obj", obj([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]],
                                  [[0, 1, 2, 3], [1, 4, 5, 2]]), "only 4 faces;"),
    "nan": ("roof.obj", with_vertex(20, "nan", 0, 0), "not a finite number"),
    "infinite": ("roof.obj", with_vertex(20, 0, "inf", 0), "not a finite number"),
    "words for numbers": ("roof.obj", with_vertex(20, "left", 0, 0), ""),
    "two coordinates": ("roof.obj", "v 0 0\nv 1 0\nv 1 1\nf 1 2 3\n", ""),
    "index beyond the vertices": ("roof.obj", obj(WAVE.vertices, [*WAVE.triangles, [0, 1, 99999]]), ""),
    "two components": ("roof.obj", two_pieces(), r"falls into 2 pieces, the second one near \(.*\) with 50 %"),
    "pieces that touch in a vertex": ("roof.obj", obj(
        np.concatenate([WAVE.vertices, moved(WAVE, WAVE.vertices[-1] - WAVE.vertices[0])]),
        np.concatenate([WAVE.triangles, WAVE.triangles + len(WAVE.vertices)])), "falls into 2 pieces"),
    "non-manifold edge": ("roof.obj", third_face_on_an_edge(), r"3 faces meet in the edge from \(.*\) to \(.*\)"),
    "one-sided": ("roof.obj", moebius(), "one-sided"),
    "all on a line": ("roof.obj", collapsed(), "all faces of the mesh have zero area"),
    "all in a point": ("roof.obj", obj(WAVE.vertices * 0, WAVE.triangles), "across"),
    "many faces of zero area": ("roof.obj", many_flat_faces(), "have zero area, the first one near"),
    "absurdly large": ("roof.obj", obj(WAVE.vertices * 1e15, WAVE.triangles), "sensible unit"),
    "beyond all numbers": ("roof.obj", obj(WAVE.vertices * 1e300, WAVE.triangles), "sensible unit"),
    "absurdly small": ("roof.obj", obj(WAVE.vertices * 1e-14, WAVE.triangles), "sensible unit"),
    "utf-16": ("roof.obj", obj(WAVE.vertices, WAVE.triangles).encode("utf-16"), "not those of such a file"),
    "cut off in a face": ("roof.obj", obj(WAVE.vertices, WAVE.triangles)[:-3] + "x/y", ""),
    "glb cut off": ("roof.glb", trimesh.Trimesh(WAVE.vertices, WAVE.triangles).export(file_type="glb")[:300], ""),
    "binary ply cut off": ("roof.ply", trimesh.Trimesh(WAVE.vertices, WAVE.triangles).export(file_type="ply")[:900], ""),
    "faces of one vertex": ("roof.obj", obj(WAVE.vertices, [[3, 3, 3]] * 40), "across"),
    "far from the origin": ("roof.obj", obj(moved(WAVE, [1e10, 0, 0]), WAVE.triangles), "move it closer"),
}


@pytest.mark.parametrize("name", BAD)
def test_a_bad_mesh_is_one_sentence(name, tmp_path, capfd):
    file, content, words = BAD[name]
    path = tmp_path / file
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(InvalidMesh) as caught:
        read_mesh(path)
    sentence = str(caught.value)
    assert file in sentence
    assert "\n" not in sentence
    assert len(sentence) < 400
    assert re.search(words, sentence)
    assert capfd.readouterr() == ("", "")
    assert isinstance(caught.value, PlisseError)
    assert isinstance(caught.value, ValueError)


def test_missing_files_and_folders_are_named(tmp_path):
    with pytest.raises(InvalidMesh, match=r"there is no mesh file .*hall\.obj"):
        read_mesh(tmp_path / "hall.obj")
    (tmp_path / "hall.obj").mkdir()
    with pytest.raises(InvalidMesh, match="is a folder"):
        read_mesh(tmp_path / "hall.obj")


def test_surfaces_that_cross_themselves_are_meshes_all_the_same(tmp_path):
    turn, across = np.meshgrid(np.linspace(0, 4.5 * np.pi, 60), np.linspace(-1, 1, 8), indexing="ij")
    points = np.stack([np.cos(turn), np.sin(2 * turn), across], axis=-1)
    mesh = grid_mesh(points)
    (tmp_path / "a.obj").write_text(obj(mesh.vertices, mesh.triangles))
    assert len(read_mesh(tmp_path / "a.obj").triangles) == len(mesh.triangles)


def test_more_than_half_a_million_faces_are_refused():
    faces = np.broadcast_to(np.arange(3), (500_001, 3))
    with pytest.raises(InvalidMesh, match="decimate"):
        cleaned(np.eye(3), faces)


def test_the_missing_reader_of_a_format_is_one_sentence(tmp_path, monkeypatch):
    def fail(*_, **__):
        raise ModuleNotFoundError("No module named 'collada'", name="collada")

    monkeypatch.setattr(trimesh, "load_scene", fail)
    (tmp_path / "a.obj").write_text("v 0 0 0")
    with pytest.raises(InvalidMesh, match="needs the Python package collada"):
        read_mesh(tmp_path / "a.obj")


@pytest.mark.parametrize("suffix", ["obj", "ply", "stl", "off", "glb"])
def test_every_common_format_gives_the_same_surface(suffix, tmp_path):
    trimesh.Trimesh(WAVE.vertices, WAVE.triangles, process=False).export(tmp_path / f"wave.{suffix}")
    read = read_mesh(tmp_path / f"wave.{suffix}")
    assert len(read.vertices) == len(WAVE.vertices)
    assert read.area == pytest.approx(WAVE.area, rel=1e-6)
    assert len(read.boundary_loops) == 1
    assert read.normals.mean(axis=0)[2] > 0.9


def test_quads_and_polygons_are_triangulated(tmp_path):
    points = np.stack([*np.meshgrid(np.arange(5.0), np.arange(5.0), indexing="ij"), np.zeros((5, 5))], axis=-1)
    index = np.arange(25).reshape(5, 5)
    quads = np.stack([index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]], axis=-1).reshape(-1, 4)
    hexagon = [[*index[:2, 0], index[2, 0], index[2, 1], index[1, 1], index[0, 1]]]
    (tmp_path / "a.obj").write_text(obj(points.reshape(-1, 3), [*hexagon, *np.delete(quads, [0, 4], axis=0)]))
    read = read_mesh(tmp_path / "a.obj")
    assert read.area == pytest.approx(16)
    assert len(read.triangles) == 4 + 2 * 14


def test_coordinates_stay_in_their_units_and_transformations_of_a_scene_are_applied(tmp_path):
    scene = trimesh.Scene()
    shift = trimesh.transformations.translation_matrix([100, 20, 3])
    scene.add_geometry(trimesh.Trimesh(WAVE.vertices, WAVE.triangles, process=False), transform=shift)
    scene.export(tmp_path / "a.glb")
    read = read_mesh(tmp_path / "a.glb")
    np.testing.assert_allclose(read.vertices.mean(axis=0), WAVE.vertices.mean(axis=0) + shift[:3, 3], atol=1e-5)


def test_accents_in_an_old_encoding_do_not_matter(tmp_path):
    text = "# Dächer für Köln\n" + obj(WAVE.vertices, WAVE.triangles)
    (tmp_path / "a.obj").write_bytes(text.encode("latin-1"))
    assert len(read_mesh(tmp_path / "a.obj").triangles) == len(WAVE.triangles)


def test_flipped_faces_are_turned_and_noted():
    faces = WAVE.triangles.copy()
    faces[::5] = faces[::5, ::-1]
    repaired = cleaned(WAVE.vertices, faces)
    assert (repaired.normals[:, 2] > 0).all()
    assert repaired.notes == (f"{len(faces[::5])} faces were turned over to agree with the others",)


def test_small_pieces_duplicates_and_repeated_faces_are_noted():
    count = len(WAVE.vertices)
    speck = np.array([[7, 7, 7], [7.1, 7, 7], [7, 7.1, 7]])
    vertices = np.concatenate([WAVE.corners.reshape(-1, 3), speck, [[50.0, 50, 50]]])
    faces = np.concatenate([np.arange(len(WAVE.triangles) * 3 + 3).reshape(-1, 3), [[0, 1, 2]]])
    repaired = cleaned(vertices, faces)
    assert len(repaired.vertices) == count
    notes = " | ".join(repaired.notes)
    assert f"{len(WAVE.triangles) * 3 - count} duplicate vertices were merged" in notes
    assert "1 repeated face was removed" in notes
    assert re.search(r"1 separate piece of .* % of the area was dropped, the largest near \(7\.", notes)


def test_a_needle_is_flipped_away_without_a_crack():
    """A vertex on the long edge of a zero-area face: removing the face alone would leave a slit."""
    a, b, c = WAVE.triangles[100]
    twin = WAVE.twins[300] // 3
    middle = len(WAVE.vertices)
    faces = np.concatenate([WAVE.triangles, [[a, middle, b]]])
    faces[100] = [a, middle, c]
    faces = np.concatenate([faces, [[middle, b, c]]])
    faces[-2] = [b, middle, a]
    vertices = np.concatenate([WAVE.vertices, [0.5 * (WAVE.vertices[a] + WAVE.vertices[b])]])
    repaired = cleaned(vertices, faces)
    assert twin >= 0
    assert len(repaired.boundary_loops) == 1
    assert repaired.area == pytest.approx(WAVE.area)
    assert "1 face of zero area was removed" in repaired.notes


def test_a_vertex_where_fans_only_touch_is_split():
    """A vertex whose faces two opposite cuts part into fans."""
    vertex = 38
    around = np.flatnonzero((WAVE.triangles == vertex).any(axis=1))
    ray = WAVE.corners[around].mean(axis=1) - WAVE.vertices[vertex]
    around = around[np.argsort(np.arctan2(ray[:, 1], ray[:, 0]))]
    hole = around[[0, len(around) // 2]]
    repaired = cleaned(WAVE.vertices, np.delete(WAVE.triangles, hole, axis=0))
    assert len(repaired.vertices) == len(WAVE.vertices) + 1
    assert sum(len(loop) for loop in repaired.boundary_loops) == len(repaired.boundary)
    assert "vertex in which parts of the surface only touch was split" in repaired.notes[-1]


def test_boundary_loops_keep_the_surface_on_their_left():
    loop = WAVE.vertices[WAVE.boundary_loops[0]]
    following = np.roll(loop, -1, axis=0)
    assert (loop[:, 0] * following[:, 1] - loop[:, 1] * following[:, 0]).sum() > 0
    assert [len(loop) for loop in Cylinder(1, 2).mesh(20).boundary_loops] == [20, 20]
    assert Sphere(1).mesh(16).boundary_loops == ()


def test_derived_numbers_agree_with_trimesh():
    other = trimesh.Trimesh(WAVE.vertices, WAVE.triangles, process=False)
    assert WAVE.area == pytest.approx(other.area)
    assert WAVE.edge_length == pytest.approx(other.edges_unique_length.mean())
    assert WAVE.diagonal == pytest.approx(other.scale)
    np.testing.assert_allclose(WAVE.normals, other.face_normals, atol=1e-12)
    np.testing.assert_allclose(WAVE.vertex_normals, other.vertex_normals, atol=1e-6)


def test_meshes_of_the_wrong_shape_are_refused():
    with pytest.raises(ValueError, match=r"expected \(V, 3\)"):
        ReferenceMesh(np.zeros((4, 2)), np.zeros((1, 3)))
    with pytest.raises(ValueError, match=r"expected \(F, 3\)"):
        ReferenceMesh(np.zeros((4, 3)), np.zeros((1, 4)))


@pytest.mark.parametrize("seed", range(40))
def test_random_damage_is_repaired_or_named(seed):
    """Missing, turned, doubled, wild and degenerate faces: an oriented manifold comes out, or one sentence."""
    rng = np.random.default_rng(seed)
    vertices, faces = WAVE.vertices.copy(), WAVE.triangles.copy()
    for damage in rng.integers(0, 6, 3):
        if damage == 0:
            faces = faces[rng.random(len(faces)) > 0.1]
        elif damage == 1:
            turned = rng.integers(0, len(faces), 9)
            faces[turned] = faces[turned, ::-1]
        elif damage == 2:
            faces[rng.integers(0, len(faces)), 0] = rng.integers(0, len(vertices))
        elif damage == 3:
            vertices[rng.integers(0, len(vertices))] = vertices[rng.integers(0, len(vertices))]
        elif damage == 4:
            faces = np.concatenate([faces, faces[:3], rng.integers(0, len(vertices), (1, 3))])
        else:
            vertices[rng.integers(0, len(vertices))] *= rng.choice([0, 1e-9, 1e3])
    try:
        repaired = cleaned(vertices, faces)
    except InvalidMesh as error:
        assert "\n" not in str(error)
        return
    directed = repaired.half_edges @ [10**6, 1]
    assert len(np.unique(directed)) == len(directed)
    assert (repaired.areas > 0).all()
    inner = np.flatnonzero(repaired.twins >= 0)
    np.testing.assert_array_equal(repaired.twins[repaired.twins[inner]], inner)
    assert sum(len(loop) for loop in repaired.boundary_loops) == len(repaired.boundary)

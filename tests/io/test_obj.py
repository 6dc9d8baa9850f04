from itertools import pairwise

import numpy as np
import pytest
import trimesh

from plisse.errors import InvalidStructure
from plisse.io.obj import read_obj, write_obj


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def crease_edges(topology):
    edges = topology.edges
    return {frozenset(pair) for pair in edges.vertices[edges.is_crease].tolist()}


def without(path, keyword):
    lines = path.read_text(encoding="utf-8").splitlines()
    path.write_text("\n".join(line for line in lines if not line.startswith(keyword + " ")), encoding="utf-8")


def test_a_round_trip_keeps_every_digit_and_every_label(structure, tmp_path):
    write_obj(structure, tmp_path / "s.obj", title="a\nb")
    back = read_obj(tmp_path / "s.obj")
    assert np.array_equal(back.vertices, structure.vertices)
    assert np.array_equal(back.topology.quads, structure.topology.quads)


def test_writing_twice_gives_the_same_bytes(structure, tmp_path):
    write_obj(structure, tmp_path / "a.obj")
    write_obj(structure, tmp_path / "b.obj")
    assert (tmp_path / "a.obj").read_bytes() == (tmp_path / "b.obj").read_bytes()


def test_other_readers_see_the_same_surface(structure, tmp_path):
    write_obj(structure, tmp_path / "s.obj")
    without(tmp_path / "s.obj", "l")
    mesh = trimesh.load(tmp_path / "s.obj", process=False)
    assert len(mesh.faces) == 2 * structure.topology.face_count
    assert np.allclose(mesh.bounds, [structure.vertices.min(axis=0), structure.vertices.max(axis=0)])


def test_every_crease_is_a_polyline_of_the_file(structure, tmp_path):
    write_obj(structure, tmp_path / "s.obj")
    lines = [list(map(int, line.split()[1:])) for line in (tmp_path / "s.obj").read_text().splitlines()
             if line.startswith("l ")]
    assert len(lines) == len(structure.topology.creases)
    edges = {frozenset((a - 1, b - 1)) for line in lines for a, b in pairwise(line)}
    assert edges == crease_edges(structure.topology)


def test_without_polylines_the_sharper_folds_are_the_creases(structure, tmp_path):
    write_obj(structure, tmp_path / "s.obj")
    without(tmp_path / "s.obj", "l")
    text = (tmp_path / "s.obj").read_text()
    shifted = ["f " + " ".join([*line.split()[2:], line.split()[1]]) if line.startswith("f ") else line
               for line in text.splitlines()]
    (tmp_path / "s.obj").write_text("\n".join(shifted))
    assert crease_edges(read_obj(tmp_path / "s.obj").topology) == crease_edges(structure.topology)


def test_negative_indices_slashes_and_turned_faces_are_understood(tmp_path):
    rows = "\n".join(f"v {x} {y} {(x + y) % 2}" for y in range(2) for x in range(3))
    (tmp_path / "s.obj").write_text(f"\ufeff{rows}\nvn 0 0 1\nf 1/1/1 2//1 5 4\nf 2 -1 -4 5\nf 2 3 6 5\n"
                                    .replace("f 2 -1 -4 5\n", ""), encoding="utf-8")
    assert read_obj(tmp_path / "s.obj").topology.face_count == 2
    (tmp_path / "t.obj").write_text(rows + "\nf -6 -5 -2 -3\nf 5 6 3 2\n")
    assert read_obj(tmp_path / "t.obj").topology.face_count == 2
    (tmp_path / "u.obj").write_text(rows + "\nf 1 2 5 4\nf 5 6 3 2\nl 1 2 3\n")
    assert len(read_obj(tmp_path / "u.obj").topology.creases) == 2


@pytest.mark.parametrize(("text", "sentence"), [
    ("", "no faces"),
    ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "face 1 has 3 edges"),
    ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 nan 0\nf 1 2 3 4\n", "vertex 4 .* finite"),
    ("v 0 0 0\nv 1 0\nf 1 2 3 4\n", "line 2"),
    ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 7\n", "outside 1 to 4"),
    ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 0\n", "line 5"),
    ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 3\n", "uses a vertex twice"),
])
def test_what_is_no_quad_mesh_is_one_sentence(tmp_path, text, sentence):
    (tmp_path / "bad.obj").write_text(text)
    with pytest.raises(InvalidStructure, match=sentence):
        read_obj(tmp_path / "bad.obj")


def test_edges_with_three_faces_are_refused(tmp_path):
    rows = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0), (0, 0, 1), (1, 0, 1), (0, -1, 0), (1, -1, 0)]
    text = "\n".join("v {} {} {}".format(*row) for row in rows) + "\nf 1 2 4 3\nf 1 2 6 5\nf 1 2 8 7\n"
    (tmp_path / "book.obj").write_text(text)
    with pytest.raises(InvalidStructure, match="more than two faces"):
        read_obj(tmp_path / "book.obj")


def test_a_missing_file_and_binary_junk_are_one_sentence(tmp_path):
    with pytest.raises(InvalidStructure, match="there is no file"):
        read_obj(tmp_path / "missing.obj")
    (tmp_path / "junk.obj").write_bytes(bytes(range(256)))
    with pytest.raises(InvalidStructure, match="not text"):
        read_obj(tmp_path / "junk.obj")

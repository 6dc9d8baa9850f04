import json

import numpy as np
import pytest

from plisse.errors import InvalidStructure
from plisse.io.fold import fold_document, read_fold, write_fold
from plisse.measure.folds import fold_angles
from plisse.structure.pleated import PleatedStructure


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def document_of(structure, tmp_path):
    write_fold(structure, tmp_path / "s.fold", title="two words", units="cm")
    return json.loads((tmp_path / "s.fold").read_text(encoding="utf-8"))


def test_a_round_trip_keeps_every_digit_and_every_label(structure, tmp_path):
    write_fold(structure, tmp_path / "s.fold")
    back = read_fold(tmp_path / "s.fold")
    assert np.array_equal(back.vertices, structure.vertices)
    assert np.array_equal(back.topology.quads, structure.topology.quads)
    assert np.array_equal(back.topology.edges.is_crease, structure.topology.edges.is_crease)
    assert np.array_equal(back.cut.source, structure.cut.source)
    assert np.array_equal(back.cut.topology.quads, structure.cut.topology.quads)
    assert np.array_equal(np.abs(back.development), np.abs(structure.development))


def test_writing_twice_gives_the_same_bytes(structure, tmp_path):
    write_fold(structure, tmp_path / "a.fold")
    write_fold(read_fold(tmp_path / "a.fold"), tmp_path / "b.fold")
    assert (tmp_path / "a.fold").read_bytes() == (tmp_path / "b.fold").read_bytes()


def test_the_key_frame_is_a_flat_pattern_and_the_second_frame_its_folded_form(structure, tmp_path):
    document = document_of(structure, tmp_path)
    folded, = document["file_frames"]
    assert document["file_spec"] == 1.2
    assert document["file_classes"] == ["singleModel"]
    assert document["frame_classes"] == ["creasePattern"] and "2D" in document["frame_attributes"]
    assert folded["frame_classes"] == ["foldedForm"] and "3D" in folded["frame_attributes"]
    assert folded["frame_parent"] == 0 and folded["frame_inherit"] is True
    assert document["frame_unit"] == "cm" and document["file_title"] == "two words"
    assert np.shape(document["vertices_coords"]) == (len(structure.cut.source), 2)
    assert np.shape(folded["vertices_coords"]) == (len(structure.cut.source), 3)
    assert all(":" in key for key in document if key.split("_")[1].startswith("plisse"))


def test_signs_of_fold_angles_agree_with_assignments_as_fold_demands(structure, tmp_path):
    document = document_of(structure, tmp_path)
    angles = np.array(document["edges_foldAngle"])
    letters = np.array(document["edges_assignment"])
    assert set(letters) == set("MVFB")
    assert (angles[letters == "M"] < -1).all() and (angles[letters == "V"] > 1).all()
    assert (angles[(letters == "F") | (letters == "B")] == 0).all()
    kinds = np.array(document["edges_plisse:kind"])
    assert (kinds[(letters == "M") | (letters == "V")] == "crease").all()
    assert (kinds[letters == "F"] == "ruling").all()


def test_boundary_edges_have_one_face_and_others_two(structure, tmp_path):
    document = document_of(structure, tmp_path)
    count: dict[frozenset, int] = {}
    for face in document["faces_vertices"]:
        for edge in zip(face, face[1:] + face[:1], strict=True):
            count[frozenset(edge)] = count.get(frozenset(edge), 0) + 1
    for edge, letter in zip(document["edges_vertices"], document["edges_assignment"], strict=True):
        assert count.pop(frozenset(edge)) == (1 if letter == "B" else 2)
    assert not count


def test_faces_run_counterclockwise_even_where_the_development_was_mirrored(structure):
    mirrored = PleatedStructure(structure.topology, structure.vertices, structure.cut,
                                structure.development * [1.0, -1.0])
    for subject in (structure, mirrored):
        document = fold_document(subject)
        flat, faces = np.array(document["vertices_coords"]), np.array(document["faces_vertices"])
        first, second = flat[faces[:, 2]] - flat[faces[:, 0]], flat[faces[:, 3]] - flat[faces[:, 1]]
        assert (first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0] > 0).all()


def test_bends_of_rulings_are_kept_apart(structure, tmp_path):
    document = document_of(structure, tmp_path)
    bends = np.array(document["edges_plisse:rulingAngle"])
    true = np.degrees(fold_angles(structure.opened.topology, structure.opened.vertices))
    rulings = np.array(document["edges_plisse:kind"]) == "ruling"
    assert np.array_equal(bends[rulings], true[rulings]) and (bends[~rulings] == 0).all()
    assert np.abs(bends).max() > 0.1


def test_files_of_others_are_labelled_by_their_mountains_and_valleys(cones, tmp_path):
    document = {key: value for key, value in fold_document(cones).items() if "plisse" not in key}
    document["faces_vertices"] = [face[1:] + face[:1] for face in document["faces_vertices"]]
    document["faces_vertices"][3].reverse()
    (tmp_path / "foreign.fold").write_text(json.dumps(document))
    back = read_fold(tmp_path / "foreign.fold")
    edges = cones.topology.edges
    creases = {frozenset(pair) for pair in edges.vertices[edges.is_crease].tolist()}
    found = back.topology.edges
    assert {frozenset(pair) for pair in found.vertices[found.is_crease].tolist()} == creases


@pytest.mark.parametrize(("text", "sentence"), [
    ("{", "does not hold valid JSON"),
    ("[1, 2]", "not an object"),
    ("{}", "no faces_vertices"),
    ('{"faces_vertices": [[0, 1, 2]], "vertices_coords": [[0, 0], [1, 0], [1, 1]]}', "face 1 has 3 edges"),
    ('{"faces_vertices": [[0, 1, 2, 9]], "vertices_coords": [[0, 0], [1, 0], [1, 1]]}', "does not name"),
    ('{"faces_vertices": [[0, 1, 2, 3]], "vertices_coords": [[0, 0], [1, 0], [1, 1], ["x", 1]]}', "numbers"),
    ('{"faces_vertices": [[0, 1, 2, 3]], "vertices_coords": [[0, 0], [1, 0], [1, 1], [NaN, 1]]}', "finite"),
])
def test_what_is_no_structure_is_one_sentence(tmp_path, text, sentence):
    (tmp_path / "bad.fold").write_text(text)
    with pytest.raises(InvalidStructure, match=sentence):
        read_fold(tmp_path / "bad.fold")


def test_three_quads_around_a_vertex_have_no_creases_and_rulings(tmp_path):
    document = {"vertices_coords": [[0, 0], [2, 0], [2, 2], [0, 2], [-2, 1], [-2, -1], [0, -2]],
                "faces_vertices": [[0, 1, 2, 3], [0, 3, 4, 5], [0, 5, 6, 1]]}
    (tmp_path / "cube.fold").write_text(json.dumps(document))
    with pytest.raises(InvalidStructure, match="odd number of faces"):
        read_fold(tmp_path / "cube.fold")


def test_without_development_there_is_no_fold_file(cones, tmp_path):
    with pytest.raises(InvalidStructure, match="flatten it first"):
        write_fold(cones.with_vertices(cones.vertices), tmp_path / "s.fold")
    assert list(tmp_path.iterdir()) == []


def test_a_missing_file_and_binary_junk_are_one_sentence(tmp_path):
    with pytest.raises(InvalidStructure, match="there is no file"):
        read_fold(tmp_path / "missing.fold")
    (tmp_path / "junk.fold").write_bytes(bytes(range(256)))
    with pytest.raises(InvalidStructure, match="JSON"):
        read_fold(tmp_path / "junk.fold")

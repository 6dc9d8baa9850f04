"""Models made elsewhere: labels from folds, welding, objects, units."""

import json

import numpy as np
import pytest

from plisse.errors import InvalidStructure
from plisse.io.fold import fold_document, load_fold, read_fold
from plisse.io.labels import folding_evidence, labelled_topology
from plisse.io.obj import load_obj, write_obj
from plisse.io.structures import read_model
from plisse.structure.exact import alternating_cones, conic_creases, marched, miura
from plisse.structure.pleated import PleatedStructure


def crease_edges(topology):
    edges = topology.edges
    return {frozenset(pair) for pair in edges.vertices[edges.is_crease].tolist()}


def obj_of(faces, points, *heads):
    rows = [f"v {x!r} {y!r} {z!r}" for x, y, z in points.tolist()]
    return "\n".join([*heads, *rows, *("f " + " ".join(str(v + 1) for v in face) for face in faces)]) + "\n"


@pytest.mark.parametrize("structure", [alternating_cones(), alternating_cones(closed=True), conic_creases(), marched()],
                         ids=["cones", "closed cones", "conics", "marched"])
def test_pleats_fold_further_than_strips_bend_whatever_the_faces_begin_with(structure):
    topology = structure.topology
    turned = [face[k % 4:] + face[:k % 4] for k, face in enumerate(topology.faces)]
    turned = [face[::-1] if k % 3 == 0 else face for k, face in enumerate(turned)]
    found = labelled_topology(topology.vertex_count, turned, folding_evidence(structure.vertices, turned))
    assert crease_edges(found) == crease_edges(topology)


def test_fold_files_without_assignments_are_labelled_by_their_folds(cones, tmp_path):
    document = {key: value for key, value in fold_document(cones).items()
                if key.startswith(("file", "frame", "vertices_coords", "faces_vertices"))}
    document["faces_vertices"] = [face[1:] + face[:1] for face in document["faces_vertices"]]
    (tmp_path / "bare.fold").write_text(json.dumps(document))
    assert crease_edges(read_fold(tmp_path / "bare.fold").topology) == crease_edges(cones.topology)
    document["edges_vertices"] = cones.topology.edges.vertices.tolist()
    document["edges_assignment"] = ["U"] * len(document["edges_vertices"])
    (tmp_path / "unassigned.fold").write_text(json.dumps(document))
    assert crease_edges(read_fold(tmp_path / "unassigned.fold").topology) == crease_edges(cones.topology)


@pytest.mark.parametrize(("unit", "scale", "units"), [("cm", 1.0, "cm"), ("pt", 25.4 / 72, "mm"), ("um", 1e-3, "mm"),
                                                      ("unit", 1.0, "mm"), (None, 1.0, "mm"), ({}, 1.0, "mm")])
def test_units_of_fold_files_are_kept_or_made_millimetres(cones, tmp_path, unit, scale, units):
    (tmp_path / "s.fold").write_text(json.dumps(fold_document(cones) | {"frame_unit": unit}))
    model = load_fold(tmp_path / "s.fold")
    assert model.units == units
    assert np.allclose(model.structure.vertices, scale * cones.vertices, rtol=1e-15)
    assert np.allclose(np.abs(model.structure.development), scale * np.abs(cones.development), rtol=1e-15)


def test_obj_files_of_ours_say_their_unit_and_their_title(cones, tmp_path):
    write_obj(cones, tmp_path / "s.obj", title="two words", units="in")
    model = read_model(tmp_path / "s.obj")
    assert (model.units, model.title) == ("in", "two words")
    (tmp_path / "bare.obj").write_text(obj_of(cones.topology.faces, cones.vertices))
    assert (load_obj(tmp_path / "bare.obj").units, read_model(tmp_path / "bare.obj").title) == ("mm", "bare")


def test_faces_that_came_apart_on_export_are_welded_in_place(cones, tmp_path):
    corners = cones.topology.quads.ravel()
    faces = np.arange(len(corners)).reshape(-1, 4).tolist()
    (tmp_path / "apart.obj").write_text(obj_of(faces, cones.vertices[corners]))
    back = load_obj(tmp_path / "apart.obj").structure
    assert back.topology.vertex_count == 175 and back.topology.components == 1
    assert len(crease_edges(back.topology)) == len(crease_edges(cones.topology))
    assert np.array_equal(back.vertices[back.topology.quads][:, 0], cones.vertices[cones.topology.quads][:, 0])


def test_polylines_with_vertices_of_their_own_are_laid_on_the_mesh(cones, tmp_path):
    text = obj_of(cones.topology.faces, cones.vertices, "o mesh")
    for crease in cones.topology.creases:
        points = cones.vertices[crease.vertices] + 1e-7
        text += "o curve\n" + "".join(f"v {x:.7f} {y:.7f} {z:.7f}\n" for x, y, z in points.tolist())
        text += "l " + " ".join(str(k - len(points)) for k in range(len(points))) + "\n"
    (tmp_path / "curves.obj").write_text(text)
    model = load_obj(tmp_path / "curves.obj")
    assert crease_edges(model.structure.topology) == crease_edges(cones.topology)
    assert model.title == "mesh" and model.structure.topology.vertex_count == 175
    (tmp_path / "astray.obj").write_text(text + "v 1 2 3\nl -1 1\n")
    with pytest.raises(InvalidStructure, match="no edge of a face"):
        load_obj(tmp_path / "astray.obj")


def test_a_sheet_in_one_piece_is_not_glued_where_it_touches_itself(closed_cones, tmp_path):
    opened = closed_cones.opened
    (tmp_path / "slit.obj").write_text(obj_of(opened.topology.faces, opened.vertices))
    assert load_obj(tmp_path / "slit.obj").structure.topology.euler_characteristic == 1


def test_several_objects_in_one_file_are_one_sentence_with_their_names(tmp_path):
    leaf = miura(3, 3)
    faces = leaf.topology.faces
    first = obj_of(faces, leaf.vertices, "o left leaf")
    second = "o right\n" + "\n".join(f"v {x} {y} {z + 9}" for x, y, z in leaf.vertices.tolist()) + "\n"
    second += "".join("f " + " ".join(str(v + 10) for v in face) + "\n" for face in faces)
    (tmp_path / "two.obj").write_text(first + second)
    with pytest.raises(InvalidStructure, match=r"holds 2 objects \(left leaf, right\)"):
        load_obj(tmp_path / "two.obj")
    (tmp_path / "one.obj").write_text("o camera\n" + first)
    assert load_obj(tmp_path / "one.obj").title == "left leaf"


def test_titles_are_one_line_that_every_format_can_hold(cones, tmp_path):
    (tmp_path / "s.fold").write_text(json.dumps(fold_document(cones, title="a\n\0b \x07 c")))
    assert load_fold(tmp_path / "s.fold").title == "a b c"


def test_to_fold_is_the_document_of_the_file(cones):
    assert cones.to_fold(title="x", units="cm") == fold_document(cones, title="x", units="cm")
    with pytest.raises(InvalidStructure, match="flatten it first"):
        PleatedStructure(cones.topology, cones.vertices).to_fold()

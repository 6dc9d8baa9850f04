import json

import numpy as np
import pytest
from fold_spec import violations

from plisse.io.fold import read_fold, write_fold
from plisse.structure.exact import conic_creases


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def document_of(structure, path, **options):
    write_fold(structure, path, **options)
    return json.loads(path.read_text(encoding="utf-8"))


@pytest.mark.parametrize("curves", [False, True])
def test_the_file_keeps_the_fold_specification(structure, tmp_path, curves):
    assert violations(document_of(structure, tmp_path / "s.fold", curves=curves)) == []


def test_the_check_against_the_specification_can_fail(cones, tmp_path):
    document = document_of(cones, tmp_path / "s.fold")
    letters, angles = document["edges_assignment"], document["edges_foldAngle"]
    mountain = letters.index("M")
    for change in ({"edges_assignment": [*letters[:-1], "X"]},
                   {"edges_foldAngle": [90.0 if k == mountain else angle for k, angle in enumerate(angles)]},
                   {"edges_foldAngle": angles[:-1]}, {"faces_vertices": document["faces_vertices"][1:]},
                   {"edges_controlPoints": [None] * len(letters)}, {"file_classes": ["pleats"]}):
        assert violations(document | change)


@pytest.mark.parametrize("frame", ["flat", "folded"])
def test_crease_edges_are_cubic_and_begin_and_end_in_their_vertices(structure, tmp_path, frame):
    document = document_of(structure, tmp_path / "s.fold", curves=True)
    source = document if frame == "flat" else document | document["file_frames"][0]
    points, kinds = np.array(source["vertices_coords"]), source["edges_plisse:kind"]
    for edge, controls, degree, kind in zip(source["edges_vertices"], source["edges_plisse:controlPoints"],
                                            source["edges_plisse:degree"], kinds, strict=True):
        assert (controls is not None) == (kind == "crease") and degree == (3 if kind == "crease" else 1)
        if controls is not None:
            assert len(controls) == degree + 1
            assert np.array_equal(np.array(controls)[[0, -1]], points[edge])


def test_the_splines_of_circles_are_circles(structure, tmp_path):
    document = document_of(structure, tmp_path / "s.fold", curves=True)
    pieces = np.array([c for c in document["file_frames"][0]["edges_plisse:controlPoints"] if c is not None])
    middle = np.einsum("k,ekd->ed", [1 / 8, 3 / 8, 3 / 8, 1 / 8], pieces)
    radius = np.hypot(pieces[:, 0, 0], pieces[:, 0, 1])
    # a spline through 24 points around is within 1e-4 radii of the circle, chords are 9e-3 off; natural ends are worse
    assert np.median(np.abs(np.hypot(*middle[:, :2].T) / radius - 1)) < 1e-4


def test_readers_that_know_nothing_of_curves_lose_nothing(tmp_path):
    structure = conic_creases()
    write_fold(structure, tmp_path / "curved.fold", curves=True)
    assert np.array_equal(read_fold(tmp_path / "curved.fold").vertices, structure.vertices)

"""Every file that is offered is what the library writes."""

import json

import numpy as np
import pytest

import plisse
from plisse.draw.camera import Camera
from plisse.errors import InvalidDesign, InvalidStructure
from plisse.result import Report, Result
from plisse.studio.downloads import KINDS, Order, made

BEGINNINGS = {".3dm": b"3D Geometry File", ".glb": b"glTF", ".pdf": b"%PDF", ".png": b"\x89PNG", ".3mf": b"PK"}


@pytest.fixture(scope="module")
def result():
    return plisse.design({"curve": {"kind": "arc", "radius": 60, "angle": 60}, "solve": {"principal": True},
                          "pattern": {"theta": 25, "creases": 4, "width": 5, "amplitude": 3, "samples": 15}})


@pytest.fixture(autouse=True)
def quick(monkeypatch):
    """Small pictures without cast light."""
    monkeypatch.setattr("plisse.io.page.STILL", (150, 100))
    monkeypatch.setattr("plisse.studio.downloads.PIXELS", (160, 120))
    monkeypatch.setattr("plisse.studio.downloads.FRAMES", 3)
    monkeypatch.setattr("plisse.draw.light.can_cast", lambda: False)


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_made(result, kind):
    content = made(Order(result, "a small <arc>", length=0.2), kind)
    suffix = "." + KINDS[kind][0].rpartition(".")[2]
    assert content.startswith(BEGINNINGS.get(suffix, b""))
    assert len(content) > 400


def test_the_fold_file_is_the_structure(result):
    document = json.loads(made(Order(result, "arc"), "FOLD"))
    found = np.array(document["file_frames"][0]["vertices_coords"])
    assert np.abs(found - result.structure.vertices).max() < 1e-9


def test_offsets_and_plates_have_the_length_that_was_asked_for(result):
    document = json.loads(made(Order(result, "arc", length=0.3), "offset, FOLD"))
    found = np.array(document["file_frames"][0]["vertices_coords"])
    assert np.abs(found - result.structure.offset(0.3).vertices).max() < 1e-9
    with pytest.raises(InvalidDesign):
        made(Order(result, "arc", length=1e3), "plates, STL")


def test_pictures_are_taken_from_where_the_camera_stands_and_in_its_colours(result):
    plain = made(Order(result, "arc"), "picture, PNG")
    assert made(Order(result, "arc", camera=Camera(np.eye(3))), "picture, PNG") != plain
    assert made(Order(result, "arc", colour="opening"), "picture, PNG") != plain
    assert made(Order(result, "arc", percent=20.0), "picture, PNG") != plain


def test_what_has_no_structure_has_a_report_and_says_so_for_the_rest(result):
    broken = Result(result.design, Report(status="infeasible", reasons=["the curve breaks down"]))
    assert json.loads(made(Order(broken, "x"), "report, JSON"))["status"] == "infeasible"
    for kind in KINDS:
        if kind != "report, JSON":
            with pytest.raises(InvalidStructure, match="broke down"):
                made(Order(broken, "x"), kind)

"""Every file that is offered is what the library writes."""

import json

import numpy as np
import pytest

import plisse
from plisse.errors import InvalidStructure
from plisse.result import Report, Result
from plisse.studio.downloads import KINDS, made

BEGINNINGS = {".3dm": b"3D Geometry File", ".glb": b"glTF", ".pdf": b"%PDF", ".png": b"\x89PNG", ".3mf": b"PK"}


@pytest.fixture(scope="module")
def result():
    return plisse.design({"curve": {"kind": "arc", "radius": 60, "angle": 60}, "solve": {"principal": True},
                          "pattern": {"theta": 25, "creases": 4, "width": 5, "amplitude": 3, "samples": 15}})


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_is_made(result, kind, monkeypatch):
    monkeypatch.setattr("plisse.io.page.STILL", (150, 100))
    monkeypatch.setattr("plisse.draw.light.can_cast", lambda: False)
    content = made(result, "a small <arc>", kind)
    suffix = "." + KINDS[kind][0].rpartition(".")[2]
    assert content.startswith(BEGINNINGS.get(suffix, b""))
    assert len(content) > 400


def test_the_fold_file_is_the_structure(result):
    document = json.loads(made(result, "arc", "FOLD"))
    found = np.array(document["file_frames"][0]["vertices_coords"])
    assert np.abs(found - result.structure.vertices).max() < 1e-9


def test_what_has_no_structure_has_a_report_and_says_so_for_the_rest(result):
    broken = Result(result.design, Report(status="infeasible", reasons=["the curve breaks down"]))
    assert json.loads(made(broken, "x", "report, JSON"))["status"] == "infeasible"
    for kind in KINDS:
        if kind != "report, JSON":
            with pytest.raises(InvalidStructure, match="broke down"):
                made(broken, "x", kind)

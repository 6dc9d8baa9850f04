"""`plisse render` and `plisse report`: files, and one sentence for what they cannot do."""

import sys

import numpy as np
import pytest
from PIL import Image

import plisse
from plisse.cli import main
from plisse.designs.deviations import deviation_again
from plisse.draw.colour_maps import deviation_of
from plisse.io.fold import write_fold
from plisse.io.obj import write_obj
from plisse.io.report import read_report, write_report

EVOLVED = {"curve": {"kind": "spline", "points": [[80, -60, -8], [97, -30, -2], [103, 2, 1], [98, 34, 5], [82, 64, 12]]},
           "pattern": {"theta": 30, "creases": 5, "width": 5, "amplitude": 3, "samples": 41}}
GUIDED = {"surface": {"height": "12*sin(x/45)*cos(y/60)", "x": [-60, 60], "y": [-50, 50],
                      "guide": [[-40, -8, 0], [40, 8, 0]]},
          "pattern": {"theta": 50, "width": 6, "amplitude": 3, "creases": 6, "samples": 25}}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("made")
    result = plisse.design(EVOLVED)
    write_fold(result.structure, folder / "structure.fold", title="five creases")
    write_report(result.report, folder / "report.json")
    return folder, result


@pytest.fixture(autouse=True)
def small_still(monkeypatch):
    """Pages whose picture does not matter are made faster."""
    monkeypatch.setattr("plisse.io.page.STILL", (150, 100))


def run(*tokens):
    return main([str(token) for token in tokens])


def test_a_picture_of_the_size_and_kind_asked_for(made, tmp_path, capsys):
    folder, _ = made
    target = tmp_path / "a.png"
    assert run("render", folder / "structure.fold", "-o", target, "--size", "320x200", "--view", "20,30", "--colour",
               "deviation", "--no-ambient") == 0
    assert capsys.readouterr().out.strip() == str(target)
    with Image.open(target) as image:
        assert image.size == (320, 200)
    assert run("render", folder / "structure.fold", "-o", tmp_path / "b.png", "--size", "320x200", "--transparent",
               "--no-creases", "--no-ambient", "--quiet") == 0
    with Image.open(tmp_path / "b.png") as image:
        assert np.asarray(image)[..., 3].min() == 0


def test_a_gif_turns(made, tmp_path):
    assert run("render", made[0] / "structure.fold", "-o", tmp_path / "a.gif", "--size", "160x120", "--frames", "4",
               "--no-ambient") == 0
    with Image.open(tmp_path / "a.gif") as image:
        assert image.n_frames == 4


@pytest.mark.parametrize("options, sentence", [
    (["-o", "a.jpg"], "no picture"), (["-o", "a.png", "--size", "3x3"], "--size"),
    (["-o", "a.png", "--view", "behind"], "--view"),
    (["-o", "a.gif", "--transparent"], "transparency"), (["-o", "a.gif", "--frames", "1"], "--frames"),
    (["-o", "a.png", "--frames", "4"], ".gif that turns"),
    (["-o", "none/a/b.png", "--size", "100x100", "--view", "x"], "--view")])
def test_what_render_cannot_do_is_one_sentence_and_no_file(made, tmp_path, monkeypatch, capsys, options, sentence):
    monkeypatch.chdir(tmp_path)
    assert run("render", made[0] / "structure.fold", *options) == 1
    complaint = capsys.readouterr().err
    assert complaint.count("\n") == 1 and sentence in complaint
    assert list(tmp_path.iterdir()) == []


def test_without_embree_pictures_are_made_all_the_same_unless_cast_light_is_asked_for(made, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("plisse.draw.light.can_cast", lambda: False)
    monkeypatch.setitem(sys.modules, "embreex", None)
    assert run("render", made[0] / "structure.fold", "-o", tmp_path / "a.png", "--size", "100x80", "--quiet") == 0
    assert run("render", made[0] / "structure.fold", "-o", tmp_path / "b.png", "--ambient") == 1
    assert 'pip install "plisse[render]"' in capsys.readouterr().err
    assert not (tmp_path / "b.png").exists()


def test_a_deviation_needs_a_report(made, tmp_path, capsys):
    lonely = tmp_path / "structure.fold"
    lonely.write_bytes((made[0] / "structure.fold").read_bytes())
    assert run("render", lonely, "-o", tmp_path / "a.png", "--colour", "deviation") == 1
    assert "report.json" in capsys.readouterr().err


def test_a_report_page_beside_its_structure_tells_the_recipe_and_one_without_measures(made, tmp_path, capsys):
    folder, result = made
    assert run("report", folder / "structure.fold") == 0
    page = (folder / "report.html").read_text(encoding="utf-8")
    assert "five creases" in page and "kind = &quot;spline&quot;" in page and repr(result.report.planarity.max) in page
    lonely = tmp_path / "alone.fold"
    lonely.write_bytes((folder / "structure.fold").read_bytes())
    assert run("report", lonely, "-o", tmp_path / "page.html", "--quiet") == 0
    assert "The recipe" not in (tmp_path / "page.html").read_text(encoding="utf-8")
    assert run("report", lonely, "-o", tmp_path / "page.pdf") == 1
    assert ".html" in capsys.readouterr().err


def test_a_report_of_another_structure_is_left_alone(made, tmp_path):
    folder, result = made
    for name in ("structure.fold", "report.json"):
        (tmp_path / name).write_bytes((folder / name).read_bytes())
    text = (tmp_path / "report.json").read_text().replace(f'"vertices": {result.report.vertices}', '"vertices": 7')
    (tmp_path / "report.json").write_text(text)
    assert run("report", tmp_path / "structure.fold", "--quiet") == 0
    assert "The recipe" not in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_deviations_measured_again_from_the_recipe_are_those_of_the_result(made):
    for result in (made[1], plisse.design(GUIDED)):
        before, after = deviation_of(result), deviation_again(result.structure, result.report)
        assert np.allclose(after.values, before.values, atol=1e-9, equal_nan=True)
        told = result.report.deviation.max_amplitudes if result.report.deviation else result.report.crease_deviation.max
        assert before.largest == pytest.approx(told, rel=1e-9)


def test_reports_read_back(made):
    assert read_report(made[0] / "report.json").planarity == made[1].report.planarity


def test_a_mesh_that_lies_flat_has_its_sheet_on_the_page_and_one_that_does_not_says_why(made, tmp_path):
    structure = made[1].structure
    bent = structure.vertices + [0, 0, 1] * (np.arange(len(structure.vertices)) == 60)[:, None]
    write_obj(structure, tmp_path / "model.obj")
    write_obj(structure.with_vertices(bent), tmp_path / "bent.obj")
    for name in ("model", "bent"):
        assert run("report", tmp_path / f"{name}.obj", "-o", tmp_path / f"{name}.html", "--quiet") == 0
    model, bent_page = ((tmp_path / f"{name}.html").read_text(encoding="utf-8") for name in ("model", "bent"))
    assert "The flat sheet" in model and "paper needed for the flat state" in model
    assert "The flat sheet" not in bent_page and "There is no flat sheet" in bent_page

"""`plisse parallel` and `plisse strips`: files that read back as exact, pictures, and one sentence for what is wrong."""

import csv
import json
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import trimesh
from PIL import Image

from plisse.cli.app import main
from plisse.io.fold import read_fold, write_fold
from plisse.io.obj import read_obj
from plisse.structure.exact import alternating_cones, conic_creases
from plisse.transform.edge_scales import ParallelSpace


@pytest.fixture
def without_pictures(monkeypatch):
    """Pictures take seconds; where they are not the point a file stands for them."""
    for name in ("plisse.draw.family.write_family", "plisse.draw.strips.write_strips_picture"):
        monkeypatch.setattr(name, lambda subject, path, **rest: path.write_bytes(b"picture"))


@pytest.fixture
def structure(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    shape = conic_creases(5, 16)
    write_fold(shape, tmp_path / "base.fold")
    return shape


@pytest.mark.parametrize("options", [
    ["--widths", "2"], ["--widths", "0:1,1:2"], ["--growth", "1.1"], ["--move", "3,1:0.01,0,0.02"], ["--refine-fold", "3"],
    ["--refine-fold", "all", "--rounds", "2", "--fraction", "0.25"], ["--widths", "2", "--refine-fold", "2", "--at", "50"]])
def test_what_is_written_is_exact_and_principal(structure, without_pictures, tmp_path, capsys, options):
    assert main(["parallel", "base.fold", *options, "-o", "out.fold", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["status"] == "exact"
    assert report["principal"]
    assert report["angle_defect"]["max"] < 1e-12
    found = read_fold(tmp_path / "out.fold")
    assert len(found.vertices) == report["vertices"]
    assert (tmp_path / "out.png").is_file()
    if "--refine-fold" not in options:
        space = ParallelSpace(structure)
        scales = space.scales(found.vertices)
        assert report["edge_scales"] == pytest.approx({"min": scales.min(), "max": scales.max()})
        ends = structure.topology.edges.vertices
        assert np.abs(found.vertices[ends[:, 1]] - found.vertices[ends[:, 0]]
                      - scales[:, None] * space.directions).max() < 1e-11


def test_handles_and_meshes_from_files(structure, without_pictures, tmp_path, capsys):
    crease = structure.topology.creases[2].vertices
    place = structure.vertices[crease[3]] + [0.01, 0.0, 0.0]
    (tmp_path / "handles.csv").write_text("crease,point,x,y,z\n3,4," + ",".join(map(repr, place.tolist())) + "\n")
    assert main(["parallel", "base.fold", "--handles", "handles.csv", "-o", "h.obj", "--quiet"]) == 0
    assert np.linalg.norm(read_obj(tmp_path / "h.obj").vertices[crease[3]] - place) < 1e-3
    assert main(["parallel", "base.fold", "--widths", "1.5", "-o", "wide.fold", "--quiet"]) == 0
    assert main(["parallel", "base.fold", "--near", "wide.fold", "-o", "again.fold", "--quiet"]) == 0
    assert read_fold(tmp_path / "again.fold").vertices == pytest.approx(read_fold(tmp_path / "wide.fold").vertices, abs=1e-6)
    assert capsys.readouterr().out == ""


def test_closed_structures_open_for_what_does_not_close(tmp_path, without_pictures, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    write_fold(alternating_cones(4, 20, closed=True), tmp_path / "ring.fold")
    assert main(["parallel", "ring.fold", "--lengths", "0:1,1:1.4", "-o", "out.fold"]) == 1
    assert "contradict" in capsys.readouterr().err
    assert main(["parallel", "ring.fold", "--lengths", "0:1,1:1.4", "--open", "-o", "out.fold", "--quiet"]) == 0


def test_the_family_is_drawn_side_by_side(structure, tmp_path):
    assert main(["parallel", "base.fold", "--widths", "2", "-o", "out.obj", "--quiet"]) == 0
    with Image.open(tmp_path / "out.png") as image:
        assert image.width > image.height


@pytest.mark.parametrize(("options", "says"), [
    ([], "nothing is asked for"), (["--growth", "-1"], "parallel.growth"), (["--widths", "a"], "neither a factor"),
    (["--widths", "1,2"], "2 factors"), (["--widths", "1:1,0:2"], "rising positions"), (["--move", "1"], "crease,point:"),
    (["--move", "99,1:0,0,0"], "no point 1 on a crease 99"), (["--refine-fold", "1"], "boundary"),
    (["--refine-fold", "x"], "nor all"), (["--growth", "2", "--widths", "2"], "one way"), (["--near", "no.fold"], "no file"),
    (["--handles", "none.csv"], "cannot be read"), (["--least-scale", "3", "--move", "1,1:1,1,1"], "least_scale"),
    (["--refine-fold", "all", "--fraction", "0.9"], "below"), (["--widths", "2", "--rounds", "3"], "--refine-fold"),
    (["--widths", "2", "--at", "5"], "--refine-fold"), (["--widths", "2", "--least-scale", "0.5"], "--least-scale"),
    (["--move", "1,1:1e9,0,0"], "out of reach"),
])
def test_bad_wishes_are_one_sentence_and_nothing_is_written(structure, tmp_path, capsys, options, says):
    assert main(["parallel", "base.fold", *options, "-o", "out.fold"]) == 1
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1
    assert sorted(file.name for file in tmp_path.iterdir()) == ["base.fold"]


def test_strips_along_creases_are_drawn_listed_and_solid(structure, tmp_path, capsys):
    assert main(["strips", "base.fold", "--width", "0.05", "--thickness", "0.004", "-o", "out", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    assert report["status"] == "exact"
    assert len(report["strips"]) == 5
    out = tmp_path / "out"
    assert {file.name for file in out.iterdir()} == {"structure.fold", "structure.obj", "development.svg", "preview.png",
                                                     "report.json", "cutting-list.csv", "solids.stl"}
    rows = list(csv.DictReader((out / "cutting-list.csv").read_text(encoding="utf-8").splitlines()))
    assert [row["strip"] for row in rows] == ["1", "2", "3", "4", "5"]
    assert float(rows[2]["angle_max_deg"]) <= 90
    assert rows[0]["angle_min_deg"] == ""
    solids = trimesh.load_mesh(out / "solids.stl")
    assert solids.is_watertight
    assert len(solids.split()) == 5
    text = ET.parse(out / "development.svg").getroot().iter("{http://www.w3.org/2000/svg}text")
    assert sorted(element.text for element in text) == ["1", "2", "3", "4", "5"]
    flat = read_fold(out / "structure.fold")
    assert flat.topology.components == 5


@pytest.mark.parametrize(("arguments", "says"), [
    (["base.fold", "--closed"], "--closed"), (["helix.csv", "--crease", "2"], "--crease")])
def test_strips_refuse_options_that_mean_nothing(structure, tmp_path, capsys, arguments, says):
    assert main(["strips", *arguments, "--width", "0.1"]) == 1
    assert says in capsys.readouterr().err
    assert [file.name for file in tmp_path.iterdir()] == ["base.fold"]


def test_strips_along_a_curve_file_and_a_design(tmp_path, without_pictures, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    t = np.linspace(0, 6, 60)
    np.savetxt(tmp_path / "helix.csv", np.stack([np.cos(t), np.sin(t), 0.4 * t], axis=1), delimiter=",")
    assert main(["strips", "helix.csv", "--width", "0.3", "--quiet"]) == 0
    assert (tmp_path / "helix-strips" / "structure.obj").is_file()
    (tmp_path / "arc.toml").write_text('[curve]\nkind = "arc"\nradius = 100\nangle = 90\n[pattern]\ntheta = 30\n'
                                       "creases = 4\nwidth = 6\namplitude = 4\nsamples = 60\n", encoding="utf-8")
    assert main(["strips", "arc.toml", "--width", "3", "-o", "rows", "--json"]) == 0
    report = json.loads(capsys.readouterr().out)
    for entry in report["strips"]:
        assert entry["inclination_deg"]["min"] == pytest.approx(60, abs=3)  # between rows a width apart


@pytest.mark.parametrize(("source", "options", "says"), [
    ("base.fold", [], "--width is missing"), ("base.fold", ["--width", "-1"], "strips.width"),
    ("base.fold", ["--width", "1", "--crease", "99"], "no crease 99"), ("none.csv", ["--width", "1"], "no curve file"),
    ("base.fold", ["--width", "1", "--thickness", "0.9"], "more than half"), ("fig99", ["--width", "1"], "no file fig99"),
    ("line.csv", ["--width", "1"], "straight"),
])
def test_bad_strips_are_one_sentence_and_nothing_is_written(structure, tmp_path, capsys, source, options, says):
    np.savetxt(tmp_path / "line.csv", np.outer(np.arange(12), [1, 2, 3]), delimiter=",")
    assert main(["strips", source, *options, "-o", "out"]) == 1
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1
    assert not (tmp_path / "out").exists()

"""`plisse flex` as people type it."""

import json

import pytest

from plisse.cli import main
from plisse.cli.flex import parse_percent
from plisse.errors import InvalidDesign
from plisse.io.fold import write_fold
from plisse.io.obj import write_obj
from plisse.structure.exact import alternating_cones, conical_vertex, marched


@pytest.fixture
def structure(tmp_path):
    write_fold(conical_vertex(), tmp_path / "vertex.fold", units="cm")
    return tmp_path / "vertex.fold"


@pytest.mark.parametrize("text, numbers", [("0:100:3", [0, 50, 100]), ("30", [30]), ("0,12.5,200", [0, 12.5, 200]),
                                           ("100:0:2", [100, 0])])
def test_percents_are_ranges_lists_or_one_number(text, numbers):
    assert parse_percent(text) == numbers


@pytest.mark.parametrize("text", ["", "a", "0:100", "0:100:1", "0:1:2:3", "0:100:2.5", "1,,2", "0:100:99999"])
def test_other_percents_are_refused_with_an_example(text):
    with pytest.raises(InvalidDesign, match="for example 0:100:30"):
        parse_percent(text)


@pytest.mark.parametrize("name, options, files", [
    ("m.glb", [], {"m.glb", "m.png"}), ("m.fold", ["--no-picture"], {"m.fold"}), ("m.gif", ["--no-picture"], {"m.gif"})])
def test_files_come_with_a_picture_unless_told_otherwise(structure, tmp_path, name, options, files, capsys):
    target = tmp_path / "deep" / "er" / name
    assert main(["flex", str(structure), "--percent", "0:150:2", "-o", str(target), *options]) == 0
    assert {file.name for file in target.parent.iterdir()} == files
    assert "free of collisions from 0 to 200 %" in capsys.readouterr().out


def test_a_directory_gets_one_obj_per_state_and_loses_those_of_an_earlier_run(structure, tmp_path, capsys):
    for percent, count in (("0:100:4", 4), ("0:100:2", 2)):
        options = ["--percent", percent, "-o", str(tmp_path / "states"), "--quiet", "--no-picture"]
        assert main(["flex", str(structure), *options]) == 0
        assert len(list((tmp_path / "states").glob("*.obj"))) == count
    assert "units: cm" in (tmp_path / "states" / "000.obj").read_text()
    assert capsys.readouterr().out == ""


def test_a_flexed_state_passes_the_check_and_so_does_the_motion(structure, tmp_path, capsys):
    for percent in ("70", "0:200:5"):
        target = tmp_path / "motion.fold"
        assert main(["flex", str(structure), "--percent", percent, "-o", str(target), "--quiet", "--no-picture"]) == 0
        assert main(["check", str(target), "--json"]) == 0
        assert json.loads(capsys.readouterr().out)["principal"]


def test_closed_structures_say_where_they_were_cut(tmp_path, capsys):
    write_fold(alternating_cones(4, 12, closed=True), tmp_path / "ring.fold")
    options = ["--percent", "0:100:2", "-o", str(tmp_path / "m.fold"), "--json", "--no-picture"]
    assert main(["flex", str(tmp_path / "ring.fold"), *options]) == 0
    found = json.loads(capsys.readouterr().out)
    assert "across the creases" in found["cut"]
    assert found["percent"] == [0, 100]
    assert found["files"] == ["m.fold"]


def refused(capsys, *tokens):
    """The one sentence with which a command ends."""
    assert main(["flex", *map(str, tokens)]) == 1
    said = capsys.readouterr()
    assert said.out == ""
    assert said.err.count("\n") == 1
    return said.err


def test_bad_input_is_one_sentence_and_nothing_is_written(structure, tmp_path, capsys):
    write_obj(marched(), tmp_path / "general.obj")
    (tmp_path / "pattern.fold").write_text(json.dumps({**json.loads(structure.read_text()), "file_frames": []}))
    before = sorted(tmp_path.iterdir())
    assert "not principal" in refused(capsys, tmp_path / "general.obj", "-o", tmp_path / "m.fold")
    assert "from 0 (flat)" in refused(capsys, structure, "--percent", "0:250:3", "-o", tmp_path / "m.fold")
    assert "no folded form" in refused(capsys, tmp_path / "pattern.fold", "-o", tmp_path / "m.fold")
    assert ".stl" in refused(capsys, structure, "-o", tmp_path / "m.stl")
    assert "no file" in refused(capsys, tmp_path / "nothing.fold", "-o", tmp_path / "m.fold")
    assert "structure itself" in refused(capsys, structure, "-o", structure)
    assert "cannot be written" in refused(capsys, structure, "-o", structure / "m.fold")
    assert sorted(tmp_path.iterdir()) == before

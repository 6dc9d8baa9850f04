import json
import subprocess
import sys

import numpy as np
import pytest

from plisse.cli.app import main
from plisse.cli.make import FILES, write_files
from plisse.io.fold import read_fold, write_fold
from plisse.io.obj import read_obj, write_obj
from plisse.recipe import Arc, Design, Pattern
from plisse.result import Report, Result
from plisse.shipped import description, find_design, shipped_names

DESIGN = """# a quarter of alternating cones
[curve]
kind = "arc"
radius = 100
angle = 90
[pattern]
theta = 0
creases = 5
width = 6.0
amplitude = 3.0
samples = 30
"""

# reconstructions lie over something, parallel structures have a family, strips are cut from a list
NOT_OF_CURVES = {"overlay.png", "family.png", "cutting-list.csv", "solids.stl"}
CURVE_FILES = [name for name in FILES if name not in NOT_OF_CURVES]


@pytest.fixture
def design_file(tmp_path):
    path = tmp_path / "fan.toml"
    path.write_text(DESIGN, encoding="utf-8")
    return path


def result_of(structure, **changes):
    recipe = Design(curve=Arc(radius=100.0), pattern=Pattern(creases=7, width=6.0, amplitude=3.0))
    numbers = {"status": "exact", "reasons": [], "seconds": {"solve": 0.5, "total": 0.75}} | changes
    return Result(recipe, Report(**numbers), structure=structure)


def test_make_writes_every_file_and_they_describe_one_structure(design_file, tmp_path, capsys):
    out = tmp_path / "out"
    assert main(["make", str(design_file), "-o", str(out)]) == 0
    assert sorted(file.name for file in out.iterdir()) == sorted(CURVE_FILES)
    folded, mesh = read_fold(out / "structure.fold"), read_obj(out / "structure.obj")
    assert np.array_equal(folded.vertices, mesh.vertices)
    assert json.loads((out / "report.json").read_text(encoding="utf-8"))["status"] == "exact"
    assert "exact" in capsys.readouterr().out
    assert main(["check", str(out / "structure.fold")]) == 0
    assert main(["check", str(out / "structure.obj")]) == 0


def test_two_runs_give_the_same_bytes_apart_from_times(design_file, tmp_path, capsys):
    for name in ("a", "b"):
        assert main(["make", str(design_file), "-o", str(tmp_path / name), "--quiet"]) == 0
    assert capsys.readouterr().out == ""
    for name in CURVE_FILES[:-1]:
        assert (tmp_path / "a" / name).read_bytes() == (tmp_path / "b" / name).read_bytes()
    first, second = (json.loads((tmp_path / name / "report.json").read_text()) for name in ("a", "b"))
    assert first.pop("seconds") and second.pop("seconds")
    assert first == second


def test_json_prints_the_report_that_is_written(design_file, tmp_path, capsys):
    out = str(tmp_path / "out")
    assert main(["make", str(design_file), "-o", out, "--json", "--set", "units=cm"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed == json.loads((tmp_path / "out" / "report.json").read_text(encoding="utf-8"))
    assert printed["units"] == "cm" and printed["design"]["units"] == "cm"
    assert printed["seconds"]["files"] > 0


def test_ctrl_c_leaves_nothing(design_file, tmp_path, monkeypatch, capsys):
    import plisse.pipeline

    def interrupted(recipe, *, progress=None):
        raise KeyboardInterrupt

    monkeypatch.setattr(plisse.pipeline, "design", interrupted)
    assert main(["make", str(design_file), "-o", str(tmp_path / "deep" / "out")]) == 130
    assert [file.name for file in tmp_path.iterdir()] == ["fan.toml"]
    assert capsys.readouterr().err.count("\n") == 1


@pytest.mark.parametrize(("arguments", "word"), [
    (["make", "fan.toml", "--set", "pattern.theta=95"], "pattern.theta"),
    (["make", "fan.toml", "--set", "pattern.crease=3"], "pattern.crease"),
    (["make", "fan.toml", "--set", "nonsense"], "nonsense"),
    (["make", "fan.toml", "--set", "pattern.width=nan"], "pattern.width"),
    (["make", "missing.toml"], "missing.toml"),
    (["make", "."], "directory"),
    (["make", "fan.toml", "-o", "fan.toml"], "cannot be written"),
    (["check", "missing.fold"], "missing.fold"),
    (["check", "fan.toml"], "neither"),
    (["gallery", "no-such-figure"], "no-such-figure"),
])
def test_bad_input_is_one_line_exit_1_and_nothing_written(design_file, monkeypatch, capsys, arguments, word):
    monkeypatch.chdir(design_file.parent)
    assert main(arguments) == 1
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.count("\n") == 1 and word in captured.err
    assert [file.name for file in design_file.parent.iterdir()] == ["fan.toml"]


@pytest.mark.parametrize("arguments", [["make"], ["make", "a", "--colour"], ["check"], ["fold"],
                                       ["gallery", "a", "b"]])
def test_wrong_usage_is_exit_2_and_at_most_two_lines(capsys, arguments):
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert captured.out == "" and 1 <= captured.err.count("\n") <= 2


def test_check_tells_exact_from_disturbed(cones, tmp_path, capsys):
    write_fold(cones, tmp_path / "good.fold")
    assert main(["check", str(tmp_path / "good.fold"), "--json"]) == 0
    good = json.loads(capsys.readouterr().out)
    assert good["status"] == "exact" and good["principal"] and good["planarity"]["max"] < 1e-12
    noise = np.random.default_rng(0).normal(0, 1e-6, cones.vertices.shape)
    write_obj(cones.with_vertices(cones.vertices + noise), tmp_path / "bad.obj")
    assert main(["check", str(tmp_path / "bad.obj"), "--json"]) == 3
    bad = json.loads(capsys.readouterr().out)
    assert bad["status"] == "approximate" and not bad["principal"] and len(bad["reasons"]) == 2


def test_check_sees_folds_that_are_shut_or_flat_and_faces_folded_over(cones, tmp_path, capsys):
    write_obj(cones.with_vertices(cones.vertices * [1, 1, 1e-3]), tmp_path / "flat.obj")
    assert main(["check", str(tmp_path / "flat.obj")]) == 3
    assert "no fold" in capsys.readouterr().out
    over = cones.vertices.copy()
    over[[30, 31]] = over[[31, 30]]
    write_obj(cones.with_vertices(over), tmp_path / "over.obj")
    assert main(["check", str(tmp_path / "over.obj")]) == 3
    assert "folded over" in capsys.readouterr().out


def test_an_infeasible_design_leaves_its_report_only_and_no_older_files(cones, tmp_path):
    write_files(result_of(cones), tmp_path / "out", title="fan")
    assert {file.name for file in (tmp_path / "out").iterdir()} == set(CURVE_FILES)
    write_files(result_of(None, status="infeasible", reasons=["it cannot be"]), tmp_path / "out", title="fan")
    assert [file.name for file in (tmp_path / "out").iterdir()] == ["report.json"]


def test_time_for_files_is_part_of_the_total(cones, tmp_path):
    seconds = write_files(result_of(cones), tmp_path / "out", title="fan").seconds
    assert list(seconds) == ["solve", "files", "total"]
    assert seconds["total"] == pytest.approx(0.75 + seconds["files"])


def test_an_interruption_while_writing_leaves_the_earlier_files(cones, tmp_path, monkeypatch):
    write_files(result_of(cones), tmp_path / "out", title="fan")
    before = {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir()}

    def interrupted(*args, **kwargs):
        raise KeyboardInterrupt

    monkeypatch.setattr("plisse.io.svg.write_svg", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_files(result_of(cones), tmp_path / "out", title="other")
    assert {file.name: file.read_bytes() for file in (tmp_path / "out").iterdir()} == before
    assert [file.name for file in tmp_path.iterdir()] == ["out"]


def test_gallery_lists_every_design_with_a_sentence_and_copies_it(tmp_path, monkeypatch, capsys):
    names = shipped_names()
    assert "fig01d" in names and all(description(name) for name in names)
    assert main(["gallery"]) == 0
    listed = capsys.readouterr().out
    assert all(name in listed for name in names)
    monkeypatch.chdir(tmp_path)
    assert main(["gallery", "fig01d"]) == 0
    assert (tmp_path / "fig01d.toml").is_file()
    assert main(["gallery", "fig01d"]) == 1
    assert main(["gallery", "fig01d", "-o", "mine.toml"]) == 0
    assert (tmp_path / "mine.toml").read_bytes() == (tmp_path / "fig01d.toml").read_bytes()


def test_the_directory_of_an_earlier_run_does_not_hide_the_gallery(tmp_path, monkeypatch):
    (tmp_path / "fig01d").mkdir()
    monkeypatch.chdir(tmp_path)
    assert find_design("fig01d").name == "fig01d.toml"


def test_similar_names_are_suggested(capsys):
    assert main(["make", "fig1d"]) == 1
    assert "fig01d" in capsys.readouterr().err


def test_the_command_answers_help_without_loading_numpy():
    code = "import sys; from plisse.cli import main; main(['--help']); sys.exit('numpy' in sys.modules)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, encoding="utf-8", timeout=60)
    assert done.returncode == 0 and "gallery" in done.stdout


def test_the_version_is_that_of_the_package(capsys):
    from importlib.metadata import version

    assert main(["--version"]) == 0
    assert capsys.readouterr().out.strip() == version("plisse")

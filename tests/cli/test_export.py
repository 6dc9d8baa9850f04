import sys

import numpy as np
import pytest

from plisse.cli.app import main
from plisse.io.fold import write_fold
from plisse.io.structures import read_structure


@pytest.fixture
def fold(cones, tmp_path):
    write_fold(cones, tmp_path / "s.fold")
    return tmp_path / "s.fold"


def test_export_writes_every_output_and_names_it(fold, tmp_path, capsys):
    files = [tmp_path / f"out.{suffix}" for suffix in ("3dm", "obj", "fold", "svg")]
    assert main(["export", str(fold), *(word for file in files for word in ("-o", str(file)))]) == 0
    assert capsys.readouterr().out.split() == [str(file) for file in files]
    for file in files[:3]:
        assert np.array_equal(read_structure(file).vertices, read_structure(fold).vertices)
        assert main(["check", str(file)]) == 0


def test_models_made_elsewhere_pass_through(cones, tmp_path, capsys):
    from plisse.io.obj import write_obj

    write_obj(cones, tmp_path / "s.obj")
    bare = "\n".join(line for line in (tmp_path / "s.obj").read_text().splitlines() if line[:2] in ("v ", "f "))
    (tmp_path / "bare.obj").write_text(bare)
    assert main(["export", str(tmp_path / "bare.obj"), "-o", str(tmp_path / "b.fold"), "--quiet"]) == 0
    assert capsys.readouterr().out == ""
    assert main(["check", str(tmp_path / "b.fold")]) == 0


@pytest.mark.parametrize(("arguments", "word"), [
    (["export", "s.fold", "-o", "s.step"], ".step"),
    (["export", "s.fold", "-o", "no/s.obj"], "no directory"),
    (["export", "s.fold", "-o", "a.obj", "-o", "./a.obj"], "named twice"),
    (["export", "missing.fold", "-o", "s.obj"], "missing.fold"),
    (["export", "s.txt", "-o", "s.obj"], "neither"),
    (["export", "flat.fold", "-o", "s.svg"], "no folded form"),
    (["export", "triangle.obj", "-o", "s.fold"], "3 edges"),
])
def test_bad_input_is_one_line_exit_1_and_nothing_written(fold, monkeypatch, capsys, arguments, word):
    monkeypatch.chdir(fold.parent)
    (fold.parent / "flat.fold").write_text(fold.read_text().replace("file_frames", "my:frames"))
    (fold.parent / "triangle.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert main(arguments) == 1
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.count("\n") == 1 and word in captured.err
    assert sorted(file.name for file in fold.parent.iterdir()) == ["flat.fold", "s.fold", "triangle.obj"]


def test_a_missing_extra_is_one_line_with_the_command_that_installs_it(fold, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    assert main(["export", str(fold), "-o", str(fold.with_suffix(".dxf"))]) == 1
    assert capsys.readouterr().err == ('plisse: DXF files need ezdxf, which is not installed; '
                                       'pip install "plisse[cad]"\n')
    assert main(["export", str(fold), "-o", str(fold.with_suffix(".svg")), "--quiet"]) == 0


def test_without_output_export_says_what_it_needs(fold, capsys):
    assert main(["export", str(fold)]) == 2
    assert "--output" in capsys.readouterr().err

"""`plisse sheets` from a file to files."""

import numpy as np
import pytest

from plisse.cli.app import main
from plisse.io.fold import write_fold
from plisse.io.obj import write_obj


@pytest.fixture
def fold(cones, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_fold(cones, tmp_path / "cones.fold", title="cones")
    return tmp_path / "cones.fold"


def test_sheets_says_what_it_made_and_writes_it(fold, capsys):
    assert main(["sheets", "cones.fold", "-o", "out.svg", "--material", "150x160", "--kerf", "0.1",
                 "--curves", "arc", "--tolerance", "0.3"]) == 0
    said = capsys.readouterr().out
    assert "pieces on" in said and "numbered edges" in said and "arcs deviate by" in said and "out-1.svg" in said
    assert (fold.parent / "out-1.svg").is_file() and not (fold.parent / "out.svg").exists()


def test_equal_runs_give_equal_bytes(fold):
    for name in ("a.pdf", "b.pdf", "a.svg", "b.svg"):
        assert main(["sheets", "cones.fold", "-o", name, "--quiet"]) == 0
    for suffix in ("pdf", "svg"):
        assert (fold.parent / f"a.{suffix}").read_bytes() == (fold.parent / f"b.{suffix}").read_bytes()


def test_paper_alone_is_the_material_and_with_material_it_tiles(fold, capsys):
    pikepdf = pytest.importorskip("pikepdf")
    assert main(["sheets", "cones.fold", "-o", "small.pdf", "--paper", "A4"]) == 0
    assert "210 × 297 mm" in capsys.readouterr().out
    assert main(["sheets", "cones.fold", "-o", "large.pdf", "--paper", "A4", "--material", "420x300"]) == 0
    for name in ("small.pdf", "large.pdf"):
        with pikepdf.open(fold.parent / name) as document:
            sizes = {tuple(sorted(round(float(side) / 72 * 25.4, 1) for side in page.mediabox[2:]))
                     for page in document.pages}
        assert sizes == {(210.0, 297.0)}


def test_a_size_scales_the_folded_structure(fold, capsys):
    assert main(["sheets", "cones.fold", "-o", "out.svg", "--size", "100"]) == 0
    half = capsys.readouterr().out
    assert main(["sheets", "cones.fold", "-o", "out.svg", "--scale", "0.5"]) == 0
    assert capsys.readouterr().out == half  # cones are 200 mm wide


def test_a_mesh_without_development_is_laid_flat_first(cones, fold):
    write_obj(cones, fold.parent / "cones.obj")
    assert main(["sheets", "cones.obj", "-o", "out.svg", "--quiet"]) == 0
    assert (fold.parent / "out.svg").is_file()


@pytest.mark.parametrize(("arguments", "word"), [
    (["--material", "20x20"], "material"),
    (["--material", "large"], "600x300"),
    (["--material", "25x25"], "face"),
    (["--kerf", "80"], "kerf"),
    (["--paper", "A9"], "A4"),
    (["--scale", "2", "--size", "100"], "one of them"),
    (["--size", "0"], "--size"),
    (["--tolerance", "0"], "--tolerance"),
    (["--tolerance", "1000", "--curves", "arc"], "up to 1 mm"),
    (["--spacing", "1e9"], "spacing"),
    (["--scale", "1e-6"], "larger scale"),
    (["-o", "out.png"], ".svg"),
    (["-o", "missing/out.pdf"], "missing"),
    (["-o", "cones.fold/out"], "cannot be written"),
])
def test_bad_input_is_one_line_exit_1_and_nothing_written(fold, capsys, arguments, word):
    output = [] if "-o" in arguments else ["-o", "out.svg"]
    assert main(["sheets", "cones.fold", *output, *arguments]) == 1
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.count("\n") == 1 and word in captured.err
    assert [file.name for file in fold.parent.iterdir()] == ["cones.fold"]


def test_a_mesh_that_does_not_lie_flat_is_refused(cones, fold, capsys):
    noise = np.random.default_rng(0).normal(0, 0.5, cones.vertices.shape)
    write_obj(cones.with_vertices(cones.vertices + noise), fold.parent / "bent.obj")
    assert main(["sheets", "bent.obj", "-o", "out.svg"]) == 1
    assert "does not lie flat" in capsys.readouterr().err


def test_small_numbers_and_short_flaps_are_noted(fold, capsys):
    assert main(["sheets", "cones.fold", "-o", "out.svg", "--material", "150x160", "--tab", "60", "--scale", "0.2"]) == 0
    assert "mm high" in capsys.readouterr().out
    assert main(["sheets", "cones.fold", "-o", "out.svg", "--material", "150x160", "--tab", "60"]) == 0
    assert "flaps of less than 60 mm" in capsys.readouterr().out

import json

import numpy as np
import pytest
from PIL import Image

from plisse.cli.app import main
from plisse.io.fold import read_fold, write_fold
from plisse.structure.exact import alternating_cones, marched
from plisse.transform.offset import offset_range


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write_fold(alternating_cones(4, 9, radius=100, width=20), tmp_path / "cones.fold", title="cones", units="cm")
    return tmp_path / "cones.fold"


@pytest.fixture
def without_picture(monkeypatch):
    """Pictures take seconds, and one test looks at one."""
    import plisse.draw.plates

    monkeypatch.setattr(plisse.draw.plates, "write_plates_picture", lambda plates, path, **about: path.touch())


def test_offset_writes_an_exact_structure_that_check_accepts(file, capsys):
    assert main(["offset", "cones.fold", "--distance", "-3"]) == 0
    assert "exact" in capsys.readouterr().out
    assert sorted(path.name for path in file.parent.iterdir()) == ["cones-offset.fold", "cones-offset.png", "cones.fold"]
    moved = read_fold(file.parent / "cones-offset.fold")
    assert np.ptp(moved.vertices[:, 2] - read_fold(file).vertices[:, 2]) < 1e-9
    assert json.loads((file.parent / "cones-offset.fold").read_text(encoding="utf-8"))["frame_unit"] == "cm"
    assert main(["check", "cones-offset.fold"]) == 0


def test_plates_writes_solids_table_picture_and_film(file, capsys):
    assert main(["plates", "cones.fold", "--thickness", "2", "--gap", "6", "--hinged", "-o", "out/p.stl"]) == 0
    out = capsys.readouterr().out
    assert "24 plates, 2 cm thick" in out and "moves freely from 0 to" in out
    assert sorted(path.name for path in (file.parent / "out").iterdir()) == ["p.csv", "p.json", "p.png", "p.stl", "p.svg"]
    with Image.open(file.parent / "out" / "p.png") as picture:
        assert np.asarray(picture.convert("L")).std() > 8
    assert 'width="' in (file.parent / "out" / "p.svg").read_text(encoding="utf-8")


def test_a_directory_gets_one_stl_per_plate_and_no_old_ones_stay(file, without_picture):
    assert main(["plates", "cones.fold", "--thickness", "2", "-o", "out", "--quiet"]) == 0
    (file.parent / "out" / "plate_99.stl").touch()
    assert main(["plates", "cones.fold", "--thickness", "2", "--side", "both", "-o", "out", "--quiet"]) == 0
    names = {path.name for path in (file.parent / "out").iterdir()}
    assert names == {*(f"plate_{k:02d}.stl" for k in range(1, 25)), "plates.obj", "plates.csv", "plates.json", "plates.png",
                     "plates.svg"}


def test_json_prints_the_report(file, without_picture, capsys):
    assert main(["plates", "cones.fold", "--thickness", "2", "--json"]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert printed["plates"] == 24 and printed["units"] == "cm" and "table" not in printed


FLAT = '{"file_spec": 1.2, "frame_classes": ["creasePattern"], "vertices_coords": [[0,0],[1,0],[1,1],[0,1]], ' \
       '"faces_vertices": [[0,1,2,3]]}'


def squares(heights):
    """A FOLD file with a row of two squares, or one, and nothing said of what they are."""
    columns = range(len(heights))
    points = [[x, y, z] for y in (0, 1) for x, z in zip(columns, heights, strict=True)]
    faces = [[k, k + 1, len(heights) + k + 1, len(heights) + k] for k in columns[:-1]]
    return json.dumps({"file_spec": 1.2, "vertices_coords": [p[:2] if not any(heights) else p for p in points],
                       "faces_vertices": faces})


@pytest.mark.parametrize("command", [["offset", "--distance", "1"], ["plates", "--thickness", "0.1"], ["flex"],
                                     ["parallel", "--widths", "1.1"], ["parallel", "--refine-fold", "all"]])
@pytest.mark.parametrize(("heights", "words"), [((0, 0, 0), "lies flat"), ((0, 0), "no crease lies between"),
                                                ((0, 1, 2), "lies flat")])
def test_what_is_not_folded_is_refused_alike(file, capsys, command, heights, words):
    (file.parent / "flat.fold").write_text(squares(heights), encoding="utf-8")
    before = sorted(file.parent.iterdir())
    assert main([command[0], "flat.fold", *command[1:]]) == 1
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.count("\n") == 1 and words in captured.err
    assert sorted(file.parent.iterdir()) == before


@pytest.mark.parametrize(("arguments", "words"), [
    (["plates", "cones.fold", "--thickness", "1", "--kerf", "0.2"], "--material"),
    (["plates", "cones.fold", "--thickness", "1", "--material", "1x1"], "no room inside margins"),
    (["plates", "cones.fold", "--thickness", "1", "--material", "900x900", "--kerf", "500"], "wider than plate"),
    (["offset", "general.fold", "--distance", "1"], "not principal"),
    (["offset", "general.fold", "--distance", "1", "-o", "a.stl"], "neither"),
    (["offset", "cones.fold", "--distance", "nan"], "finite"),
    (["offset", "flat.fold", "--distance", "1"], "no folded form"),
    (["offset", "cones.fold", "--distance", "1", "-o", "cones.fold"], "itself"),
    (["plates", "general.fold", "--thickness", "1"], "not principal"),
    (["plates", "flat.fold", "--thickness", "1"], "no folded form"),
    (["plates", "cones.fold", "--thickness", "500"], "largest possible thickness"),
    (["plates", "cones.fold", "--thickness", "50", "--gap", "6", "--hinged"], "largest possible thickness"),
    (["plates", "cones.fold", "--thickness", "1", "--gap", "90"], "largest possible gap"),
    (["plates", "cones.fold", "--thickness", "1", "--hinged"], "gap"),
    (["plates", "cones.fold", "--thickness", "1", "-o", "a.step"], ".step"),
])
def test_bad_input_is_one_line_exit_1_and_nothing_written(file, capsys, arguments, words):
    (file.parent / "flat.fold").write_text(FLAT, encoding="utf-8")
    general = marched()
    from plisse.solve.flatten import flatten

    write_fold(flatten(general), file.parent / "general.fold")
    before = sorted(file.parent.iterdir())
    assert main(arguments) == 1
    captured = capsys.readouterr()
    assert captured.out == "" and captured.err.count("\n") == 1 and words in captured.err
    assert sorted(file.parent.iterdir()) == before


def test_an_offset_beyond_the_limit_names_it(file, capsys):
    from plisse.structure.exact import conic_creases

    structure = conic_creases()
    write_fold(structure, file.parent / "conics.fold")
    assert main(["offset", "conics.fold", "--distance", "1e3"]) == 1
    named = capsys.readouterr().err.split()[-1]
    assert float(named) == pytest.approx(offset_range(structure)[1], rel=1e-4)


def test_plates_are_laid_out_on_material(file, without_picture):
    assert main(["plates", "cones.fold", "--thickness", "2", "--material", "1500x900", "--kerf", "0.2", "--quiet"]) == 0
    sheets = sorted((file.parent / "plates").glob("plates-sheet-*.svg"))
    assert sheets
    words = "".join(sheet.read_text(encoding="utf-8") for sheet in sheets)
    assert all(f">{number}</text>" in words for number in range(1, 25))


def test_plates_larger_than_the_material_leave_nothing_behind(file, capsys):
    assert main(["plates", "cones.fold", "--thickness", "2", "--material", "60x60"]) == 1
    assert "does not fit" in capsys.readouterr().err
    assert [path.name for path in file.parent.iterdir()] == ["cones.fold"]


def test_files_that_only_look_like_plates_stay(file, without_picture):
    (file.parent / "out").mkdir()
    mine = {"plate_mine.stl", "plates-sheet-metal.svg"}
    for name in mine:
        (file.parent / "out" / name).touch()
    assert main(["plates", "cones.fold", "--thickness", "2", "-o", "out", "--quiet"]) == 0
    assert mine <= {path.name for path in (file.parent / "out").iterdir()}

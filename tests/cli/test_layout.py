"""`plisse layout`: candidates as a table and a picture, the best one as a design that leads to it again."""

import tomllib

import numpy as np
import pytest

from plisse.cli.app import main
from plisse.cli.layout import FILES
from plisse.io.designs import read_design
from plisse.pipeline import design

HEIGHT = "2 * sin(x / 7) * cos(y / 9) - 0.01 * (x**2 + y**2)"
DESIGN = f"""[surface]
height = "{HEIGHT}"
x = [-20, 20]
y = [-18, 18]

[pattern]
width = 2.0
"""


def write_mesh(path, cells=28):
    x, y = np.meshgrid(np.linspace(-20, 20, cells), np.linspace(-18, 18, cells), indexing="ij")
    z = 2 * np.sin(x / 7) * np.cos(y / 9) - 0.01 * (x**2 + y**2)
    lines = [f"v {a} {b} {c}" for a, b, c in zip(x.ravel(), y.ravel(), z.ravel(), strict=True)]
    for i in range(cells - 1):
        for j in range(1, cells):
            k = i * cells + j
            lines.append(f"f {k} {k + cells} {k + cells + 1} {k + 1}")
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def test_a_mesh_is_laid_out_and_the_design_written_leads_to_the_same_layout(tmp_path, capsys, monkeypatch):
    write_mesh(tmp_path / "roof.obj")
    monkeypatch.chdir(tmp_path)
    assert main(["layout", "roof.obj", "--count", "3"]) == 0
    out = capsys.readouterr().out
    directory = tmp_path / "roof-layout"
    assert sorted(file.name for file in directory.iterdir()) == sorted(FILES)
    assert (directory / "candidates.png").read_bytes().startswith(b"\x89PNG")
    for word in ("covered", "deviation", "sector", "opening", "θ", "exact", "fitted inclination"):
        assert word in out
    text = (directory / "layout.toml").read_text(encoding="utf-8")
    assert tomllib.loads(text)["surface"]["file"] == "../roof.obj"
    promised = float(text.split(" % covered")[0].rsplit(" ", 1)[1]) / 100
    result = design(directory / "layout.toml")
    assert result.status == "exact"
    assert result.report.coverage == pytest.approx(promised, abs=0.005)


@pytest.mark.slow
def test_a_design_keeps_what_it_asks_for_and_gains_a_centre(tmp_path, capsys):
    (tmp_path / "wave.toml").write_text(DESIGN, encoding="utf-8")
    out = tmp_path / "out"
    assert main(["layout", str(tmp_path / "wave.toml"), "-o", str(out), "--count", "1", "--quiet"]) in (0, 3)
    assert capsys.readouterr().out == ""
    recipe = read_design(out / "layout.toml")
    assert recipe.surface.height == HEIGHT
    assert recipe.surface.x == (-20, 20)
    assert recipe.pattern.width == 2.0
    assert recipe.pattern.amplitude == pytest.approx(1.6)
    assert len(recipe.surface.centre) == 3


def test_a_layout_that_someone_may_have_edited_is_not_overwritten(tmp_path, capsys):
    write_mesh(tmp_path / "roof.obj")
    (tmp_path / "layout.toml").write_text("# mine\n", encoding="utf-8")
    assert main(["layout", str(tmp_path / "roof.obj"), "-o", str(tmp_path)]) == 1
    assert "exists already" in capsys.readouterr().err
    assert (tmp_path / "layout.toml").read_text(encoding="utf-8") == "# mine\n"
    assert not (tmp_path / "candidates.png").exists()


@pytest.mark.parametrize(("name", "text", "says"), [
    ("missing.obj", None, "no mesh file"),
    ("empty.obj", "", "is empty"),
    ("curve.toml", '[curve]\nkind = "arc"\nradius = 10\n[pattern]\ncreases = 5\nwidth = 1\namplitude = 0.5\n',
     "no surface section"),
    ("ring.toml", "[surface]\ntorus = [30, 10]\nguide = [[40, 0, 0], [0, 40, 0]]\n[pattern]\ntheta = 40\nwidth = 2\n"
     "amplitude = 1\n", "has a guide"),
    ("torus.toml", "[surface]\ntorus = [30, 10]\n", "no boundary"),
])
def test_what_is_no_surface_is_said_in_one_line_and_nothing_is_written(tmp_path, capsys, name, text, says):
    if text is not None:
        (tmp_path / name).write_text(text, encoding="utf-8")
    out = tmp_path / "out"
    assert main(["layout", str(tmp_path / name), "-o", str(out)]) == 1
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1
    assert not out.exists()


def test_a_count_below_one_is_refused(tmp_path, capsys):
    write_mesh(tmp_path / "roof.obj")
    assert main(["layout", str(tmp_path / "roof.obj"), "--count", "0"]) == 1
    assert "from 1" in capsys.readouterr().err

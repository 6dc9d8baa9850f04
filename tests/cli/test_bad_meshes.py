"""A design with a bad mesh: one line on stderr, exit code 1, nothing written."""

import pytest

from plisse.cli import main

TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
MESHES = {
    "missing.obj": None,
    "empty.obj": b"",
    "triangle.obj": (TRIANGLE + "f 1 2 3\n").encode(),
    "points.obj": TRIANGLE.encode(),
    "nan.obj": ("v nan 0 0\n" + TRIANGLE + "f 1 2 3\nf 2 3 4\n").encode(),
    "wide.obj": (TRIANGLE + "f 1 2 3\n").encode("utf-16"),
    "junk.stl": bytes(range(256)) * 9,
    "letter.docx": b"text",
}


@pytest.mark.parametrize("name", MESHES)
@pytest.mark.parametrize("layout", ["", "guide = [[0, 0, 0], [1, 0, 0]]", "guide_boundary = 1"])
def test_bad_meshes_end_in_one_line_and_leave_nothing(name, layout, tmp_path, capfd):
    if MESHES[name] is not None:
        (tmp_path / name).write_bytes(MESHES[name])
    sizes = "[pattern]\ntheta = 60\nwidth = 1\namplitude = 0.5\n" if layout else ""
    (tmp_path / "a.toml").write_text(f'[surface]\nfile = "{name}"\n{layout}\n{sizes}', encoding="utf-8")
    before = sorted(tmp_path.iterdir())
    assert main(["make", str(tmp_path / "a.toml"), "-o", str(tmp_path / "out"), "--quiet"]) == 1
    out, err = capfd.readouterr()
    assert out == ""
    assert len(err.strip().splitlines()) == 1
    assert name in err
    assert "Traceback" not in err
    assert sorted(tmp_path.iterdir()) == before

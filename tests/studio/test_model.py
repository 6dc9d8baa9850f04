"""The desk: what is on screen and its TOML are one, and every step can be taken back."""

import tomllib
from pathlib import Path

import pytest

from plisse.errors import InvalidDesign, InvalidMesh
from plisse.io.designs import design_from_dict, read_design
from plisse.shipped import shipped_design, shipped_names
from plisse.studio import shelf
from plisse.studio.model import Desk
from plisse.studio.requests import Mesh
from plisse.studio.surface_panel import kept_guide, shape_of

RECIPE = {"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 18, 8], [80, 18, 14], [120, 0, 16]]},
          "pattern": {"theta": 40, "creases": 7, "width": 5, "amplitude": 3, "samples": 61}}


class Clock:
    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def desk(clock):
    return Desk(design_from_dict(RECIPE), "a wave", clock=clock)


def test_the_text_is_the_design_on_screen_after_every_step(desk, clock):
    for changes in ({"theta": 30}, {"points": [[0, 0, 0], [40, 20, 8], [80, 18, 14], [120, 0, 16]]}, {"principal": True},
                    {"width": [5, 6, 5, 6, 5, 6]}):
        clock.now += 5
        desk.change(changes)
        assert design_from_dict(tomllib.loads(desk.toml)) == desk.recipe


def test_undoing_everything_gives_the_first_text_again_and_redoing_the_last(desk, clock):
    first = desk.toml
    for theta in (10, 20, 30):
        clock.now += 5
        desk.change({"theta": theta})
    last = desk.toml
    while desk.can_undo:
        desk.undo()
    assert desk.toml == first
    while desk.can_redo:
        desk.redo()
    assert desk.toml == last


def test_a_slider_that_is_pulled_goes_back_in_one_step(desk, clock):
    first = desk.toml
    for theta in range(10, 40):
        clock.now += 0.05
        desk.change({"theta": theta})
    desk.undo()
    assert desk.toml == first


def test_two_sliders_go_back_one_after_the_other(desk, clock):
    desk.change({"theta": 10})
    clock.now += 0.1
    desk.change({"amplitude": 2})
    desk.undo()
    assert (desk.recipe.pattern.theta, desk.recipe.pattern.amplitude) == (10, 3)


def test_a_refused_change_leaves_everything_as_it_was(desk):
    before = desk.toml
    with pytest.raises(InvalidDesign, match=r"pattern\.creases"):
        desk.change({"creases": 2})
    assert desk.toml == before
    assert not desk.can_undo


def test_text_in_is_text_out(desk):
    for name in shipped_names():
        desk.open(read_design(shipped_design(name)), name)
        text = desk.toml
        desk.undo()
        desk.read(text, name)
        assert desk.toml == text


def test_a_text_brings_its_own_title(desk):
    cones = '[closed_form]\nkind = "cones"\ncreases = 4\n'
    desk.read(f"# two cones\n{cones}")
    assert desk.step.title == "two cones"
    desk.read(cones)
    assert desk.step.title == "closed form"
    desk.undo()
    assert desk.step.title == "two cones"


def test_clicked_points_follow_the_design_back():
    def over(guide):
        surface = {"height": "0.001 * x * y", **({"guide": guide} if guide else {})}
        return design_from_dict({"surface": surface, "pattern": {"theta": 45, "width": 5, "amplitude": 3}})

    a, b, c = [0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [20.0, 5.0, 0.1]
    assert kept_guide([a], over(None)) == [a]
    assert kept_guide([a, b, c], over([a, b, c])) == [a, b, c]
    assert kept_guide([a, b, c], over([a, b])) == [a, b]  # undone
    assert kept_guide([a, b], over([a, b, c])) == [a, b, c]  # done again
    assert kept_guide([a, b], over(None)) == []
    assert kept_guide([a, b], over([b, c])) == []
    assert kept_guide([], over([a, b])) == []
    assert shape_of(over([a, b])) == shape_of(over(None)) != shape_of(design_from_dict(RECIPE))


@pytest.mark.parametrize("text", ['[curve]\nkind="points"\nfile="/etc/passwd"', '[surface]\nfile="/etc/passwd"',
                                  '[surface]\nfile=[1]', '[surface]\nguide_file="/etc/passwd"',
                                  '[surface]\nedited_file="../secret.obj"'])
def test_a_text_cannot_name_files(desk, text):
    with pytest.raises(InvalidDesign, match="names a file"):
        desk.read(text + '\n[pattern]\ncreases=5\nwidth=5\namplitude=2\n')


@pytest.mark.parametrize("text", ["", "x = ", "[" * 10_000, "a = 1\n" * 300_000, "curve = 5"])
def test_bad_texts_are_one_sentence(desk, text):
    before = desk.toml
    with pytest.raises(InvalidDesign) as error:
        desk.read(text)
    assert len(str(error.value).splitlines()) == 1
    assert desk.toml == before


def test_an_uploaded_mesh_is_named_without_its_place_and_lies_under_a_name_of_ours(desk):
    name = desk.shelf.put("../../etc/my roof;rm -rf.OBJ", b"v 0 0 0\n")
    assert name == "etc-my-roof-rm-rf.obj"
    desk.read(f'[surface]\nfile = "{name}"\n[pattern]\nwidth = 2\n')
    path = desk.solvable.surface.file
    assert path.endswith("/0.obj")
    assert "etc" not in path
    assert f'file = "{name}"' in desk.toml
    desk.close()
    with pytest.raises(InvalidDesign):
        desk.read('[surface]\nfile = "roof.obj"')


def _upload(desk, name, content):
    """The place of an uploaded mesh, with pleats over it on the desk."""
    desk.read(f'[surface]\nfile = "{desk.shelf.put(name, content)}"\n')
    return desk.solvable.surface.file


def test_every_step_back_has_its_mesh(desk):
    places = [_upload(desk, f"m{number}.obj", b"v %d 0 0\n" % number) for number in range(30)]
    for number in reversed(range(30)):
        assert desk.solvable.surface.file == places[number]
        assert Path(places[number]).read_bytes() == b"v %d 0 0\n" % number
        desk.undo()
    assert not desk.can_undo
    desk.close()


def test_meshes_of_one_name_stay_apart_and_the_same_mesh_is_kept_once(desk):
    first, second = _upload(desk, "roof.obj", b"v 0 0 0\n"), _upload(desk, "roof.obj", b"v 1 0 0\n")
    assert 'file = "roof-2.obj"' in desk.toml
    desk.undo()
    assert 'file = "roof.obj"' in desk.toml
    assert desk.solvable.surface.file == first
    desk.redo()
    assert desk.solvable.surface.file == second
    assert [Path(path).read_bytes() for path in (first, second)] == [b"v 0 0 0\n", b"v 1 0 0\n"]
    assert _upload(desk, "roof.obj", b"v 0 0 0\n") == first
    desk.close()


def test_a_mesh_that_became_no_design_leaves_its_name_and_its_room_to_the_next(desk):
    refused = Path(desk.shelf.path(desk.shelf.put("roof.obj", b"no mesh at all")))
    place = _upload(desk, "roof.obj", b"v 0 0 0\n")
    assert 'file = "roof.obj"' in desk.toml
    assert not refused.exists()
    assert Path(place).exists()
    desk.close()


def test_more_meshes_than_a_tab_keeps_are_refused_and_all_steps_stay(desk, monkeypatch):
    monkeypatch.setattr(shelf, "MOST_BYTES", 20)
    places = [_upload(desk, f"m{number}.obj", b"v %d 0 0\n" % number) for number in range(2)]
    with pytest.raises(InvalidMesh, match="new tab"):
        desk.shelf.put("m2.obj", b"v 2 0 0\n")
    assert desk.solvable.surface.file == places[1]
    desk.undo()
    assert desk.solvable.surface.file == places[0]
    desk.close()


def test_meshes_of_one_name_from_two_folders_of_the_disk_stay_apart(desk, tmp_path):
    for folder in ("a", "b"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "roof.obj").write_text("v 0 0 0\n")
        desk.open(design_from_dict({"surface": {"file": str(tmp_path / folder / "roof.obj")}}), folder)
    assert desk.solvable.surface.file == str(tmp_path / "b" / "roof.obj")
    desk.undo()
    assert desk.solvable.surface.file == str(tmp_path / "a" / "roof.obj")


@pytest.mark.parametrize("name", ["roof.py", "roof", "..", "roof.obj/", ""])
def test_what_is_no_mesh_file_is_refused(desk, name):
    with pytest.raises(InvalidMesh):
        desk.shelf.put(name, b"v 0 0 0")


def test_empty_files_are_refused(desk):
    with pytest.raises(InvalidMesh):
        desk.shelf.put("roof.obj", b"")


def test_a_mesh_that_is_none_is_named_as_it_was_given(desk):
    name = desk.shelf.put("roof.obj", b"no mesh at all")
    with pytest.raises(InvalidMesh, match=r"^roof\.obj"):
        Mesh(desk.shelf.path(name), name).run(None, None)
    desk.close()

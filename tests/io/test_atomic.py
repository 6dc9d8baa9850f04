import pytest

from plisse.errors import PlisseError
from plisse.io.atomic import require_writable, written, written_together


def test_a_file_appears_with_its_contents(tmp_path):
    with written(tmp_path / "a.txt") as aside:
        aside.write_text("new")
        assert not (tmp_path / "a.txt").exists()
    assert (tmp_path / "a.txt").read_text() == "new"
    assert [file.name for file in tmp_path.iterdir()] == ["a.txt"]


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, ValueError])
def test_an_interrupted_file_keeps_its_old_contents(tmp_path, interruption):
    (tmp_path / "a.txt").write_text("old")
    with pytest.raises(interruption), written(tmp_path / "a.txt") as aside:
        aside.write_text("half")
        raise interruption
    assert (tmp_path / "a.txt").read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 1


@pytest.mark.parametrize("interruption", [KeyboardInterrupt, ValueError])
def test_an_interrupted_set_of_files_leaves_nothing_not_even_parents(tmp_path, interruption):
    with pytest.raises(interruption), written_together(tmp_path / "new" / "deep" / "out") as stage:
        (stage / "a.txt").write_text("half")
        raise interruption
    assert list(tmp_path.iterdir()) == []


def test_a_set_of_files_replaces_the_earlier_set_and_spares_the_rest(tmp_path):
    out = tmp_path / "out"
    out.mkdir()
    for name in ("a.txt", "b.txt", "notes.txt"):
        (out / name).write_text("old")
    with written_together(out, owned=("a.txt", "b.txt")) as stage:
        (stage / "a.txt").write_text("new")
    assert {file.name: file.read_text() for file in out.iterdir()} == {"a.txt": "new", "notes.txt": "old"}
    assert [file.name for file in tmp_path.iterdir()] == ["out"]


def test_an_unwritable_place_is_one_sentence(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(PlisseError, match=r"written \(it is a file"), written_together(tmp_path / "file"):
        pass
    with pytest.raises(PlisseError, match="choose another place"):
        require_writable(tmp_path / "file" / "below")
    with pytest.raises(PlisseError, match="be written"), written(tmp_path / "missing" / "a.txt") as aside:
        aside.write_text("x")


def test_asking_whether_a_place_is_writable_changes_nothing(tmp_path):
    require_writable(tmp_path / "a" / "b")
    assert list(tmp_path.iterdir()) == []


def test_nested_writing_names_the_file_that_was_asked_for(tmp_path):
    with pytest.raises(PlisseError) as caught, written(tmp_path / "missing" / "a.txt") as aside, written(aside) as inner:
        inner.write_text("x")
    assert str(caught.value).startswith(f"{tmp_path / 'missing' / 'a.txt'} cannot be written")

"""Copies of the best designs: only files of an earlier choice are replaced."""

import pytest

from plisse.errors import PlisseError
from plisse.io.designs import design_from_dict
from plisse.study.best import write_best
from plisse.study.store import Row

KEYS = ("0123456789abcdef", "fedcba9876543210")


@pytest.fixture
def rows(study):
    recipe = design_from_dict(study["base"]).to_dict()
    facts = {"parameters": {}, "recipe": recipe, "status": "exact", "reasons": [], "attempts": 1, "seconds": 0.1,
             "memory_mb": 1.0, "worker": None, "finished": None, "numbers": {}}
    return [Row(key=key, **facts) for key in KEYS]


def test_a_new_choice_replaces_the_earlier_one_and_leaves_the_files_of_others(tmp_path, rows):
    write_best(rows, tmp_path)
    (tmp_path / "2024-notes.txt").write_text("mine")
    (tmp_path / f"03-{KEYS[0]}.txt").write_text("mine")
    (tmp_path / "3-old.d").mkdir()
    files = write_best(rows[1:], tmp_path)
    made = {f"01-{KEYS[1]}.toml", f"01-{KEYS[1]}.png"}
    assert {file.name for file in files} < made
    assert {path.name for path in tmp_path.iterdir()} == {"2024-notes.txt", f"03-{KEYS[0]}.txt", "3-old.d"} | made


def test_a_directory_in_the_place_of_a_file_is_said_before_anything_is_written(tmp_path, rows):
    (tmp_path / f"02-{KEYS[1]}.png").mkdir()
    with pytest.raises(PlisseError, match="is a directory where a file must go"):
        write_best(rows, tmp_path)
    assert len(list(tmp_path.iterdir())) == 1

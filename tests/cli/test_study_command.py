"""`plisse study` in one process: options that do not go together, and the best of a study that is done."""

import pytest

from plisse.cli import main
from plisse.study.outcome import Outcome
from plisse.study.plan import read_plan
from plisse.study.samples import samples
from plisse.study.store import Store

STUDY = """[base.closed_form]
kind = "cones"
creases = 4
samples = 12
[vary]
closed_form.slope = [0.5, 1.0, 2.0]
"""


@pytest.fixture
def done(tmp_path, monkeypatch):
    """A study of three designs, two of them exact, in the current directory."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "few.toml").write_text(STUDY)
    (tmp_path / "few").mkdir()
    planned = samples(read_plan(tmp_path / "few.toml"))
    with Store(tmp_path / "few") as store:
        store.plan(planned)
        for status, sample in zip(("exact", "exact", "infeasible"), planned, strict=True):
            store.done(sample.key, Outcome(status=status, reasons=[], numbers={"min_sector_angle_deg": 50.0}))
    return tmp_path / "few"


@pytest.mark.parametrize(("options", "words"), [
    (["--best", "1", "--scheduler", "tcp://nowhere:1"], "--best adds nothing to a study, and --scheduler"),
    (["--best", "1", "--retry"], "--retry says how designs are added"),
    (["--best", "1", "--workers", "3"], "--workers says how designs are added"),
    (["--scheduler", "tcp://nowhere:1", "--workers", "3"], "--workers counts processes on this machine"),
])
def test_options_that_do_not_go_together_are_refused(done, capsys, options, words):
    assert main(["study", "few.toml", *options]) == 1
    assert words in capsys.readouterr().err and not (done / "best").exists()


@pytest.mark.parametrize(("option", "value"), [("--best", "2.5"), ("--workers", "1.9"), ("--best", "many")])
def test_counts_are_whole_numbers(done, capsys, option, value):
    assert main(["study", "few.toml", option, value]) == 2
    assert f'plisse: Invalid value for {option}: "{value}" is no whole number; see' in capsys.readouterr().err


def test_fewer_exact_designs_than_asked_for_are_said(done, capsys):
    assert main(["study", "few.toml", "--best", "50"]) == 0
    out, err = capsys.readouterr()
    assert len(out.splitlines()) == 2 and err == "only 2 designs are exact and can be chosen by regularity\n"
    assert main(["study", "few.toml", "--best", "2"]) == 0
    assert capsys.readouterr().err == ""


def test_a_study_whose_directory_would_be_its_own_file_wants_another_one(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "noext").write_text(STUDY)
    assert main(["study", "noext"]) == 1
    assert capsys.readouterr().err == ("plisse: noext is a file, and results go to a directory of that name; name another "
                                       "one with -o\n")

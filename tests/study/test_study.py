"""Whole studies on workers of their own."""

import csv
import json
import re
import sqlite3
import subprocess
import sys
import time
import tomllib
from collections import Counter
from contextlib import closing
from pathlib import Path

import psutil
import pytest

import plisse
from plisse.errors import InvalidDesign, PlisseError
from plisse.io.toml import write_toml
from plisse.recipe.fields import without_none
from plisse.study import Study, run
from plisse.study.crew import crew
from plisse.study.plan import Map
from plisse.study.store import STORE, locked


@pytest.fixture(scope="module")
def scheduler():
    """The address of a cluster that runs already."""
    with crew(workers=2) as running:
        yield running.client.scheduler.address


@pytest.fixture(scope="module")
def finished(tmp_path_factory, scheduler):
    """A study with outcomes of every kind that small designs can have."""
    directory = tmp_path_factory.mktemp("study") / "cones"
    plan = {"base": {"closed_form": {"kind": "cones", "creases": 4, "samples": 12, "sector": 90}},
            "vary": {"closed_form.slope": [0.5, 1.0, 99.0, -1.0], "closed_form.width": [4, 6]}}
    return plan, run(plan, directory, scheduler=scheduler)


def test_every_design_has_its_outcome_and_one_attempt(finished):
    _, study = finished
    assert study.is_complete and len(study.rows) == 8
    assert study.counts == {"exact": 4, "infeasible": 2, "invalid": 2}
    assert all(row.attempts == (row.status != "invalid") for row in study.rows)
    assert all(row.reasons for row in study.rows if row.status != "exact")


def test_a_row_holds_what_the_design_gives_when_made_alone(finished):
    _, study = finished
    row = study.rows[0]
    report = plisse.design(row.recipe).report
    assert row.numbers["min_sector_angle_deg"] == pytest.approx(report.min_sector_angle_deg, abs=1e-9)
    assert row.numbers["planarity"] < 1e-12
    assert (row.numbers["sheet_width_mm"], row.numbers["sheet_height_mm"]) == pytest.approx(report.development.size_mm)


def test_a_finished_study_is_not_made_again(finished):
    plan, study = finished
    again = run(plan, study.directory, scheduler="tcp://127.0.0.1:9")  # nobody is asked
    assert again.rows == study.rows


def test_the_table_holds_what_the_store_holds(finished):
    _, study = finished
    with (study.directory / "results.csv").open(encoding="utf-8", newline="") as stream:
        table = list(csv.DictReader(stream))
    for line, row in zip(table, study.rows, strict=True):
        assert (line["key"], line["status"], line["reasons"]) == (row.key, row.status, "; ".join(row.reasons))
        assert float(line["closed_form.slope"]) == row.parameters["closed_form.slope"]
        for name, value in row.numbers.items():
            assert line[name] == ("" if value is None else str(value)), name


def test_the_map_has_every_design(finished):
    _, study = finished
    one = study.places(Map(keys=["closed_form.slope", "closed_form.width"]))
    assert len(one) == 8 and all(place.counts.total() == 1 for place in one)
    shared = study.places(Map(keys=["closed_form.slope", "closed_form.creases"]))
    assert len(shared) == 4 and sum((place.counts for place in shared), Counter()) == Counter(study.counts)


def test_pictures_are_written(finished):
    from PIL import Image

    _, study = finished
    for name in ("contact-sheet.png", "map.png"):
        with Image.open(study.directory / name) as image:
            assert min(image.size) > 300


def test_the_best_designs_are_exact_in_order_and_copied_as_designs(finished):
    _, study = finished
    angles = [row.numbers["min_sector_angle_deg"] for row in study.best(by="regularity")]
    assert len(angles) == 4 and angles == sorted(angles, reverse=True)
    areas = [row.numbers["sheet_width_mm"] * row.numbers["sheet_height_mm"] for row in study.best(3, by="sheet_area")]
    assert len(areas) == 3 and areas == sorted(areas)
    with pytest.raises(InvalidDesign, match="beauty is no criterion; those are regularity, deviation"):
        study.best(by="beauty")


def test_copies_of_the_best_replace_earlier_ones(finished):
    _, study = finished
    study.write_best(2, by="regularity")
    files = study.write_best(1, by="opening")
    assert sorted(path.suffix for path in (study.directory / "best").iterdir()) == [".png", ".toml"]
    assert tomllib.loads(files[0].read_text(encoding="utf-8")) == study.best(1, by="opening")[0].recipe


def test_a_directory_without_a_study_is_a_sentence(tmp_path):
    with pytest.raises(PlisseError, match="there is no study in"):
        Study.load(tmp_path)


def test_a_scheduler_that_does_not_answer_is_a_sentence(tmp_path, study, monkeypatch):
    monkeypatch.setattr("plisse.study.crew.ANSWER_SECONDS", 0.5)
    with pytest.raises(PlisseError, match=r"no Dask scheduler answers at tcp://127.0.0.1:9 .*dask scheduler"):
        run(study, tmp_path / "out", scheduler="tcp://127.0.0.1:9")
    assert not any(tmp_path.iterdir())


@pytest.mark.parametrize("address", ["banana", "", "tcp://", "tcp://host", "host:port", "http://10.0.0.1:8786/x",
                                     "tcp://10.0.0.1:65536"])
def test_what_is_no_address_is_a_sentence_before_anything_is_said_or_left(tmp_path, study, address):
    said = []
    with pytest.raises(PlisseError, match="give an address of the form tcp://host:port"):
        run(study, tmp_path / "out", scheduler=address, progress=lambda stage, fraction: said.append(stage))
    assert not said and not any(tmp_path.iterdir())


def test_a_connection_that_is_refused_is_said_with_its_reason(tmp_path, study, monkeypatch):
    monkeypatch.setattr("plisse.study.crew.CONNECT_SECONDS", 1.0)
    # on a busy machine the second may be over before anybody could refuse
    with pytest.raises(PlisseError, match=r"at tcp://127.0.0.1:9 \((ConnectionRefused|Timeout)Error"):
        run(study, tmp_path / "out", scheduler="tcp://127.0.0.1:9")


SERVE = """
import asyncio, distributed
async def serve():
    async with distributed.Scheduler(host="127.0.0.1", port=0, dashboard=False) as scheduler:
        print(scheduler.address, flush=True)
        await scheduler.finished()
asyncio.run(serve())
"""


def test_a_scheduler_that_dies_is_one_sentence_and_what_is_done_is_kept(tmp_path, study, monkeypatch, capfd):
    monkeypatch.setattr("plisse.study.crew.ANSWER_SECONDS", 2.0)
    command = [sys.executable, "-c", SERVE]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, encoding="utf-8")
    address = server.stdout.readline().strip()
    with server, pytest.raises(PlisseError, match=rf"^the scheduler at {address} is gone; what is done is kept in .*out, "
                                                  "the same command goes on$"):
        run(study, tmp_path / "out", scheduler=address, progress=lambda stage, _: stage[0].isdigit() and server.kill())
    assert Study.load(tmp_path / "out").counts == {"waiting": 6}
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("workers", [-1, 0, 1.5, "two"])
def test_how_many_workers_is_a_whole_number_from_one(tmp_path, study, workers):
    with pytest.raises(InvalidDesign, match=f"workers is {workers!r}; give a whole number from 1"):
        run(study, tmp_path / "out", workers=workers)
    assert not any(tmp_path.iterdir())


def test_no_more_workers_are_started_than_designs_wait():
    before = psutil.Process().children()
    with crew(designs=1):
        assert len(set(psutil.Process().children()) - set(before)) == 1


def test_where_another_study_works_no_worker_is_started(tmp_path, study, monkeypatch):
    monkeypatch.setattr("plisse.study.study.crew", None)
    with locked(tmp_path), pytest.raises(PlisseError, match="another study works in"):
        run(study, tmp_path)
    assert not any(tmp_path.iterdir())


def test_a_server_that_is_no_scheduler_is_a_sentence_and_leaves_nothing(tmp_path, study, monkeypatch):
    import socket

    monkeypatch.setattr("plisse.study.crew.ANSWER_SECONDS", 0.5)
    with socket.create_server(("127.0.0.1", 0)) as silent, pytest.raises(PlisseError, match="no Dask scheduler answers at"):
        run(study, tmp_path / "out", scheduler=f"tcp://127.0.0.1:{silent.getsockname()[1]}")
    assert not any(tmp_path.iterdir())


def test_a_scheduler_without_workers_is_said_until_one_comes(tmp_path, study, monkeypatch):
    from distributed import LocalCluster

    said = []
    monkeypatch.setattr("plisse.study.crew.SILENT_SECONDS", 0.2)
    with LocalCluster(n_workers=0, threads_per_worker=1, dashboard_address=":0", protocol="tcp") as cluster:
        address = cluster.scheduler_address

        def listen(stage, fraction):
            if "no workers" in stage and not said:
                said.append(stage)
                command = [sys.executable, "-m", "plisse.study.worker", address]
                helpers.append(subprocess.Popen(command, stdin=subprocess.PIPE))

        helpers: list[subprocess.Popen] = []
        found = run(study, tmp_path / "out", scheduler=address, progress=listen)
        for helper in helpers:
            helper.kill()
            helper.communicate()
    assert said == [f"the scheduler has no workers yet: start `dask worker {address}`"]
    assert found.counts == {"exact": 6}


def test_designs_of_an_earlier_study_are_kept_and_not_counted(tmp_path, study, scheduler, capsys):
    from plisse.cli import main

    run(study, tmp_path, scheduler=scheduler)
    hopeless = tmp_path / "hopeless.toml"
    write_toml({**study, "vary": {"closed_form.slope": [99.0]}}, hopeless)
    assert main(["study", str(hopeless), "-o", str(tmp_path), "--scheduler", scheduler]) == 3
    printed = capsys.readouterr().out
    assert printed.startswith("1 designs: 1 infeasible\n")
    assert "6 designs of earlier studies are kept in the store, they are not counted" in printed
    assert len((tmp_path / "results.csv").read_text(encoding="utf-8").splitlines()) == 2
    assert main(["study", str(hopeless), "-o", str(tmp_path), "--best", "1"]) == 1
    assert len(Study.load(tmp_path).rows) == 7


def test_a_study_without_a_map_leaves_none_of_an_earlier_one(tmp_path, study, scheduler):
    run(study, tmp_path, scheduler=scheduler)
    assert (tmp_path / "map.png").exists()
    run({**study, "vary": {"closed_form.slope": [0.5, 1.0]}}, tmp_path, scheduler=scheduler)
    assert not (tmp_path / "map.png").exists()


def test_a_missing_dask_is_a_sentence(tmp_path, study, monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(PlisseError, match=r'distributed, which is not installed; pip install "plisse\[sweep\]"'):
        run(study, tmp_path / "out")


def started(file, directory, *options):
    command = [sys.executable, "-m", "plisse", "study", str(file), "-o", str(directory), "--quiet", *options]
    return subprocess.Popen(command, stderr=subprocess.PIPE, encoding="utf-8")


def outcomes(directory):
    """Key and time of every committed design."""
    if not (directory / STORE).exists():
        return {}
    with closing(sqlite3.connect(f"{(directory / STORE).as_uri()}?mode=ro", uri=True, timeout=30)) as base:
        try:
            return dict(base.execute("SELECT key, finished FROM designs WHERE finished IS NOT NULL"))
        except sqlite3.OperationalError:  # no table yet
            return {}


def wait_until(condition, process=None, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end and (process is None or process.poll() is None), "it never happened"
        time.sleep(0.02)


def descendants(process):
    return psutil.Process(process.pid).children(recursive=True)


def curved(tmp_path, count):
    """A study file of designs of some tenths of a second."""
    base = {"curve": {"kind": "arc", "radius": 100, "angle": 90},
            "pattern": {"theta": 20, "creases": 6, "width": 5, "amplitude": 3, "samples": 40}}
    file = tmp_path / "study.toml"
    write_toml(without_none({"base": base, "vary": {"pattern.theta": {"start": 0, "stop": 40, "count": count}}}), file)
    return file


def kill_and_go_on(file, directory, count, steps, workers):
    """Kill a study by SIGKILL after each of `steps` commits, let it finish, and check that nothing was lost or repeated."""
    before = {}
    for step in steps:
        process = started(file, directory, "--workers", str(workers))
        wait_until(lambda step=step: len(outcomes(directory)) >= step, process)
        family = descendants(process)
        process.kill()
        process.communicate()
        wait_until(lambda family=family: not any(child.is_running() for child in family))
        after = outcomes(directory)
        assert before.items() <= after.items()
        before = after
    study = run(file, directory, workers=workers)
    assert study.counts == {"exact": count}
    assert before.items() <= outcomes(directory).items()
    assert sum(row.attempts for row in study.rows) <= count + len(steps) * workers  # those under way are retried
    assert all(row.attempts == 1 for row in study.rows if row.key in before and row.attempts != 2)


def test_a_study_that_was_killed_goes_on_without_loss_or_repetition(tmp_path):
    kill_and_go_on(curved(tmp_path, 8), tmp_path / "out", 8, [3], workers=1)


@pytest.mark.slow
def test_two_hundred_designs_killed_three_times_are_each_done_once(tmp_path):
    kill_and_go_on(curved(tmp_path, 200), tmp_path / "out", 200, [20, 80, 150], workers=2)


@pytest.mark.slow
@pytest.mark.parametrize("count", [8, 100])  # each handed out alone, and many together
def test_a_worker_killed_in_the_middle_costs_only_a_retry(tmp_path, count):
    killed = []

    def kill(stage, fraction):
        if fraction > 0.3 and not killed:
            killed.append(next(child for child in psutil.Process().children() if child.pid not in others))
            killed[0].kill()

    others = {child.pid for child in psutil.Process().children()}
    study = run(curved(tmp_path, count), tmp_path / "out", workers=1, progress=kill)
    assert killed and study.counts == {"exact": count}
    assert sorted(row.attempts for row in study.rows) in ([1] * (count - 1) + [2], [1] * count)
    assert len({row.worker for row in study.rows}) == 2


def test_designs_over_their_time_are_rows_and_a_retry_makes_them(tmp_path, study, scheduler):
    out = tmp_path / "out"
    study["vary"] = {"closed_form.slope": [0.5, 1.0]}
    slow = run({**study, "limits": {"seconds": 0.001}}, out, scheduler=scheduler)
    assert slow.counts == {"timeout": 2}
    assert run(study, out, scheduler=scheduler).counts == {"timeout": 2}
    assert run(study, out, scheduler=scheduler, retry=True).counts == {"exact": 2}


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no SIGINT for one process")
@pytest.mark.slow
def test_an_interrupted_study_ends_in_a_sentence_and_leaves_nothing_running(tmp_path):
    import signal

    directory = tmp_path / "out"
    process = started(curved(tmp_path, 40), directory, "--workers", "1")
    wait_until(lambda: len(outcomes(directory)) >= 1, process)
    family = descendants(process)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=30)
    assert process.returncode == 130
    assert re.fullmatch(r"plisse: interrupted; what is done is kept in .*out, the same command goes on\n", errors)
    wait_until(lambda: not any(child.is_running() for child in family))


def test_the_command_prints_outcomes_and_copies_the_best(tmp_path, study, capsys, monkeypatch, scheduler):
    from plisse.cli import main

    monkeypatch.chdir(tmp_path)
    (tmp_path / "few.toml").write_text('[base.closed_form]\nkind = "cones"\ncreases = 4\nsamples = 12\n'
                                       "[vary]\nclosed_form.slope = [0.5, 1.0]\n")
    assert main(["study", "few.toml", "--json", "--scheduler", scheduler]) == 0
    assert json.loads(capsys.readouterr().out)["outcomes"] == {"exact": 2}
    assert main(["study", "few.toml", "--best", "1", "--by", "sheet_area"]) == 0
    assert capsys.readouterr().out.strip().startswith(str(Path("few", "best", "01-")))
    assert main(["study", "nothing.toml"]) == 1
    assert capsys.readouterr().err == "plisse: there is no file nothing.toml; give a study file (TOML)\n"

"""Requests are answered in a process: the newest wins, stale ones are dropped, and a crash ends one request only."""

import gc
import os
import queue
import signal
import time
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import plisse
from plisse.io.designs import design_from_dict
from plisse.session import changed
from plisse.studio.child import Answer, Failure, Stage
from plisse.studio.requests import Colour, Fetch, Pose, Reach, Request, Solid, Solve
from plisse.studio.worker import Worker

RECIPE = design_from_dict({"curve": {"kind": "arc", "radius": 100, "angle": 70},
                           "pattern": {"theta": 30, "creases": 5, "width": 6, "amplitude": 3, "samples": 41},
                           "solve": {"principal": True}})


class InTheWay(Request):
    """Something that a solve makes stale."""

    @property
    def lane(self):
        return "Solve"


@dataclass(frozen=True)
class Sleepy(InTheWay):
    """Sleeps and looks up from time to time."""

    seconds: float
    listens: bool = True

    def run(self, bench, progress):
        end = time.monotonic() + self.seconds
        while time.monotonic() < end:
            time.sleep(0.01)
            if self.listens:
                progress("sleeping", 0.5)
        return "slept"


@dataclass(frozen=True)
class Sketchy(Sleepy):
    """As a draft is: let finish, and newer than every whole before it."""

    lane = "Draft"
    outdates = ("Draft", "Solve")
    is_brief = True


@dataclass(frozen=True)
class Murdered(InTheWay):
    def run(self, bench, progress):
        os.kill(os.getpid(), signal.SIGKILL)


@dataclass(frozen=True)
class Broken(InTheWay):
    def run(self, bench, progress):
        raise ZeroDivisionError


@dataclass(frozen=True)
class Endless(InTheWay):
    limit: ClassVar[float] = 0.3

    def run(self, bench, progress):
        time.sleep(100)


class Client:
    """A worker whose answers are kept."""

    def __init__(self):
        self.answers = queue.SimpleQueue()
        self.stages = []
        self.worker = Worker(self._deliver)

    def _deliver(self, request, message):
        if isinstance(message, Stage):
            self.stages.append((request, message))
        else:
            self.answers.put((request, message))

    def answer(self):
        return self.answers.get(timeout=60)

    def value(self, request):
        self.worker.ask(request)
        answered, message = self.answer()
        assert answered is request
        assert isinstance(message, Answer), message
        return message.value


@pytest.fixture(scope="module")
def client():
    client = Client()
    yield client
    client.worker.close()


@pytest.fixture(autouse=True)
def findable(monkeypatch):
    """The process behind a worker finds the requests of this file."""
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent), prepend=os.pathsep)


def test_a_solve_gives_what_a_script_gets(client):
    found = client.value(Solve(RECIPE, framed=True))
    result = plisse.design(RECIPE)
    assert found.report.status == "exact"
    assert found.report.planarity == result.report.planarity
    fetched = client.value(Fetch(RECIPE))
    assert np.array_equal(fetched.structure.vertices, result.structure.vertices)
    assert found.camera.axes.shape == (3, 3)


def test_sixty_changes_in_a_second_leave_the_last_one(client):
    for theta in np.linspace(10, 39.5, 60).tolist():
        client.worker.ask(Solve(changed(RECIPE, {"theta": theta})))
        time.sleep(1 / 60)
    last, seen = None, 0
    while last is None or last.recipe.pattern.theta != 39.5:
        last, message = client.answer()
        assert isinstance(message, Answer)
        assert message.value.report.design["pattern"]["theta"] == last.recipe.pattern.theta
        seen += 1
    assert seen <= 60
    assert client.answers.empty()


def test_a_draft_that_was_begun_is_finished_and_only_the_newest_waits(client):
    client.worker.ask(Sketchy(0.5))
    while not client.stages or not isinstance(client.stages[-1][0], Sketchy):
        time.sleep(0.01)
    for seconds in (0.3, 0.2, 0.1):
        client.worker.ask(Sketchy(seconds))
    assert [client.answer()[0] for _ in range(2)] == [Sketchy(0.5), Sketchy(0.1)]
    assert client.answers.empty()


def test_a_draft_drops_the_whole_and_waits_beside_it(client):
    client.worker.ask(Sleepy(50))
    while not client.stages or client.stages[-1][0] != Sleepy(50):
        time.sleep(0.01)
    client.worker.ask(Sketchy(0.1))
    client.worker.ask(Sleepy(0.1))
    assert [client.answer()[0] for _ in range(2)] == [Sketchy(0.1), Sleepy(0.1)]


def test_a_stale_request_that_listens_is_dropped_and_its_process_kept(client):
    client.value(Solve(RECIPE))
    before = client.worker.pid
    client.worker.ask(Sleepy(50))
    while not client.stages or not isinstance(client.stages[-1][0], Sleepy):
        time.sleep(0.01)
    assert client.value(Solve(RECIPE)).report.status == "exact"
    assert client.worker.pid == before


def test_a_stale_request_that_does_not_listen_is_ended_with_its_process(client):
    client.value(Solve(RECIPE))
    before = client.worker.pid
    client.worker.ask(Sleepy(50, listens=False))
    time.sleep(0.1)
    assert client.value(Solve(RECIPE)).report.status == "exact"
    assert client.worker.pid != before


@pytest.mark.parametrize(("request_", "words"), [(Murdered(), "ended its process"), (Broken(), "did not foresee"),
                                                 (Endless(), "longer than")])
def test_a_crash_ends_that_request_only(client, request_, words, capfd):
    client.value(Solve(RECIPE))
    client.worker.ask(request_)
    answered, message = client.answer()
    assert answered is request_
    assert isinstance(message, Failure)
    assert words in message.sentence
    assert client.value(Solve(RECIPE)).report.status == "exact"


def test_lanes_do_not_push_each_other_out(client):
    client.worker.ask(Solve(RECIPE))
    client.worker.ask(Pose(RECIPE, 40))
    client.worker.ask(Pose(RECIPE, 50))
    client.worker.ask(Colour(RECIPE, "opening"))
    kinds = [client.answer()[0] for _ in range(3)]
    assert kinds == [Solve(RECIPE), Pose(RECIPE, 50), Colour(RECIPE, "opening")]


def test_poses_are_states_of_the_motion_and_solids_those_of_the_library(client):
    structure = plisse.design(RECIPE).structure
    pose, flat = client.value(Pose(RECIPE, 60)), client.value(Pose(RECIPE, 0))
    known = structure.flex(60).vertices[0]
    assert np.allclose(np.unique(pose.points, axis=0), np.unique(known.astype(np.float32), axis=0), atol=1e-4)
    assert np.linalg.matrix_rank(flat.points - flat.points.mean(axis=0), tol=1e-2) == 2
    moved = client.value(Solid(RECIPE, "offset", 1.0))
    assert np.allclose(np.unique(moved.points, axis=0), np.unique(structure.offset(1.0).vertices.astype(np.float32), axis=0),
                       atol=1e-4)
    topology, plates = structure.topology, client.value(Solid(RECIPE, "plates", 0.5))
    assert len(plates.triangles) == 4 * topology.face_count + 2 * topology.edges.is_boundary.sum()
    reach, offsets = client.value(Reach(structure))
    assert reach == structure.flex(100).free_range
    assert offsets[0] < 0 < offsets[1]


def test_a_formula_is_parsed_and_never_run(client, tmp_path):
    target = tmp_path / "proof"
    for formula in (f"__import__('pathlib').Path('{target}').touch()", "open('/etc/passwd')", "x.__class__", "9**9**9**9*x"):
        client.worker.ask(Solve(design_from_dict({"surface": {"height": formula}})))
        assert isinstance(client.answer()[1], Failure)
    assert not target.exists()


def test_closing_ends_process_and_thread():
    client = Client()
    client.value(Solve(RECIPE))
    process = client.worker.pid
    client.worker.ask(Sleepy(50, listens=False))
    time.sleep(0.05)
    client.worker.close()
    with pytest.raises(ProcessLookupError):
        os.kill(process, 0)
    assert not client.worker._thread.is_alive()
    gc.collect()


@pytest.mark.slow
def test_memory_stays_the_same_over_many_edits(client):
    def memory():
        return int(Path(f"/proc/{client.worker.pid}/statm").read_text().split()[1])

    for edit in range(300):
        client.value(Solve(changed(RECIPE, {"theta": 20 + edit % 30, "creases": 5 + edit % 3}), colour="opening"))
        if edit == 100:
            before = memory()
    assert memory() < 1.03 * before

"""A process is ready before somebody needs it, and none is left over."""

import pickle
import time
from pathlib import Path

import pytest

from plisse.io.designs import design_from_dict
from plisse.studio import worker
from plisse.studio.requests import Solve
from plisse.studio.worker import Spare, Worker

RECIPE = design_from_dict({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})


def runs(pid):
    return Path(f"/proc/{pid}").exists()


def until(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this did not happen in time"
        time.sleep(0.01)


@pytest.fixture
def spare(monkeypatch):
    monkeypatch.setattr(worker, "LATER", 0.05)
    spare = Spare()
    yield spare
    spare.close()


def test_who_asks_first_gets_the_process_that_is_ready_and_the_next_one_another(spare):
    ready, answers = spare._process.pid, []
    first = Worker(lambda *told: answers.append(told), spare.take)
    first.ask(Solve(RECIPE))
    until(lambda: answers and answers[-1][0] == Solve(RECIPE) and hasattr(answers[-1][1], "value"))
    assert first.pid == ready
    until(lambda: spare._process is not None)
    assert spare._process.pid != ready
    first.close()
    assert not runs(ready)


def test_a_process_that_died_while_it_waited_is_replaced(spare):
    died = spare._process
    died._popen.kill()
    until(lambda: not died.is_alive)
    taken = spare.take()
    assert taken.is_alive
    assert taken.pid != died.pid
    assert not runs(died.pid)
    taken.end()


def test_closing_leaves_none_and_starts_none(spare):
    waiting = spare._process.pid
    taken = spare.take()
    spare.close()
    time.sleep(0.2)
    assert spare._process is None
    taken.end()
    assert not runs(waiting)


def test_a_worker_that_is_closed_while_it_starts_a_process_ends_it():
    started = []

    def start():
        time.sleep(0.1)
        started.append(worker.Process())
        return started[-1]

    closing = Worker(lambda *_: None, start)
    closing.ask(Solve(RECIPE))
    time.sleep(0.05)
    closing.close()
    until(lambda: started)
    until(lambda: not runs(started[0].pid))


@pytest.mark.parametrize("sent", [b"", b"half of a request"])
def test_a_process_ends_with_its_input_wherever_that_ends(sent):
    process = worker.Process()
    process._popen.stdin.write(pickle.dumps((1, sent), protocol=5)[:-5] if sent else b"")
    process._popen.stdin.close()
    process._popen.wait(timeout=30)
    assert process.end() == 0

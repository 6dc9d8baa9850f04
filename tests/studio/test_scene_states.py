"""What a tab shows and says while it waits, and after a design broke down."""

from types import SimpleNamespace

import msgspec
import pytest

import plisse
from plisse.studio.child import Answer, Stage

pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")

from plisse.studio.requests import Found, Solve
from plisse.studio.tab import Tab
from plisse.studio.view import folded_view
from plisse.studio.waiting import Waiting

RESULT = plisse.design({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})
SOUND = Found(RESULT.report, False, folded=folded_view(RESULT.structure))
BROKEN = Found(msgspec.structs.replace(RESULT.report, status="infeasible"), False)


class Recorder:
    """Stands for panels, scene and handles: remembers what was called."""

    def __init__(self):
        self.called, self.said, self.is_pale, self.extent = [], [], False, (None, 1.0)
        self.handles_wanted = False

    def say(self, status):
        self.said.append(status.brief)

    def __getattr__(self, name):
        return lambda *_: self.called.append(name)


@pytest.fixture
def tab():
    from plisse.studio.pace import Pace

    tab, timers = Tab.__new__(Tab), []
    tab.panels, tab.scene, tab.handles, tab._hands = (Recorder() for _ in range(4))
    tab.errands = Recorder()
    tab.desk = SimpleNamespace(recipe=RESULT.design, solvable=RESULT.design, step=SimpleNamespace(title="cones"))
    tab.found, tab.free, tab.colour, tab.solid, tab.percent = SOUND, None, "", ("", 0.0), 100.0
    tab.is_open, tab._framed, tab._is_refused, tab._rest = True, True, False, None
    tab._pace, tab.timers = Pace(), timers
    handle = SimpleNamespace(cancel=timers.clear)
    tab._loop = SimpleNamespace(call_later=lambda seconds, action: timers.append(action) or handle)
    tab._waiting = Waiting(tab._loop, tab._say_late)
    return tab


def test_what_was_there_before_a_breakdown_stays_pale(tab):
    tab._receive(Solve(RESULT.design), Answer(1, BROKEN, 0.01))
    assert "pale" in tab.scene.called
    assert "show" not in tab.scene.called
    tab._receive(Solve(RESULT.design), Answer(2, SOUND, 0.01))
    assert "show" in tab.scene.called


def test_a_long_solve_is_said_to_be_under_way_even_after_a_fast_one(tab):
    tab._pace.learn(SOUND, 0.01)
    solve = Solve(RESULT.design)
    tab._ask_solve(solve)
    tab._receive(solve, Stage(1, "solve", 0.2))
    assert tab.panels.said == []
    tab.timers[0]()
    tab._receive(solve, Stage(1, "solve", 0.4))
    assert all("working" in said for said in tab.panels.said)
    assert len(tab.panels.said) == 2
    tab._receive(solve, Answer(1, SOUND, 0.6))
    assert "exact" in tab.panels.said[-1]
    assert tab._waiting.is_over

"""What a tab shows and says while it waits, and after a design broke down."""

from dataclasses import replace
from types import SimpleNamespace

import msgspec
import pytest

import plisse
from plisse.studio.child import Answer, Failure, Stage

pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")

from plisse.studio.dress import Dress
from plisse.studio.errands import Errands
from plisse.studio.look_panel import LookPanel
from plisse.studio.model import Desk
from plisse.studio.paper import Shown
from plisse.studio.requests import Candidates, Found, Solve
from plisse.studio.solving import REST, Solving
from plisse.studio.standing import Standing
from plisse.studio.tab import LONGER, Tab
from plisse.studio.view import folded_view
from plisse.studio.waiting import LATE, Later
from plisse.transform.collisions import FreeRange

RESULT = plisse.design({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})
SOUND = Found(RESULT.report, False, folded=folded_view(RESULT.structure))
BROKEN = Found(msgspec.structs.replace(RESULT.report, status="infeasible"), False)


class Recorder:
    """Stands for panels, scene and handles: remembers what was called."""

    def __init__(self):
        self.called, self.said, self.is_pale, self.extent = [], [], False, (None, 1.0)
        self.handles_wanted = self.is_pulled = False
        self.asked, self.status = [], None

    def say(self, status):
        self.said.append(status.brief)
        self.status = status.html

    def ask(self, request):
        self.asked.append(request)

    def __getattr__(self, name):
        return lambda *_: self.called.append(name)


class Clock:
    """Stands for the event loop: what is to come later comes when a test says so."""

    def __init__(self):
        self.waiting = []

    def call_later(self, seconds, action):
        timer = SimpleNamespace(seconds=seconds, action=action)
        timer.cancel = lambda: timer in self.waiting and self.waiting.remove(timer)
        self.waiting.append(timer)
        return timer

    def pass_by(self, seconds):
        due = [timer for timer in self.waiting if timer.seconds <= seconds]
        self.waiting = [timer for timer in self.waiting if timer not in due]
        for timer in due:
            timer.action()


@pytest.fixture
def tab():
    tab, clock = Tab.__new__(Tab), Clock()
    tab.panels, tab.scene, tab.handles, tab._hands, tab.errands = (Recorder() for _ in range(5))
    tab.desk, tab.clock = Desk(RESULT.design, "cones"), clock
    tab.standing, tab.free, tab.dress = Standing(SOUND, "cones"), None, Dress(tab.scene, tab.ask, tab.panels.show_scale)
    tab.is_open, tab._framed = True, True
    tab._solving, tab._longer = Solving(clock, tab.ask, tab._say_late), Later(clock, LONGER)
    yield tab
    tab.desk.close()


class Gui:
    """Stands for the controls of a page: each is a value and what was set of it."""

    def __getattr__(self, _name):
        return lambda _label, value=None, *_, **__: Control(value[0] if isinstance(value, tuple) else value)


class Control(SimpleNamespace):
    """A control that is a folder as well, and takes any call-back."""

    def __init__(self, value):
        super().__init__(value=value, visible=True, disabled=False, content="")
        self.on_update = self.on_click = lambda _action: None

    def __enter__(self):
        return self

    def __exit__(self, *_):
        return None


@pytest.fixture
def look(tab):
    """The controls of the look, which are those of the tab's panels, too."""
    tab.client, tab.scene.shown, tab.scene.scale_of_sheet = SimpleNamespace(gui=Gui()), Shown(), 0.0
    look = LookPanel(tab)
    tab.panels.refresh, tab.panels.show_chosen, tab.panels.fit = look.refresh, look.show_chosen, look.fit
    return look


def answer(tab, value=SOUND.folded):
    """Take in an answer to what was asked for last; a sentence is a failure."""
    tab._receive(tab._hands.asked[-1], Failure(1, value) if isinstance(value, str) else Answer(1, value, 0.01))


def found_of(recipe, *, principal=False):
    """What a solve of a recipe brings, without solving it."""
    return replace(SOUND, report=msgspec.structs.replace(SOUND.report, principal=principal, design=recipe))


def test_what_was_there_before_a_breakdown_stays_pale(tab):
    tab._receive(Solve(RESULT.design), Answer(1, BROKEN, 0.01))
    assert "pale" in tab.scene.called
    assert "show" not in tab.scene.called
    tab._receive(Solve(RESULT.design), Answer(2, SOUND, 0.01))
    assert "show" in tab.scene.called


def test_a_long_solve_is_said_to_be_under_way_even_after_a_fast_one(tab):
    tab._solving._pace.learn(SOUND, 0.01)
    solve = Solve(RESULT.design)
    tab._solving.ask(solve)
    tab._receive(solve, Stage(1, "solve", 0.2))
    assert tab.panels.said == []
    tab.clock.pass_by(LATE)
    tab._receive(solve, Stage(1, "solve", 0.4))
    assert all("working" in said for said in tab.panels.said)
    assert len(tab.panels.said) == 2
    tab._receive(solve, Answer(1, SOUND, 0.6))
    assert "exact" in tab.panels.said[-1]
    assert tab._solving.is_over


def test_a_change_that_waits_for_rest_is_solved_although_an_older_answer_comes_between(tab):
    tab._solving._pace.waits = lambda _recipe: True
    before = tab.desk.recipe
    tab.change({"closed_form.creases": 6})
    assert tab._hands.asked == []
    tab._receive(Solve(before), Answer(1, found_of(before, principal=True), 0.01))
    tab.clock.pass_by(REST)
    assert tab._hands.asked[-1].recipe.closed_form.creases == 6
    assert tab.panels.said == []
    assert "show" not in tab.scene.called


def test_what_takes_longer_waits_beside_the_full_answer_and_both_end_with_a_newer_solve(tab):
    tab._solving._pace.waits = lambda _recipe: True
    tab._receive(Solve(tab.desk.recipe), Answer(1, found_of(tab.desk.recipe, principal=True), 0.01))
    assert [timer.seconds for timer in tab.clock.waiting] == [LONGER]
    for creases in (6, 8):
        tab.change({"closed_form.creases": creases})
        assert [timer.seconds for timer in tab.clock.waiting] == [REST]


def test_an_answer_that_was_overtaken_is_shown_as_a_draft_while_a_design_is_pulled(tab):
    before = tab.desk.recipe
    tab.change({"closed_form.creases": 6})
    tab._receive(Solve(before, quick=True), Answer(1, found_of(before), 0.01))
    assert "show" in tab.scene.called
    assert tab.found.drafted
    assert "draft" in tab.panels.said[-1]
    tab._receive(Solve(before), Failure(2, "no longer of interest"))
    assert "pale" not in tab.scene.called


@pytest.mark.parametrize("held", [100.0, 60.0])
def test_a_pose_that_is_refused_goes_back_to_that_on_screen(tab, held):
    tab.pose(held)
    if tab._hands.asked:
        tab._receive(tab._hands.asked[-1], Answer(1, SOUND.folded, 0.01))
    tab.pose(201.0)
    tab.panels.called.clear()
    tab._receive(tab._hands.asked[-1], Failure(2, "there is no such state"))
    assert tab.dress.chosen.percent == held
    assert "not done" in tab.panels.said[-1]
    assert "refresh" in tab.panels.called


def test_a_thickness_that_is_refused_is_not_asked_for_again(tab):
    tab.solidify("plates", 1.0)
    tab._receive(tab._hands.asked[-1], Answer(1, SOUND.folded, 0.01))
    tab.solidify("plates", 1000.0)
    tab._receive(tab._hands.asked[-1], Failure(2, "plates this thick do not exist"))
    assert tab.dress.chosen.solid == ("plates", 1.0)
    tab._receive(Solve(tab.desk.recipe), Answer(3, SOUND, 0.01))
    assert tab._hands.asked[-1].length == 1.0
    tab._receive(tab._hands.asked[-1], Failure(4, "plates this thick do not exist"))
    assert tab.dress.chosen.solid == ("", 0.0)


def test_the_camera_stays_when_a_text_is_refused_and_moves_for_another_design(tab):
    tab.read("this is no design")
    assert tab.standing.refusal
    assert tab._framed
    tab.read("[closed_form]\nkind = 'cones'\ncreases = 6\n")
    assert not tab._framed
    assert not tab.standing.refusal


def test_nothing_is_said_to_be_pale_where_nothing_was(tab):
    tab.standing.found = replace(SOUND, folded=None, reference=None)
    said = []
    tab.panels.say = lambda status: said.append(status.html)
    tab._receive(Solve(tab.desk.recipe), Failure(1, "it breaks down"))
    assert "it breaks down" in said[-1]
    assert "Pale" not in said[-1]


def test_what_was_refused_before_a_note_at_a_box_does_not_come_back_when_a_solve_ends(tab):
    tab._solving._pace.waits = lambda _recipe: True
    tab.change({"closed_form.creases": 6})
    tab.clock.pass_by(REST)
    tab.change({"closed_form.creases": -6})
    assert "not done" in tab.panels.said[-1]
    tab.clock.pass_by(LATE)
    tab.forget_refusal()
    assert "working" in tab.panels.said[-1]
    tab._receive(tab._hands.asked[-1], Answer(1, found_of(tab.desk.recipe), 0.6))
    assert "exact" in tab.panels.said[-1]


def test_only_what_was_found_is_called_exact_and_by_its_own_title(tab):
    tab._solving._pace.waits = lambda _recipe: True
    tab.read("[closed_form]\nkind = 'cones'\ncreases = 6\n", "new cones")
    tab.read("this is no design")
    assert "new cones" not in tab.panels.status
    tab.clock.pass_by(REST)
    tab.clock.pass_by(LATE)
    tab.read("this is no design either")
    assert "working" in tab.panels.status
    assert "exact" not in tab.panels.status
    tab._receive(tab._hands.asked[-1], Answer(1, found_of(tab.desk.recipe), 0.6))
    assert "exact</span> new cones" in tab.panels.status
    assert "not done" in tab.panels.status


def test_a_search_for_layouts_writes_over_nothing_and_its_words_go_when_it_ends(tab):
    tab.errands, search = Errands(tab), Candidates(None)
    tab._receive(search, Stage(1, "refine", 0.5))
    assert "refine (50 %)" in tab.panels.status
    assert "exact" in tab.panels.status
    tab._receive(Solve(tab.desk.recipe), Failure(1, "the solver died"))
    tab.refuse("no such thing")
    tab._receive(search, Stage(1, "refine", 0.89))
    for said in ("refine (89 %)", "no such thing", "the solver died"):
        assert said in tab.panels.status
    tab._receive(search, Answer(1, [], 9.0))
    assert "refine" not in tab.panels.status
    assert "the solver died" in tab.panels.status


@pytest.mark.parametrize("choose", [lambda tab: tab.pose(100.0), lambda tab: tab.paint(""),
                                    lambda tab: tab.solidify("", 1.0), lambda tab: tab.act(lambda: None)])
def test_a_refusal_is_said_until_something_newer_is_chosen(tab, choose):
    tab.solidify("plates", 1000.0)
    answer(tab, "plates this thick do not exist")
    assert "this thick" in tab.panels.status
    choose(tab)
    assert "this thick" not in tab.panels.status


def test_a_refusal_that_came_after_what_was_asked_for_stays_when_that_is_there(tab):
    tab.pose(60.0)
    tab.refuse("no such thing")
    answer(tab)
    assert "no such thing" in tab.panels.status


def test_what_was_carried_over_to_another_design_and_cannot_be_is_dropped_without_a_word(tab, look):
    tab.solidify("plates", 1.0)
    answer(tab)
    tab.change({"closed_form.creases": 6})
    tab.clock.pass_by(REST)
    tab._receive(tab._hands.asked[-1], Answer(1, found_of(tab.desk.recipe), 0.01))
    answer(tab, "the structure is not principal")
    assert "not done" not in tab.panels.status
    assert look._kind.value == "sheet"
    tab.solidify("plates", 1.0)
    answer(tab, "the structure is not principal")
    assert "not done" in tab.panels.status


def test_controls_say_what_is_on_screen_when_a_solve_broke_down(tab, look):
    tab.paint("opening")
    answer(tab)
    assert look._colours.value == "opening"
    tab.show_reach(FreeRange(5.0, 175.0), (-1.0, 1.0))
    tab.panels.called.clear()
    tab._receive(Solve(tab.desk.recipe), Failure(1, "it breaks down"))
    assert look._colours.value == "paper"
    assert look._colours.disabled
    assert look._kind.disabled
    assert "forget_reach" in tab.panels.called
    assert tab.free is None
    tab._receive(Solve(tab.desk.recipe, colour="opening"), Answer(2, replace(SOUND, tint="opening"), 0.01))
    assert look._colours.value == "opening"
    assert not look._colours.disabled


@pytest.mark.parametrize(("choose", "control", "before"), [
    (lambda tab: tab.solidify("offset", 2.0), "_kind", "offset"), (lambda tab: tab.paint("opening"), "_colours", "opening")])
def test_controls_say_what_is_on_screen_in_a_state_of_the_motion(tab, look, choose, control, before):
    plain = getattr(look, control).value
    for choice, value in ((choose, before), (lambda tab: tab.pose(180.0), plain), (lambda tab: tab.pose(100.0), before)):
        choice(tab)
        answer(tab)
        assert getattr(look, control).value == value


def test_a_thickness_that_is_typed_while_nothing_is_thick_changes_nothing_on_screen(tab):
    tab.pose(60.0)
    answer(tab)
    asked = len(tab._hands.asked)
    tab.thicken(2.0)
    assert tab.dress.chosen.percent == 60.0
    assert len(tab._hands.asked) == asked


def test_the_thickness_box_does_not_keep_what_was_refused(tab, look):
    tab.solidify("plates", 1000.0)
    assert look._length.value == 1000.0
    answer(tab, "plates this thick do not exist")
    assert look._length.value < 1.0


def test_why_a_design_broke_and_what_is_pale_stay_below_a_later_refusal(tab):
    tab._receive(Solve(tab.desk.recipe), Answer(1, SOUND, 0.01))
    tab.scene.is_pale = True
    tab._receive(Solve(tab.desk.recipe), Failure(1, "the solver died"))
    for say in (lambda: tab.refuse("no such thing"), lambda: tab.forget_refusal()):
        say()
        for said in ("the solver died", "Pale is what was there before", "planarity"):
            assert said in tab.panels.status
    assert "no such thing" not in tab.panels.status


def test_a_pose_that_collides_is_said_to_do_so_with_a_refusal_that_goes_back_to_it_and_after_it(tab):
    tab.show_reach(FreeRange(5.0, 150.0), (-1.0, 1.0))
    tab.pose(180.0)
    answer(tab)
    tab.solidify("plates", 1000.0)
    answer(tab, "plates this thick do not exist")
    assert "this thick" in tab.panels.status
    assert "colliding at this pose" in tab.panels.status
    tab.forget_refusal()
    assert "colliding at this pose" in tab.panels.status

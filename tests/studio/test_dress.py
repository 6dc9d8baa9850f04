"""How a structure is shown: one thing at a time, and what is refused goes back to what is on screen."""

from dataclasses import replace
from types import SimpleNamespace

import pytest

import plisse

pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")

from plisse.studio.dress import Dress, Look
from plisse.studio.requests import Colour, Found, Pose, Solid, Solve
from plisse.studio.view import folded_view

RESULT = plisse.design({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})
RECIPE = RESULT.design
FOUND = Found(RESULT.report, False, folded=folded_view(RESULT.structure))


class Stage:
    """Stands for a scene, a legend and who is asked: what was done, in its order, and the scale that is shown."""

    def __init__(self):
        self.done, self.scale = [], None
        scene = SimpleNamespace(**{name: lambda *_, name=name: self.done.append(name)
                                   for name in ("show", "follow", "pose", "tint", "pale")})
        self.dress = Dress(scene, self.done.append, self.show_scale)

    def show_scale(self, tint):
        self.scale = tint

    def put_on(self):
        """What is done to show what is chosen."""
        self.done.clear()
        self.dress.put_on(FOUND, RECIPE)
        return self.done

    def answer(self, value=None):
        """Take in an answer to what was asked for last."""
        assert self.dress.awaits(self.done[-1])
        self.dress.take_in(self.done[-1], value)


@pytest.fixture
def stage():
    return Stage()


def test_plain_paper_as_it_was_designed_is_there_and_is_not_asked_for(stage):
    assert stage.put_on() == ["show", "follow"]


def test_nothing_is_asked_for_where_there_is_no_structure(stage):
    stage.dress.paint("opening")
    stage.dress.put_on(Found(RESULT.report, False), RECIPE)
    stage.dress.put_on(None, RECIPE)
    assert stage.done == []


@pytest.mark.parametrize("choose", [lambda dress: dress.pose(50.0), lambda dress: dress.solidify("plates", 1.0)])
def test_colours_lie_over_the_structure_as_it_was_designed_whatever_was_on_screen(stage, choose):
    choose(stage.dress)
    stage.put_on()
    stage.answer()
    stage.dress.paint("opening")
    assert stage.put_on() == ["show", "follow", Colour(RECIPE, "opening")]
    stage.answer()
    stage.dress.paint("planarity")
    assert stage.put_on() == [Colour(RECIPE, "planarity")]


def test_what_is_solid_has_no_colours_and_the_other_way_round(stage):
    stage.dress.paint("opening")
    stage.dress.solidify("plates", 1.0)
    assert (stage.dress.chosen.colour, stage.put_on()) == ("", [Solid(RECIPE, "plates", 1.0)])
    stage.dress.paint("opening")
    assert (stage.dress.chosen.solid[0], stage.put_on()) == ("", [Colour(RECIPE, "opening")])
    stage.dress.solidify("", 2.0)
    assert stage.dress.chosen.colour == "opening"


@pytest.mark.parametrize("leave", [lambda dress: dress.solidify("", 2.0), lambda dress: dress.paint("")])
def test_what_is_not_chosen_any_more_goes_without_the_state_of_the_motion(stage, leave):
    stage.dress.pose(60.0)
    leave(stage.dress)
    assert stage.dress.chosen == Look(60.0)


def test_another_thickness_keeps_all_else():
    dress = Stage().dress
    dress.solidify("plates", 1.0)
    dress.pose(60.0)
    dress.thicken(2.0)
    assert dress.chosen == Look(60.0, ("plates", 2.0))


def test_a_state_of_the_motion_is_seen_neither_solid_nor_painted():
    assert Look(60.0, ("offset", 2.0)).visible == Look(60.0, colour="opening").visible == Look(60.0)
    assert Look(solid=("offset", 2.0)).visible == Look(solid=("offset", 2.0))


def test_a_colour_map_comes_again_after_a_design_without_a_structure(stage):
    stage.dress.paint("opening")
    bare, request = Found(RESULT.report, False), Solve(RECIPE, colour="opening")
    stage.dress.put_on_new(bare, request)
    stage.dress.complete(bare, request)
    assert stage.dress.chosen.colour == "opening"
    stage.dress.put_on_new(replace(FOUND, tint="opening"), request)
    assert stage.scale == "opening"


def test_a_state_of_the_motion_is_not_carried_over_but_one_chosen_for_the_new_structure_is_shown(stage):
    for late, percent in ((False, 100.0), (True, 60.0)):
        stage.dress.pose(60.0)
        stage.dress.carry()
        if late:
            stage.dress.pose(60.0)
        stage.dress.put_on_new(FOUND, Solve(RECIPE))
        stage.dress.complete(FOUND, Solve(RECIPE))
        assert stage.dress.chosen.percent == percent
    assert stage.done[-1] == Pose(RECIPE, 60.0)


def test_a_state_of_the_motion_goes_before_colours_which_come_again_at_its_middle(stage):
    stage.dress.paint("opening")
    stage.dress.pose(50.0)
    assert stage.put_on() == [Pose(RECIPE, 50.0)]
    stage.answer()
    stage.dress.pose(100.0)
    assert stage.put_on() == ["show", "follow", Colour(RECIPE, "opening")]


def test_an_answer_to_what_is_not_chosen_any_more_is_not_awaited(stage):
    stage.dress.pose(50.0)
    late = stage.put_on()[-1]
    stage.dress.pose(100.0)
    stage.put_on()
    assert not stage.dress.awaits(late)


@pytest.mark.parametrize("choose", [lambda dress: dress.pose(201.0), lambda dress: dress.solidify("plates", 1000.0),
                                    lambda dress: dress.paint("deviation")])
def test_colours_and_their_scale_stay_where_something_else_is_refused(stage, choose):
    stage.dress.paint("opening")
    stage.put_on()
    stage.answer("the scale")
    choose(stage.dress)
    stage.put_on()
    stage.dress.go_back()
    assert stage.dress.chosen == Look(colour="opening")
    assert stage.scale == "the scale"


def test_where_a_colour_is_refused_after_a_pose_the_structure_is_seen_as_it_was_designed(stage):
    stage.dress.pose(50.0)
    stage.put_on()
    stage.answer()
    stage.dress.paint("deviation")
    stage.put_on()
    stage.dress.go_back()
    assert stage.dress.chosen == Look()
    assert "show" in stage.done


def test_a_colour_that_a_new_structure_does_not_have_is_chosen_no_more(stage):
    stage.dress.paint("deviation")
    stage.dress.put_on_new(FOUND, Solve(RECIPE, colour="deviation"))
    stage.dress.complete(FOUND, Solve(RECIPE, colour="deviation"))
    assert stage.dress.chosen.colour == ""


def test_plates_are_put_on_again_when_the_structure_is_a_new_one(stage):
    stage.dress.solidify("plates", 1.0)
    stage.put_on()
    stage.answer()
    stage.dress.put_on_new(FOUND, Solve(RECIPE))
    stage.dress.complete(FOUND, Solve(RECIPE))
    assert stage.done[-1] == Solid(RECIPE, "plates", 1.0)


def test_a_colour_that_was_chosen_while_another_one_was_on_its_way_is_asked_for(stage):
    painted = replace(FOUND, tint="planarity")
    stage.dress.paint("opening")
    stage.dress.put_on_new(painted, Solve(RECIPE, colour="planarity"))
    stage.dress.complete(painted, Solve(RECIPE, colour="planarity"))
    assert stage.done[-1] == Colour(RECIPE, "opening")


def test_what_is_pale_has_no_scale(stage):
    stage.dress.put_on_new(replace(FOUND, tint="planarity"), Solve(RECIPE, colour="planarity"))
    assert stage.scale == "planarity"
    stage.dress.put_on_new(Found(RESULT.report, False), Solve(RECIPE, colour="planarity"))
    assert stage.scale is None
    assert stage.done[-1] == "pale"

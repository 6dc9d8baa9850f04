"""A session answers what a fresh design answers, whatever happened before."""

import numpy as np
import pytest

import plisse
from plisse.errors import InvalidDesign

RECIPE = {"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 18, 8], [80, 18, 14], [120, 0, 16]]},
          "pattern": {"theta": 40, "creases": 7, "width": 5, "amplitude": 3, "samples": 61}}


def same(one, other):
    return np.array_equal(one.structure.vertices, other.structure.vertices) \
        and np.array_equal(one.structure.development, other.structure.development)


@pytest.fixture(scope="module")
def session():
    return plisse.Session(RECIPE)


@pytest.mark.parametrize("changes", [{"theta": 25}, {"width": 6.5, "amplitude": 2.5}, {"creases": 9, "samples": 50},
                                     {"points": [[0, 0, 0], [40, 20, 8], [80, 16, 16], [120, 0, 18]]},
                                     {"curve": {"kind": "helix", "radius": 100, "pitch": 60, "turns": 0.5},
                                      "theta": 30, "principal": True}])
def test_an_update_gives_what_a_fresh_design_gives(session, changes):
    result = session.update(**changes)
    assert result.status == "exact"
    assert same(result, plisse.design(session.recipe))


def test_going_back_gives_the_first_structure_again():
    session = plisse.Session(RECIPE)
    first = session.result
    session.update(theta=20, creases=5)
    assert same(session.update(theta=40, creases=7), first)


def test_none_brings_a_default_back():
    session = plisse.Session({**RECIPE, "pattern": {**RECIPE["pattern"], "samples": 61}})
    assert session.update({"pattern.spacing": "uniform"}).design.pattern.spacing == "uniform"
    assert session.update(spacing=None).design.pattern.spacing == "mirror"


@pytest.mark.parametrize(("changes", "sentence"), [({"theta": 95}, "theta"), ({"nonsense": 1}, "no key nonsense"),
                                                   ({"creases": "many"}, "creases")])
def test_an_impossible_change_is_one_sentence_and_changes_nothing(session, changes, sentence):
    recipe, result = session.recipe, session.result
    with pytest.raises(InvalidDesign, match=sentence):
        session.update(**changes)
    assert session.recipe is recipe
    assert session.result is result


def test_patterns_are_made_once_for_one_size():
    session = plisse.Session(RECIPE)
    held = dict(session._workspace._held)
    session.update(theta=33)
    assert all(session._workspace._held[key] is value for key, value in held.items())
    assert len(session._workspace._held) == len(held)


@pytest.mark.parametrize("changes", [{"units.x": 1}, {3: 4}, {None: 1}, [1], "theta", {"pattern.thta": None},
                                     {"pattern.theta.x": None}, {"solve.nosuch": 3}, {"curve.nosuch": 1},
                                     {"curve": 5, "curve.radius": 3}, {"curve": [1], "curve.radius": None},
                                     {"theta": 30, "pattern.theta": 40}, {"strips": 3}])
def test_changes_that_mean_nothing_are_refused_and_leave_the_session_as_it_was(changes):
    session = plisse.Session({"curve": {"kind": "arc", "radius": 100, "angle": 60},
                              "pattern": {"creases": 3, "samples": 12, "width": 8, "amplitude": 4}})
    before = session.recipe
    with pytest.raises(InvalidDesign):
        session.update(changes)
    assert session.recipe is before

"""Numbers of single creases and strips: three ways to give them, and as many as there are creases."""

import pytest

from plisse.io.designs import design_from_dict
from plisse.session import changed
from plisse.studio.series import ALONG, EACH, SAME, SERIES, fitted, series_of, with_place_after, without_place

RECIPE = design_from_dict({"curve": {"kind": "arc", "radius": 100, "angle": 70},
                           "pattern": {"theta": 30, "creases": 5, "width": 6, "amplitude": 3}})


@pytest.mark.parametrize("key", SERIES)
def test_every_way_is_a_design_and_leads_back(key):
    kinds = SERIES[key][1]
    for first in kinds:
        recipe = changed(RECIPE, {key: series_of(RECIPE, key).turned(first)})
        for second in kinds:
            again = changed(recipe, {key: series_of(recipe, key).turned(second)})
            assert series_of(again, key).kind == second
            assert changed(again, {key: series_of(again, key).turned(SAME)}) == RECIPE


def test_closed_curves_get_one_width_for_their_two_ends():
    ring = design_from_dict({"curve": {"kind": "ellipse", "a": 90, "b": 60},
                             "pattern": {"creases": 5, "width": 6, "amplitude": 3}})
    assert ring.is_closed
    changed(ring, {"pattern.width": series_of(ring, "pattern.width").turned(ALONG)})


def test_more_or_fewer_creases_keep_their_numbers():
    recipe = changed(RECIPE, {"theta": [10, 20, 30, 40, 50], "width": [5, 6, 7, 8]})
    more = changed(recipe, fitted(recipe, {"pattern.creases": 7}))
    assert more.pattern.theta == [10, 20, 30, 40, 50, 40, 50]
    assert more.pattern.width == [5, 6, 7, 8, 7, 8]
    fewer = changed(recipe, fitted(recipe, {"pattern.creases": 3}))
    assert (fewer.pattern.theta, fewer.pattern.width) == ([10, 20, 30], [5, 6])
    assert fitted(RECIPE, {"pattern.creases": 7}) == {"pattern.creases": 7}


def test_places_along_the_curve_are_added_between_and_taken_away():
    table = [[0.0, 5.0], [0.5, 7.0], [1.0, 5.0]]
    assert with_place_after(table, 0) == [[0.0, 5.0], [0.25, 6.0], [0.5, 7.0], [1.0, 5.0]]
    assert with_place_after(table, 2)[2] == [0.75, 6.0]
    assert without_place(table, 1) == [[0.0, 5.0], [1.0, 5.0]]


def test_designs_without_a_pattern_have_no_series():
    assert series_of(design_from_dict({"closed_form": {"kind": "cones"}}), "pattern.width") is None
    assert series_of(changed(RECIPE, {"width": [5, 6, 7, 8]}), "pattern.width").kind == EACH

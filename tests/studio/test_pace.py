"""While a design is pulled, as many samples are solved as can be followed."""

from dataclasses import replace

import msgspec

import plisse
from plisse.io.designs import design_from_dict
from plisse.studio.pace import FAST, FEWEST, LAST, Pace
from plisse.studio.requests import Found

RECIPE = design_from_dict({"curve": {"kind": "arc", "radius": 100, "angle": 70},
                           "pattern": {"theta": 30, "creases": 10, "width": 3, "amplitude": 1, "samples": 101}})
FOUND = Found(msgspec.structs.replace(plisse.design({"closed_form": {"kind": "cones"}}).report, vertices=1010), False)


def test_everything_is_solved_at_once_until_something_took_long():
    pace = Pace()
    assert not pace.waits(RECIPE)
    pace.learn(FOUND, 2 * FAST)
    assert pace.waits(RECIPE)
    assert pace.draft(RECIPE).pattern.samples == 51


def test_one_slow_answer_among_fast_ones_makes_nothing_coarse():
    pace = Pace()
    for seconds in (3.0, 0.05, 3.0):
        pace.learn(FOUND, seconds)
        assert not pace.is_fast or seconds < 1
    assert pace.draft(RECIPE) is None
    for _ in range(LAST):
        pace.learn(FOUND, 3.0)
    assert pace.draft(RECIPE).pattern.samples == FEWEST


def test_drafts_make_finer_and_never_coarser():
    pace = Pace()
    pace.learn(FOUND, 3.0)
    draft = replace(FOUND, drafted=True, report=msgspec.structs.replace(FOUND.report, vertices=250))
    pace.learn(draft, 0.25 * FAST)
    assert pace.draft(RECIPE) is None
    pace.learn(FOUND, 2 * FAST)
    for _ in range(LAST):
        pace.learn(draft, 5 * FAST)
    assert pace.draft(RECIPE).pattern.samples == 51

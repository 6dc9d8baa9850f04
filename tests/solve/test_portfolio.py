"""Several ways: the first comfortable one ends the search, later ones are followed only as far as they promise more."""

from dataclasses import replace

import numpy as np
import pytest
from msgspec.structs import replace as with_fields

from plisse.io.designs import read_design
from plisse.layout.guiding import guiding
from plisse.measure.regularity import Regularity
from plisse.measure.verdict import FAR, Verdict
from plisse.shipped import shipped_design
from plisse.solve.attempt import Attempt, Start
from plisse.solve.coarse_to_fine import CoarseToFine
from plisse.solve.portfolio import FEW, OPTIMISED, solve

NEARER = CoarseToFine("from twelve columns", columns=12)
WIDE = Regularity(np.radians(60), np.radians(60), np.radians(90), 0)


@pytest.fixture(scope="module")
def many():
    """113 narrow strips on a helix: exact creases end up farther from their guides than an amplitude."""
    design = read_design(str(shipped_design("fig15b")))
    scale = (design.pattern.creases - 1) / 112
    pattern = with_fields(design.pattern, theta=20.0, creases=113, samples=30, width=design.pattern.width * scale,
                          amplitude=design.pattern.amplitude * scale)
    guide = guiding(design.curve, pattern)
    return Start(guide.pattern, guide.amplitude, guide.samples)


def test_relaxation_on_fewer_columns_stays_nearer_to_the_guides(many):
    few, more = (solve([(many, (way,))]).best.verdict for way in (NEARER, OPTIMISED))
    assert few.is_good and more.is_good
    assert few.deviation < more.deviation


def test_a_way_that_promises_nothing_better_is_not_followed(many):
    outcome = solve([(many, (NEARER, OPTIMISED))])
    assert outcome.best.attempt.method == NEARER.name
    assert not outcome.best.is_comfortable
    assert outcome.tried[1].attempt.vertices is None
    assert outcome.tried[1].attempt.message == f"nothing better is to be seen with {FEW} columns"


def test_a_way_that_promises_more_is_followed(many):
    def shifted(start):
        found = NEARER(start)
        return Attempt("shifted", found.vertices + start.amplitude)

    outcome = solve([(many, (shifted, OPTIMISED))])
    assert outcome.best.attempt.method == OPTIMISED.name
    assert outcome.best.verdict.deviation < outcome.tried[0].verdict.deviation


def test_other_starts_are_not_even_made_when_something_good_was_found(many):
    def plans():
        yield many, (NEARER,)
        pytest.fail("another start was asked for")

    assert solve(plans()).best.verdict.is_good


def test_what_is_nearly_exact_promises_more_where_it_is_nearer_or_regular():
    far = Verdict(0.0, 0.0, 0.0, WIDE, 2.0)
    nearly = Verdict(1e-5, 1e-5, 0.0, WIDE, 1.9)
    assert nearly.promises_more_than(far)
    assert not replace(nearly, deviation=2.1).promises_more_than(far)
    assert not replace(nearly, planarity=1e-2).promises_more_than(far)
    assert not replace(nearly, regularity=replace(WIDE, inverted=1)).promises_more_than(far)
    assert replace(nearly, deviation=FAR - 0.1).promises_more_than(replace(far, deviation=FAR + 0.1))

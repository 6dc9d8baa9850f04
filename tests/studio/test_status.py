"""What the screen says is what the report says, and what was refused does not hide it."""

import re

import msgspec

import plisse
from plisse.studio.motion_panel import marks_of
from plisse.studio.requests import Found
from plisse.studio.status import broken, refused, solved, working
from plisse.transform.collisions import FreeRange

RESULT = plisse.design({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})
FOUND = Found(RESULT.report, False)


def words(status):
    return re.sub(r"<[^>]*>", " ", status.html)


def test_the_sentences_are_those_of_the_report():
    report = msgspec.structs.replace(RESULT.report, status="infeasible", reasons=["crease 1 <collapses>"],
                                     warnings=["narrow"])
    said = solved(Found(report, False), "cones")
    assert "infeasible" in words(said)
    assert "crease 1 &lt;collapses&gt;" in said.html
    assert "narrow" in said.html


def test_drafts_are_never_exact():
    assert "exact" in words(solved(FOUND, "cones"))
    assert "exact" not in words(solved(Found(RESULT.report, True), "cones"))
    assert "exact" not in words(working("relax", 0.5, FOUND))


def test_what_was_refused_stands_above_the_numbers_of_what_is_still_there():
    said = refused("no <such> thing", FOUND, "cones")
    assert words(said).index("no &lt;such&gt; thing") < words(said).index("planarity")
    assert "exact" in words(said)
    assert "not done" in said.brief
    assert "not done" in words(refused("nothing yet", None, "cones"))


def test_a_design_that_broke_is_not_called_exact():
    assert "exact" not in words(broken("the solver died", FOUND))
    assert "opacity" in broken("the solver died", FOUND).html


def test_marks_of_the_motion_do_not_touch():
    assert marks_of(FreeRange(0.0, 200.0, ())) == [(0.0, "flat"), (100.0, "as designed"), (200.0, "folded")]
    marks = marks_of(FreeRange(5.0, 175.0, ()))
    assert [place for place, _ in marks] == [5.0, 100.0, 175.0]

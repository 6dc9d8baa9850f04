"""What the screen says is what the report says, and what was refused does not hide it."""

import re

import msgspec
import numpy as np

import plisse
from plisse.io.designs import design_from_dict
from plisse.studio.look_panel import legend_html, scale_html
from plisse.studio.motion_panel import marks_of, why_fixed
from plisse.studio.requests import Found
from plisse.studio.standing import Standing
from plisse.studio.status import broken, remark, searching, size_text, solved, working
from plisse.studio.view import Tint, folded_view
from plisse.studio.words import spoken
from plisse.transform.collisions import FreeRange

RESULT = plisse.design({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})
FOUND = Found(RESULT.report, False)


def words(status):
    return re.sub(r"<[^>]*>", " ", status.html)


def refused(sentence, **state):
    """What stands in the status when something was refused in a state of the design."""
    return Standing(**state, refusal=sentence).status(False, 100.0, None)


def test_the_sentences_are_those_of_the_report():
    report = msgspec.structs.replace(RESULT.report, status="infeasible", reasons=["crease 1 <collapses>"],
                                     warnings=["narrow"])
    said = solved(Found(report, False), "cones")
    assert "infeasible" in words(said)
    assert "crease 1 &lt;collapses&gt;" in said.html
    assert "narrow" in said.html


def test_sentences_call_keys_as_their_controls_are_called():
    assert spoken("pattern.width is 3; lower pattern.theta, or set solve.principal = false") == (
        "“width” is 3; lower “inclination θ”, or set “folds flat (principal)” = false")
    assert spoken("curve.points[0] and curve.points[1] are the same") == "control point 1 and control point 2 are the same"
    assert spoken("solve.weights are all 0") == "solve.weights are all 0"
    assert "“amplitude” is 9" in words(refused("pattern.amplitude is 9", found=FOUND))


def test_sizes_have_three_digits_and_a_unit_that_fits():
    assert size_text(252_469.4, 224_962.2) == "252 × 225 m"
    assert size_text(12_345.0, 800.0) == "12.3 × 0.8 m"
    assert size_text(1234.4, 51.14) == "1234 × 51.1 mm"
    assert size_text(0.01234, 5.0) == "0.0123 × 5 mm"


def test_drafts_are_never_exact():
    assert "exact" in words(solved(FOUND, "cones"))
    assert "exact" not in words(solved(Found(RESULT.report, True), "cones"))
    assert "exact" not in words(working("relax", 0.5, FOUND))


def test_what_was_refused_stands_above_the_numbers_of_what_is_still_there():
    said = refused("no <such> thing", found=FOUND, title="cones")
    assert words(said).index("no &lt;such&gt; thing") < words(said).index("planarity")
    assert "exact" in words(said)
    assert "not done" in said.brief
    assert "not done" in words(refused("nothing yet"))


def test_a_refusal_hides_neither_why_a_design_broke_nor_that_it_is_being_solved():
    for state, held in (({"breakdown": "the solver died"}, "the solver died"), ({"found": FOUND, "title": "cones"}, "cones"),
                        ({"found": FOUND, "stage": ("relax", 0.5)}, "working"), ({"search": ("refine", 0.89)}, "89 %")):
        said = words(refused("no such thing", **state))
        assert said.index("no such thing") < said.index(held)
    assert "exact" not in words(refused("no such thing", found=FOUND, stage=("relax", 0.5)))


def test_a_design_after_one_that_broke_is_said_to_be_solved_and_not_to_be_broken():
    said = words(Standing(breakdown="the solver died", stage=("relax", 0.5)).status(False, 100.0, None))
    assert "working" in said
    assert "died" not in said


def test_what_is_pale_and_a_pose_that_collides_are_said_together_with_what_is_refused():
    standing = Standing(breakdown="the solver died", seen=FOUND, refusal="no such thing")
    assert "Pale is what was there before" in words(standing.status(True, 100.0, None))
    assert "planarity" in words(standing.status(True, 100.0, None))
    standing = Standing(FOUND, "cones", refusal="no such thing")
    assert "colliding at this pose" in words(standing.status(False, 180.0, FreeRange(5.0, 175.0)))


def test_a_search_for_layouts_leaves_the_state_of_the_design_below_it():
    assert "searching for layouts: refine (89 %)" in searching("refine", 0.89)
    said = words(Standing(FOUND, "cones", search=("refine", 0.89)).status(False, 100.0, None))
    assert said.index("89 %") < said.index("exact")


def test_a_design_that_broke_is_not_called_exact():
    assert "exact" not in words(broken("the solver died", FOUND))
    assert "opacity" in broken("the solver died", FOUND).html


def test_marks_of_the_motion_do_not_touch():
    assert marks_of(FreeRange(0.0, 200.0, ())) == [(0.0, "flat"), (100.0, "as designed"), (200.0, "folded")]
    marks = marks_of(FreeRange(5.0, 175.0, ()))
    assert [place for place, _ in marks] == [5.0, 100.0, 175.0]


def test_a_pose_that_collides_is_said_above_the_status():
    free = FreeRange(5.0, 175.0)
    said = solved(FOUND, "cones", remark(False, 180.0, free))
    assert words(said).index("colliding at this pose") < words(said).index("exact")
    assert remark(False, 175.0, free) == remark(False, 180.0, None) == ""
    assert "Pale" in remark(True, 100.0, None)


def test_why_nothing_moves_is_the_true_reason():
    recipe = design_from_dict({"curve": {"kind": "arc", "radius": 60, "angle": 60}, "solve": {"principal": True},
                               "pattern": {"theta": 25, "creases": 4, "width": 5, "amplitude": 3, "samples": 15}})
    assert "no structure" in why_fixed(None, recipe)
    assert "no structure" in why_fixed(Found(msgspec.structs.replace(RESULT.report, principal=True), False), recipe)
    view = folded_view(RESULT.structure)
    loose = Found(msgspec.structs.replace(RESULT.report, principal=False), False, folded=view)
    assert "switch “folds flat” on" in why_fixed(loose, RESULT.design)
    assert "switch “folds flat” on" not in why_fixed(loose, recipe)
    assert why_fixed(Found(msgspec.structs.replace(RESULT.report, principal=True), False, folded=view), recipe) == ""


def test_the_legend_names_both_folds_and_the_scale_of_the_sheet():
    assert "mountain" in legend_html(0.0)
    assert "valley" in legend_html(0.0)
    assert "1 : 2" in legend_html(0.5)


def test_ticks_of_the_colour_bar_do_not_wrap_and_stay_within_its_ends():
    tint = Tint(np.zeros((0, 3)), np.zeros((0, 3), int), np.zeros(0), "planarity",
                [(0.0, "0"), (0.5, "1e-12"), (1.0, "1e-9")], np.zeros((2, 3), int))
    styles = re.findall(r"nowrap;transform:translateX\(-(\d+)%\);left:([\d.]+)%", scale_html(tint))
    assert styles == [("0", "0.0"), ("50", "50.0"), ("100", "100.0")]

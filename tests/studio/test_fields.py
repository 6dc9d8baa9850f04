"""Controls come from the types of a recipe and lead back to it."""

import pytest

from plisse.errors import InvalidDesign
from plisse.io.designs import design_from_dict, read_design
from plisse.session import changed
from plisse.shipped import shipped_design, shipped_names
from plisse.studio.downloads import KINDS, file_name
from plisse.studio.fields import fields_of, value_of_text
from plisse.studio.gallery_panel import thumbnail_html
from plisse.studio.handles import control_points_of, snapped, with_point_after, without_point
from plisse.studio.pace import Pace
from plisse.studio.requests import Found

SPLINE = design_from_dict({"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 18, 8], [80, 18, 14], [120, 0, 16]]},
                           "pattern": {"creases": 7, "width": 5, "amplitude": 3}})


@pytest.mark.parametrize("name", shipped_names())
def test_every_control_holds_the_value_of_the_design_and_gives_it_back(name):
    recipe = read_design(shipped_design(name))
    fields = fields_of(recipe)
    assert fields
    for field in fields:
        value = value_of_text(field.value) if field.kind == "list" else field.value
        assert changed(recipe, {field.key: value}) == recipe, field
        if field.kind in ("slider", "whole"):
            assert field.low <= field.value <= field.high


@pytest.mark.parametrize("name", ["fig01d", "fig05", "march-shell"])
def test_both_ends_of_every_slider_are_allowed(name):
    recipe = read_design(shipped_design(name))
    for field in fields_of(recipe):
        if field.kind == "slider":
            changed(recipe, {field.key: field.low})
            changed(recipe, {field.key: field.high})


@pytest.mark.parametrize("name", shipped_names())
def test_every_control_has_words_of_its_own_and_says_what_it_does(name):
    for field in fields_of(read_design(shipped_design(name))):
        assert field.words.hint, field.key
        assert "_" not in field.label


@pytest.mark.parametrize("name", ["fig12", "fig18", "fig06"])
def test_choices_are_called_by_words_and_mean_what_the_design_says(name):
    for field in fields_of(read_design(shipped_design(name))):
        if field.kind == "choice":
            assert field.shown in field.shown_choices
            assert [field.meant(words) for words in field.shown_choices] == list(field.choices)


def test_units_are_those_of_the_design_and_of_the_types():
    labels = {field.key: field.label for field in fields_of(changed(SPLINE, {"units": "m"}))}
    assert labels["pattern.width"] == "width (m)"
    assert labels["pattern.theta"] == "inclination θ (°)"
    assert labels["pattern.creases"] == "creases"


@pytest.mark.parametrize("text", ["true", '"30"', "30]\nx = 1", "", "[1, 2", "{a = 1}", "1979-05-27", "import os"])
def test_a_text_field_takes_numbers_and_lists_only(text):
    with pytest.raises(InvalidDesign):
        value_of_text(text)


def test_control_points_can_be_added_removed_and_snapped():
    points = control_points_of(SPLINE)
    assert with_point_after(points, 0, False)[1].tolist() == [20, 9, 4]
    assert with_point_after(points, 3, False)[4].tolist() == [160, -18, 18]
    assert with_point_after(points, 3, True)[4].tolist() == [60, 0, 8]
    assert len(without_point(points, 2)) == 3
    assert snapped(points, "xy")[:, 2].tolist() == [9.5] * 4
    assert snapped(points, "xy")[:, :2].tolist() == points[:, :2].tolist()
    assert control_points_of(read_design(shipped_design("fig01d"))) is None


def test_what_takes_long_is_drafted_with_fewer_samples():
    pace, report = Pace(), type("Report", (), {"vertices": 1000})()
    assert pace.draft(SPLINE) is None
    pace.learn(Found(report, False), 1.0)
    draft = pace.draft(SPLINE)
    assert 25 <= draft.pattern.samples < SPLINE.pattern.samples
    assert changed(draft, {"samples": SPLINE.pattern.samples}) == SPLINE
    assert pace.waits(SPLINE)
    pace.learn(Found(report, False), 0.001)
    assert pace.draft(SPLINE) is None
    assert not pace.waits(SPLINE)


def test_every_shipped_design_has_its_picture():
    """`python docs/thumbnails.py` draws those that are missing."""
    assert [name for name in shipped_names() if "<img" not in thumbnail_html(name)] == []


@pytest.mark.parametrize("title", ["../../etc/passwd", "Fig. 1d: a <b>", "", "ü" * 90, "con.\\x"])
def test_file_names_are_harmless(title):
    for kind in KINDS:
        name = file_name(title, kind)
        assert name.replace("-", "").replace(".", "").isalnum()
        assert name.isascii()
        assert not name.startswith((".", "-"))

"""Pleats over surfaces in a real browser: upload, search, click, choose."""

import numpy as np
import pytest
from recipes import SADDLE
from visitor import Visitor, until

pytestmark = pytest.mark.browser
ROOF = "\n".join([*(f"v {x} {y} {0.02 * x * x - 0.01 * y * y}" for x in range(-20, 21, 4) for y in range(-20, 21, 4)),
                  *(f"f {11 * i + j + 1} {11 * i + j + 12} {11 * i + j + 13} {11 * i + j + 2}"
                    for i in range(10) for j in range(10))])


def test_a_good_mesh_is_pleated_and_a_bad_one_refused(visitor, tmp_path):
    good, bad = tmp_path / "roof.obj", tmp_path / "bad.obj"
    good.write_text(ROOF)
    bad.write_text("this is no mesh\n" * 50)
    tab, before = visitor.tab_behind, visitor.tab_behind.desk.toml
    visitor.tab("Surface")
    visitor.upload(bad)
    visitor.wait_for("not done")
    assert tab.desk.toml == before
    assert "exact" in visitor.status
    visitor.upload(good)
    visitor.wait_for("coverage")
    assert 'file = "roof.obj"' in tab.desk.toml
    assert tab.found.report.coverage > 0.8
    visitor.tab("Look")
    visitor.choose("colours", "deviation")
    visitor.wait_for("amplitudes")
    until(lambda: visitor.node("/colours") is not None)
    visitor.picture("studio-surface.png")


def test_layouts_are_searched_for_seen_and_chosen_and_a_click_sets_their_centre_or_a_guide(browser, start):
    visitor = Visitor(browser, start(SADDLE, "a saddle"))
    tab = visitor.tab_behind
    visitor.tab("Surface")
    visitor.button("Search for layouts")
    chosen = visitor.page.get_by_role("button", name="% covered").last
    chosen.click(timeout=60_000)
    visitor.page.get_by_role("img", name="layout 1, seen from above").wait_for()
    until(lambda: tab.desk.recipe.pattern.amplitude is not None)
    visitor.wait_for("exact")
    visitor.rest()
    before = tab.desk.recipe.surface.centre
    visitor.choose("a click on the surface", "sets the centre")
    visitor.rest()
    visitor.page.mouse.click(*visitor.place_of([20, 10, 0]))
    until(lambda: tab.desk.recipe.surface.centre != before)
    x, y, z = tab.desk.recipe.surface.centre
    assert abs(z - (0.0008 * x * x - 0.0006 * y * y)) < 0.5  # clicks hit the triangles, not the formula
    assert np.hypot(x - 20, y - 10) < 3  # the place aimed at lies a little above the surface
    visitor.wait_for("exact")
    visitor.choose("a click on the surface", "adds a guide point")
    visitor.rest()
    for place in ([-40, 0, 1.3], [0, 5, 0], [40, 0, 1.3]):
        visitor.page.mouse.click(*visitor.place_of(place))
        visitor.rest()
    until(lambda: tab.desk.recipe.surface.guide is not None and len(tab.desk.recipe.surface.guide) == 3)
    assert tab.desk.recipe.surface.centre is None
    until(lambda: tab.found is not None and tab.found.report.design["surface"].get("guide") == tab.desk.recipe.surface.guide)
    visitor.leave()


def test_what_is_sent_and_refused_is_not_called_a_success(visitor, tmp_path):
    bad = tmp_path / "bad.obj"
    bad.write_text("this is no mesh\n" * 50)
    visitor.tab("Surface")
    visitor.upload(bad)
    visitor.wait_for("not done")
    assert "successfully" not in visitor.page.evaluate("document.body.innerText")


def test_no_more_layouts_are_shown_than_were_asked_for(browser, start):
    visitor = Visitor(browser, start(SADDLE, "a saddle"))
    visitor.tab("Surface")
    visitor.slide("layouts at most", "Home", "ArrowRight")
    visitor.button("Search for layouts")
    found = visitor.page.get_by_role("button", name="% covered")
    found.first.wait_for(timeout=60_000)
    visitor.page.get_by_role("img", name=", seen from above").first.wait_for()
    assert 1 <= found.count() <= 2
    visitor.leave()

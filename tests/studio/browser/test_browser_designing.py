"""Designing in a real browser: pick, pull, type, take back."""

import json
import time
import tomllib

import numpy as np
import pytest
from fold_check import defects
from recipes import COIL
from visitor import record, until

from plisse.io.designs import design_from_dict

pytestmark = pytest.mark.browser
THETA = "inclination θ (°)"


def test_a_design_is_changed_taken_away_and_taken_back_to_the_very_same_files(visitor):
    tab, first = visitor.tab_behind, visitor.text
    name, file = visitor.download("FOLD")
    visitor.tab("Design")
    visitor.slide(THETA, *["ArrowLeft"] * 5)
    until(lambda: tab.found.report.design["pattern"]["theta"] == visitor.number(THETA) < 40)
    visitor.wait_for("exact")
    visitor.slide("creases", "ArrowRight")
    until(lambda: tab.found.report.vertices == 8 * 61)
    changed = visitor.text
    assert design_from_dict(tomllib.loads(changed)) == tab.desk.recipe
    other = visitor.download("FOLD")
    for defect in defects(json.loads(other[1])):
        assert defect < 1e-9
    assert (name, other[0]) == ("a-wave.fold", "a-wave.fold")
    while tab.desk.can_undo:
        before = tab.desk.step
        visitor.button("undo")
        until(lambda before=before: tab.desk.step is not before)
    assert visitor.text == first
    assert visitor.download("FOLD")[1] == file != other[1]
    visitor.page.locator("canvas").first.focus()
    for _ in range(5):
        visitor.page.keyboard.press("Control+Shift+Z")
    until(lambda: not tab.desk.can_redo)
    assert visitor.text == changed


def test_sixty_changes_in_a_second_leave_the_last_one_on_screen(visitor):
    tab = visitor.tab_behind
    visitor.slide(THETA)
    visitor.page.evaluate("""async () => {
        const slider = document.activeElement;
        for (let k = 0; k < 60; k++) {
            const key = k % 4 == 3 ? "ArrowRight" : "ArrowLeft";
            slider.dispatchEvent(new KeyboardEvent("keydown", { key, code: key, bubbles: true }));
            await new Promise(done => setTimeout(done, 1000 / 60));
        }
    }""")
    last = visitor.number(THETA)
    assert last < 35
    until(lambda: tab.found.report.design["pattern"]["theta"] == last and not tab.found.drafted)
    visitor.wait_for("exact")
    assert tomllib.loads(visitor.text)["pattern"]["theta"] == last


def test_a_control_point_is_pulled(visitor):
    tab, frames, mouse = visitor.tab_behind, [], visitor.page.mouse
    before = tab.desk.recipe.curve.points
    visitor.page.get_by_role("slider", name="point", exact=True).focus()
    visitor.page.keyboard.press("ArrowRight")
    arrows = tab.handles.arrows
    until(lambda: arrows.position[0] == before[1][0])
    visitor.rest()
    tip = arrows.position + np.array([0, 0, 0.6 * arrows.scale])
    visitor.frame(frames)
    mouse.move(*visitor.place_of(tip))
    time.sleep(0.5)
    mouse.down()
    for step in range(1, 11):
        mouse.move(*visitor.place_of(tip + np.array([0, 0, 0.5 * step])))
        visitor.frame(frames)
    mouse.up()
    until(lambda: tab.desk.recipe.curve.points[1][2] > before[1][2] + 3)
    until(lambda: not tab.handles.is_pulled)
    after = tab.desk.recipe.curve.points
    assert [after[0], *after[2:]] == [before[0], *before[2:]]
    assert after[1][:2] == pytest.approx(before[1][:2], abs=0.01)
    until(lambda: tab.found.report.design["curve"]["points"] == after and not tab.found.drafted)
    visitor.wait_for("exact")
    visitor.frame(frames)
    record(frames, "studio.gif")


def test_control_points_are_added_snapped_closed_and_taken_away_with_the_keyboard(visitor):
    page, tab = visitor.page, visitor.tab_behind

    def points():
        return tab.desk.recipe.curve.points

    before = points()
    page.get_by_role("button", name="add", exact=True).press("Enter")
    until(lambda: len(points()) == 5)
    assert points()[1] == [20, 9, 4]
    page.get_by_role("button", name="remove", exact=True).press("Enter")
    until(lambda: len(points()) == 4)
    assert before[0] not in points()
    visitor.choose("points lie", "in a plane xy")
    until(lambda: len({z for _, _, z in points()}) == 1)
    page.get_by_role("checkbox", name="closed curve", exact=True).press("Space")
    until(lambda: tab.desk.recipe.curve.closed)
    until(lambda: tab.found.report.design["curve"]["closed"])


def test_inclinations_and_widths_are_set_one_by_one_and_along_the_curve(visitor):
    tab = visitor.tab_behind

    def pattern():
        return tab.desk.recipe.pattern

    visitor.fold_out("Width of single strips")
    visitor.choose("width is", "one by one")
    visitor.slide("width, strip 2 (mm)", "ArrowRight")
    until(lambda: pattern().width[1] > 5 and pattern().width[2:] == [5] * 4)
    visitor.slide("creases", "ArrowRight")
    until(lambda: pattern().creases == 8 and len(pattern().width) == 7)
    visitor.choose("width is", "along the curve")
    visitor.write("all places", "[[0, 5], [0.5, 7], [1, 5]]")
    until(lambda: pattern().width == [[0, 5], [0.5, 7], [1, 5]])
    visitor.fold_out("Inclination θ of single creases")
    visitor.choose("inclination θ is", "one by one")
    visitor.slide("inclination θ, crease 8 (°)", "ArrowLeft")
    until(lambda: pattern().theta[:7] == [40] * 7 and pattern().theta[7] < 40)
    until(lambda: tab.found.report.design["pattern"]["theta"] == pattern().theta and not tab.found.drafted)
    visitor.wait_for("exact")


def test_a_text_that_cannot_be_read_stays_to_be_mended(visitor):
    tab, before = visitor.tab_behind, visitor.text
    box = visitor.page.get_by_label("design (TOML)")
    broken = before.replace("creases = 7", "creases = ")
    box.fill(broken)
    visitor.button("Read the text above")
    visitor.wait_for("mend that line")
    assert box.input_value() == broken
    box.fill(broken.replace("creases = ", "creases = 8"))
    visitor.button("Read the text above")
    until(lambda: tab.desk.recipe.pattern.creases == 8)
    assert visitor.text == tab.desk.toml


def test_a_busy_browser_may_read_of_a_control_and_of_its_end_in_one_frame(visitor):
    tab = visitor.tab_behind
    visitor.fold_out("Width of single strips")
    visitor.choose("width is", "one by one")
    visitor.page.get_by_role("slider", name="width, strip 6 (mm)", exact=True).wait_for()
    visitor.page.evaluate("setTimeout(() => { const end = Date.now() + 2000; while (Date.now() < end); }, 0)")
    for changes in ({"pattern.width": [5, 6, 5, 5, 5, 5]}, {"pattern.creases": 5, "pattern.width": [5, 6, 5, 5]}):
        tab._loop.call_soon_threadsafe(tab.change, changes)
        time.sleep(0.5)
    visitor.page.get_by_role("slider", name="width, strip 6 (mm)", exact=True).wait_for(state="hidden")
    assert visitor.number("width, strip 2 (mm)") == 6


def test_a_design_of_the_gallery_is_picked_by_its_picture_and_painted(visitor):
    tab = visitor.tab_behind
    visitor.button("Gallery …")
    visitor.page.get_by_role("img", name="fig16").wait_for()
    visitor.button("Open fig16")
    visitor.wait_for("exact fig16")
    assert tab.found.report.design == tab.desk.recipe.to_dict()
    visitor.rest()
    visitor.picture("studio.png")
    visitor.tab("Look")
    visitor.choose("colours", "opening")
    visitor.wait_for("opening angle of creases")


def test_the_gallery_stands_side_by_side_and_closes_by_escape_and_by_a_click_beside_it(visitor):
    page = visitor.page
    for leave in (lambda: page.keyboard.press("Escape"), lambda: page.mouse.click(20, 450)):
        visitor.button("Gallery …")
        page.get_by_role("img", name="fig16").wait_for()
        places = [box.bounding_box() for box in page.get_by_role("button", name="Open fig").all()]
        assert len({round(place["x"]) for place in places}) >= 2
        leave()
        until(lambda: page.get_by_role("dialog").count() == 0)


def test_a_text_of_another_length_is_read_by_one_click(visitor):
    """With the mouse, which is down on the button before the box is left."""
    visitor.tab("Take away")
    box, before = visitor.page.get_by_label("design (TOML)"), ""
    for text in ("a = [", "creases = 1\n" * 80):
        box.click()
        box.fill(text)
        button = visitor.page.get_by_role("button", name="Read the text above", exact=True)
        button.scroll_into_view_if_needed()
        place = button.bounding_box()
        visitor.page.mouse.move(place["x"] + place["width"] / 2, place["y"] + 3)
        visitor.page.mouse.down()
        visitor.page.mouse.up()
        alert = visitor.page.locator("[role=status] [role=alert]")
        until(lambda before=before, alert=alert: alert.count() == 1 and alert.inner_text() != before)
        before = alert.inner_text()


def test_what_is_refused_or_infeasible_is_said_with_its_place_and_can_be_taken_back(visitor):
    """A steep helix cuts through itself; pleats wider than the radius of their curve break down."""
    tab, before = visitor.tab_behind, visitor.text
    box = visitor.page.get_by_label("design (TOML)")
    box.fill(before.replace("creases = 7", "creases = 2"))
    visitor.button("Read the text above")
    visitor.wait_for("“creases” is 2; give a whole number from 3 to 1000")
    assert tab.desk.toml == before
    assert "exact" in visitor.status
    visitor.wait_for("smallest sector")
    visitor.read(COIL)
    visitor.wait_for("the folded shape cuts through itself")
    until(lambda: "infeasible" in visitor.status)
    assert visitor.node("/trouble").position == pytest.approx(tab.found.trouble)
    visitor.read({**COIL, "pattern": {**COIL["pattern"], "theta": 0}})
    visitor.wait_for("run into their centre of curvature")
    assert "infeasible" in visitor.status
    for _ in range(2):
        visitor.button("undo")
    visitor.wait_for("exact")
    assert visitor.text == before


def test_what_is_typed_counts_when_it_is_complete_and_what_is_refused_goes_back(visitor):
    tab, page = visitor.tab_behind, visitor.page
    alert = page.locator("[role=status] [role=alert]")

    def typed(name, text, key="Enter"):
        box = page.get_by_label(name, exact=True)
        box.press("Control+a")
        page.keyboard.type(text, delay=30)
        page.keyboard.press(key)
        return box

    def stands(box, text):
        until(lambda: box.input_value() == text)

    box = typed(f"{THETA}, as a number", "95")
    visitor.wait_for("“inclination θ” is 95")
    stands(box, "40")
    assert tab.desk.recipe.pattern.theta == 40
    typed(f"{THETA}, as a number", "33.25", "Tab")
    until(lambda: tab.desk.recipe.pattern.theta == 33.25)
    until(lambda: alert.count() == 0)
    note = page.locator("#plisse-note")
    for text in ("abc", "1e400", "1.000,5"):
        stands(typed(f"{THETA}, as a number", text, "Tab"), "33.25")
        assert f"“{text}” is no number" in note.inner_text()
    typed(f"{THETA}, as a number", "33.123456789", "Tab")
    until(lambda: tab.desk.recipe.pattern.theta == 33.123457)
    assert note.count() == 0
    stands(typed(f"{THETA}, as a number", "33.25", "Tab"), "33.25")
    stands(typed(f"{THETA}, as a number", "12", "Escape"), "33.25")
    typed(f"{THETA}, as a number", "3", "4")  # and then nothing for a while
    until(lambda: tab.desk.recipe.pattern.theta == 34)
    typed("width (mm), as a number", "25,5", "Tab")  # beyond the slider, and as many people write it
    until(lambda: tab.desk.recipe.pattern.width == 25.5)
    visitor.button("undo")
    until(lambda: tab.desk.recipe.pattern.width == 5)
    slider = page.get_by_role("slider", name="width (mm)", exact=True)
    until(lambda: float(slider.get_attribute("aria-valuemax")) == 20)  # as it was before
    visitor.fold_out("Width of single strips")
    visitor.choose("width is", "one by one")
    box = typed("all strips", "[5, 6")
    visitor.wait_for("is neither a number nor a list")
    stands(box, "[5, 5, 5, 5, 5, 5]")
    typed("all strips", "[5, 6, 5, 6, 5, 6]")
    until(lambda: tab.desk.recipe.pattern.width == [5, 6, 5, 6, 5, 6])
    until(lambda: alert.count() == 0)


def test_steps_back_and_forth_are_taken_from_inputs_in_which_one_does_not_type(visitor):
    tab, page = visitor.tab_behind, visitor.page
    visitor.slide("creases", "ArrowRight")
    until(lambda: tab.desk.recipe.pattern.creases == 8)
    for control in (page.get_by_label("points lie", exact=True),
                    page.get_by_role("checkbox", name="closed curve", exact=True)):
        control.focus()
        page.keyboard.press("Control+z")
        until(lambda: tab.desk.recipe.pattern.creases == 7)
        page.keyboard.press("Control+Shift+Z")
        until(lambda: tab.desk.recipe.pattern.creases == 8)
    page.get_by_label(f"{THETA}, as a number", exact=True).focus()
    page.keyboard.press("Control+z")
    page.get_by_label("points lie", exact=True).focus()
    page.keyboard.press("Control+z")
    until(lambda: not tab.desk.can_undo)
    assert tab.desk.can_redo
    assert tab.desk.recipe.pattern.creases == 7


def test_undo_and_redo_are_grey_where_they_do_nothing(visitor):
    page = visitor.page
    undo, redo = (page.get_by_role("button", name=name, exact=True) for name in ("undo", "redo"))
    assert undo.is_disabled()
    assert redo.is_disabled()
    visitor.slide("creases", "ArrowRight")
    until(undo.is_enabled)
    undo.click()
    until(redo.is_enabled)
    until(undo.is_disabled)


def test_what_is_for_those_who_program_with_viser_is_hidden(visitor):
    visitor.wait_for("plisse studio")
    for icon in ("adjustments", "list-search"):
        button = visitor.page.locator(f"button:has(.tabler-icon-{icon})")
        assert button.count() == 1
        assert not button.is_visible()


def test_what_was_refused_before_a_note_at_a_box_is_not_said_again(visitor):
    page, alert = visitor.page, visitor.page.locator("[role=status] [role=alert]")
    box, note = page.get_by_label(f"{THETA}, as a number", exact=True), page.locator("#plisse-note")

    def typed(text):
        box.press("Control+a")
        page.keyboard.type(text)
        page.keyboard.press("Tab")

    for _ in range(2):
        typed("95")
        visitor.wait_for("“inclination θ” is 95")
        typed("abc")
        note.wait_for()
        until(lambda: alert.count() == 0)
        page.keyboard.press("Shift")
        until(lambda: note.count() == 0)
        assert alert.count() == 0
    assert "exact" in visitor.status


def test_numbers_are_taken_as_they_are_typed_in_boxes_without_a_slider_too(visitor):
    tab = visitor.tab_behind
    visitor.write("coordinates (mm)", "1.23456")
    until(lambda: tab.desk.recipe.curve.points[0][0] == 1.23456)
    visitor.fold_out("Width of single strips")
    visitor.choose("width is", "along the curve")
    visitor.write("position (%), width (mm), 2", "5.12345")
    until(lambda: tab.desk.recipe.pattern.width[0] == [0, 5.12345])
    visitor.choose("width is", "one by one")
    visitor.write("width, strip 2 (mm), as a number", "5.12345")
    until(lambda: tab.desk.recipe.pattern.width[1] == 5.12345)
    visitor.tab("Look")
    visitor.choose("as", "offset")
    visitor.write("thickness or distance", "0.12345")
    until(lambda: tab.dress.chosen.solid == ("offset", 0.12345))
    visitor.tab("Take away")
    visitor.write("material of pieces (mm)", "512.345")
    until(lambda: tab.panels._take._material.value[0] == 512.345)

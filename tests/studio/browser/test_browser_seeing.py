"""Looking at a structure in a real browser: motion, colours, plates, camera."""

import numpy as np
import pytest
from visitor import until

from plisse.studio.framing import Window

pytestmark = pytest.mark.browser


def test_the_motion_is_scrubbed_from_flat_to_folded_flat_with_its_free_range(visitor):
    tab = visitor.tab_behind
    visitor.tab("Look")
    visitor.slide("folded (%)", "Home")
    until(lambda: tab.scene.height_of_paper < 1e-3 * tab.scene.extent[1])
    flat = visitor.seen()
    visitor.slide("folded (%)", "End")
    until(lambda: tab.dress.chosen.percent == 200)
    visitor.wait_for("Free of collisions from")
    visitor.wait_for("free to")
    until(lambda: not np.array_equal(visitor.seen(), flat))
    visitor.tab("Design")
    visitor.slide("inclination θ (°)", "ArrowLeft")
    until(lambda: tab.found.report.design["pattern"]["theta"] < 40)
    assert tab.dress.chosen.percent == 100


def test_plates_offsets_colours_and_lines_are_switches_that_can_be_taken_back(visitor):
    tab = visitor.tab_behind
    sheet = len(tab.scene.points)
    visitor.tab("Look")
    visitor.choose("as", "plates")
    until(lambda: len(tab.scene.points) > 2 * sheet)
    plates = len(tab.scene.points)
    visitor.write("thickness or distance", "1000")
    visitor.wait_for("not done")
    assert "exact" in visitor.status
    visitor.choose("as", "offset")
    visitor.write("thickness or distance", "2")
    until(lambda: len(tab.scene.points) == sheet != plates and tab.dress.chosen.solid == ("offset", 2))
    until(lambda: "not done" not in visitor.page.locator("[role=status]").inner_text())
    visitor.choose("as", "sheet")
    visitor.choose("colours", "opening")
    visitor.wait_for("opening angle of creases")
    painted = visitor.seen()
    visitor.tick("rulings")
    until(lambda: not np.array_equal(visitor.seen(), painted))
    assert visitor.node("/colours") is not None
    visitor.choose("as", "plates")
    until(lambda: visitor.page.get_by_label("colours", exact=True).input_value() == "paper")
    assert tab.dress.chosen.colour == ""
    visitor.choose("colours", "opening")
    until(lambda: visitor.page.get_by_label("as", exact=True).input_value() == "sheet")
    until(lambda: visitor.node("/colours") is not None)
    visitor.choose("colours", "paper")
    until(lambda: visitor.node("/colours") is None)


def test_the_camera_turns_is_kept_and_comes_back(visitor):
    camera = visitor.tab_behind.client.camera
    visitor.rest()
    visitor.tab("Look")
    visitor.button("keep")
    begun, middle = camera.position.copy(), camera.look_at.copy()
    away = np.linalg.norm(begun - middle)
    visitor.tick("turntable")
    until(lambda: np.linalg.norm(camera.position - begun) > 0.2 * away)
    visitor.tick("turntable")
    visitor.rest()  # a last turn may be on its way
    assert camera.look_at == pytest.approx(middle, abs=1e-3 * away)
    assert np.linalg.norm(camera.position - camera.look_at) == pytest.approx(away, rel=1e-3)  # float32 on the way
    visitor.button("go back")
    until(lambda: np.linalg.norm(camera.position - begun) < 1e-3 * away)
    visitor.button("Best view")
    visitor.rest()


def test_the_camera_follows_what_leaves_the_window_and_nothing_else(visitor):
    tab, camera = visitor.tab_behind, visitor.tab_behind.client.camera

    def widen(width):
        tab._loop.call_soon_threadsafe(tab.change, {"pattern.width": width})
        until(lambda: tab.found.report.design["pattern"]["width"] == width and not tab.found.drafted)
        visitor.rest()

    def direction():
        return (camera.position - camera.look_at) / np.linalg.norm(camera.position - camera.look_at)

    def reach():
        return Window.of(camera).reach(tab.scene.points, camera)

    visitor.rest()
    place, towards = camera.position.copy(), direction()
    assert 0.5 < reach() < 0.95
    widen(5.2)
    assert camera.position == pytest.approx(place)
    widen(20.0)
    assert np.linalg.norm(camera.position - place) > 0.1 * np.linalg.norm(place - camera.look_at)
    assert direction() == pytest.approx(towards, abs=1e-3)
    assert reach() < 0.95
    visitor.page.mouse.move(400, 400)
    for _ in range(8):
        visitor.page.mouse.wheel(0, -400)
    until(lambda: reach() > 1.2)
    visitor.rest()
    place = camera.position.copy()
    widen(19.0)
    assert camera.position == pytest.approx(place)


def test_grooves_are_shaded_when_nothing_moves_and_the_paper_moves_without(visitor):
    tab = visitor.tab_behind
    until(lambda: visitor.node("/grooves") is not None and not visitor.node("/folded/front").visible)
    visitor.tab("Look")
    visitor.slide("folded (%)", "ArrowLeft")
    until(lambda: tab.dress.chosen.percent < 100 and visitor.node("/folded/front").visible)
    until(lambda: not visitor.node("/folded/front").visible)
    visitor.choose("colours", "opening")
    until(lambda: visitor.node("/colours") is not None and visitor.node("/grooves") is None)


def test_the_picture_of_plates_shows_plates(visitor):
    tab = visitor.tab_behind
    paper = visitor.download("picture, PNG")[1]
    visitor.tab("Look")
    visitor.choose("as", "plates")
    until(lambda: "plate" in tab.scene._view.lines)
    assert visitor.download("picture, PNG")[1] != paper


def test_every_control_has_a_name_and_is_reached_with_the_keyboard(visitor):
    page = visitor.page
    for name in ("Design", "Look", "Surface", "Take away"):
        visitor.tab(name)
        page.get_by_role("tab", name=name, selected=True).wait_for()
        until(lambda: page.evaluate("""() => [...document.querySelectorAll('[role=slider], input, textarea, button')]
            .every(c => !c.offsetParent || c.type == 'file' || c.type == 'hidden' || c.innerText || c.ariaLabel || c.title
                        || c.tabIndex < 0 || c.ariaHidden || (c.labels && c.labels.length))"""), seconds=5)
    visitor.tab("Design")
    reached = set()
    for _ in range(40):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.getAttribute('aria-label')"))
    assert {"inclination θ (°)", "creases", "width (mm)"} <= reached
    page.get_by_role("tab", name="Design", exact=True).press("Enter")


def test_a_phone_of_390_pixels_is_a_viewer(browser, studio):
    from visitor import Visitor

    phone = Visitor(browser, studio, width=390, height=780)
    page, camera = phone.page, phone.tab_behind.client.camera
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    phone.rest()
    begun = camera.position.copy()
    page.mouse.move(200, 250)
    page.mouse.down()
    page.mouse.move(120, 230, steps=6)
    page.mouse.up()
    until(lambda: not np.allclose(camera.position, begun))
    phone.picture("studio-phone.png")
    page.get_by_text("exact · a wave").click()
    phone.wait_for("smallest sector")
    page.get_by_role("tab", name="Look").click()
    phone.slide("folded (%)", "Home")
    until(lambda: phone.tab_behind.dress.chosen.percent == 0)
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    phone.leave()

"""Tabs are independent, leave nothing behind, and pages of other sites get nothing."""

import gc
import json
import weakref
from pathlib import Path

import pytest
from visitor import Visitor, until

pytestmark = pytest.mark.browser


def test_two_tabs_have_two_designs_and_a_closed_one_leaves_nothing(browser, studio):
    one, two = Visitor(browser, studio), Visitor(browser, studio)
    first = one.tab_behind
    two.slide("creases", "ArrowRight")
    until(lambda: two.tab_behind.found.report.design["pattern"]["creases"] == 8)
    assert first.desk.recipe.pattern.creases == 7
    process, remembered = two.tab_behind._hands.pid, weakref.ref(two.tab_behind)
    two.leave()
    until(lambda: list(studio.tabs.values()) == [first])
    until(lambda: not Path(f"/proc/{process}").exists())
    two.tab_behind = None
    until(lambda: gc.collect() >= 0 and remembered() is None)
    one.leave()
    until(lambda: not studio.tabs)


def test_pages_of_other_sites_and_other_names_for_this_machine_get_nothing(browser, studio, start):
    other = start({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}}, "cones")
    page = browser.new_page()
    assert page.goto(f"http://evil.localhost:{studio.port}/").status == 403
    assert page.goto(f"http://localhost:{other.port}/").status == 200
    assert page.evaluate("""async port => {
        const opened = address => new Promise(done => {
            const socket = new WebSocket(address);
            socket.onopen = () => done("in");
            socket.onerror = () => done("refused");
        });
        const read = await fetch(`http://localhost:${port}/`).then(() => "in", () => "refused");
        return [await opened(`ws://localhost:${port}`), await opened(`ws://127.0.0.1:${port}`), read];
    }""", studio.port) == ["refused"] * 3
    assert not studio.tabs
    page.close()


def test_controls_of_a_phone_are_as_wide_as_its_window_whatever_its_bar_says(browser, studio):
    phone = Visitor(browser, studio, width=390, height=780)
    page = phone.page
    page.get_by_text("exact · a wave").click()
    broken = phone.text.replace("creases = 7", "creases = 2")
    page.get_by_label("design (TOML)").fill(broken)
    phone.button("Read the text above")
    phone.wait_for("not done · ")
    assert page.locator("[style*='max-height: 60%'] .mantine-ScrollArea-viewport").first.evaluate(
        "controls => [controls.clientWidth, controls.scrollWidth]") == [390, 390]
    phone.leave()


def test_a_solve_that_dies_ends_that_solve_only(visitor):
    """The process behind the tab is killed while nobody looks; the next change has a new one."""
    import os
    import signal

    tab = visitor.tab_behind
    os.kill(tab._hands.pid, signal.SIGKILL)
    visitor.slide("creases", "ArrowRight")
    until(lambda: tab.desk.recipe.pattern.creases == 8)
    visitor.slide("creases", "ArrowRight")
    until(lambda: tab.found is not None and tab.found.report.vertices == 9 * 61)
    visitor.wait_for("exact")


def test_files_are_taken_away_under_the_name_of_the_design(visitor):
    names = {"plates, STL": ".stl", "picture, PNG": ".png", "report page, HTML": ".html", "flat sheet, SVG": ".svg",
             "pieces nested on sheets, PDF": ".pdf", "offset, FOLD": ".fold"}
    beginnings = {".png": b"\x89PNG", ".html": b"<!", ".svg": b"<?xml", ".pdf": b"%PDF", ".fold": b"{"}
    for kind, suffix in names.items():
        name, content = visitor.download(kind)
        assert name.startswith("a-wave")
        assert name.endswith(suffix)
        assert content.lstrip().startswith(beginnings.get(suffix, b""))
    assert len(json.loads(visitor.download("report, JSON")[1])["design"]["curve"]["points"]) == 4

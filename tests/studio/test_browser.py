"""The studio as people use it, in a real browser."""

import json
import os
import time
import tomllib
from pathlib import Path

import numpy as np
import pytest

from plisse.io.designs import design_from_dict

ROOF = "\n".join([*(f"v {x} {y} {0.02 * x * x - 0.01 * y * y}" for x in range(-20, 21, 4) for y in range(-20, 21, 4)),
                  *(f"f {11 * i + j + 1} {11 * i + j + 12} {11 * i + j + 13} {11 * i + j + 2}"
                    for i in range(10) for j in range(10))])


class Visitor:
    """A browser tab, and what one does in it."""

    def __init__(self, browser, port, width=1300, height=900):
        self.page = browser.new_page(viewport={"width": width, "height": height}, accept_downloads=True)
        self.errors, self.foreign = [], []
        self.page.on("console", lambda message: self.errors.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.errors.append(str(error)))
        self.page.on("request", lambda request: self._note(request.url, port))
        self.page.goto(f"http://localhost:{port}/")
        self.wait_for("exact")

    def _note(self, url, port):
        if not url.startswith((f"http://localhost:{port}/", f"ws://localhost:{port}", "data:", "blob:")):
            self.foreign.append(url)

    def wait_for(self, words, seconds=60):
        self.page.wait_for_function("words => document.body.innerText.includes(words)", arg=words, timeout=1000 * seconds)

    def tab(self, name):
        self.page.get_by_role("tab", name=name).click()

    def button(self, name):
        self.page.get_by_role("button", name=name, exact=True).click()

    def slide(self, name, *keys):
        self.page.get_by_role("slider", name=name, exact=True).focus()
        for key in keys:
            self.page.keyboard.press(key)

    def number(self, name):
        return float(self.page.get_by_role("slider", name=name, exact=True).get_attribute("aria-valuenow"))

    @property
    def text(self):
        self.tab("Take away")
        time.sleep(0.5)
        return self.page.get_by_label("design (TOML)").input_value()

    def download(self, kind):
        self.tab("Take away")
        self.page.get_by_label("format").click()
        self.page.get_by_role("option", name=kind, exact=True).click()
        with self.page.expect_download(timeout=60_000) as waiting:
            self.button("Download")
        return Path(waiting.value.path()).read_bytes()

    def picture(self, name):
        folder = os.environ.get("PLISSE_PICTURES")
        if folder:
            time.sleep(1.5)
            self.page.screenshot(path=str(Path(folder) / name))


@pytest.fixture
def visitor(browser, studio):
    visitor = Visitor(browser, studio.port)
    yield visitor
    assert visitor.errors == []
    assert visitor.foreign == []
    visitor.page.close()


def tab_of(studio):
    return next(iter(studio.tabs.values()))


def until(condition, seconds=30):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this did not happen in time"
        time.sleep(0.05)


def pixel(studio, point):
    """Where a point of the scene is on the page."""
    camera = tab_of(studio).client.camera
    ahead = (camera.look_at - camera.position) / np.linalg.norm(camera.look_at - camera.position)
    right = np.cross(ahead, camera.up_direction)
    right /= np.linalg.norm(right)
    offset = np.asarray(point) - camera.position
    scale = camera.image_height / 2 / np.tan(camera.fov / 2) / (offset @ ahead)
    return (camera.image_width / 2 + scale * (offset @ right),
            camera.image_height / 2 - scale * (offset @ np.cross(right, ahead)))


def isometry_and_planarity(document):
    """Largest difference of edge lengths flat and folded, and largest distance of quad diagonals, from the file alone."""
    flat, folded = (np.array(frame["vertices_coords"], float) for frame in (document, document["file_frames"][0]))
    a, b = np.array(document["edges_vertices"]).T
    lengths = [np.linalg.norm(points[a] - points[b], axis=1) for points in (flat, folded)]
    quads = folded[np.array(document["faces_vertices"])]
    p, q, r, s = (quads[:, k] for k in range(4))
    volume = np.abs(np.einsum("ij,ij->i", np.cross(q - p, r - p), s - p))
    size = np.linalg.norm(r - p, axis=1) * np.linalg.norm(s - q, axis=1)
    return np.abs(lengths[0] - lengths[1]).max(), (volume / size / np.linalg.norm(r - p, axis=1)).max()


def test_a_design_is_changed_moved_taken_away_and_taken_back(visitor, studio):
    first, tab = visitor.text, tab_of(studio)
    visitor.tab("Design")
    visitor.slide("inclination θ (°)", *["ArrowLeft"] * 5)
    until(lambda: tab.found.report.design["pattern"]["theta"] == visitor.number("inclination θ (°)") < 40)
    visitor.wait_for("exact")
    visitor.slide("creases", "ArrowRight")
    until(lambda: tab.found.report.vertices == 8 * 61)
    visitor.picture("studio.png")
    visitor.tab("Look")
    visitor.slide("folded (%)", "Home")
    until(lambda: tab.scene.height_of_paper < 1e-3 * tab.scene.extent[1])
    visitor.slide("folded (%)", "End")
    until(lambda: tab.percent == 200)
    document = json.loads(visitor.download("FOLD"))
    stretched, bent = isometry_and_planarity(document)
    assert stretched < 1e-9
    assert bent < 1e-9
    changed = visitor.text
    assert design_from_dict(tomllib.loads(changed)) == tab.desk.recipe
    for _ in range(5):
        visitor.button("undo")
    until(lambda: not tab.desk.can_undo)
    until(lambda: visitor.text == first)
    for _ in range(5):
        visitor.button("redo")
    until(lambda: visitor.text == changed)


def test_a_design_of_the_gallery_is_picked_by_its_picture_and_painted(visitor, studio):
    tab = tab_of(studio)
    visitor.button("Gallery …")
    visitor.page.get_by_role("img", name="fig10").wait_for()
    visitor.button("Open fig10")
    until(lambda: tab.desk.step.title == "fig10" and tab.found.report.vertices == 9)
    visitor.wait_for("exact fig10")
    visitor.tab("Look")
    visitor.page.get_by_label("colours").click()
    visitor.page.get_by_role("option", name="opening").click()
    visitor.wait_for("opening angle of creases")


def test_a_control_point_is_pulled(visitor, studio):
    tab = tab_of(studio)
    before = tab.desk.recipe.curve.points
    arrows = tab.handles.arrows
    time.sleep(2)  # the camera has come to rest
    start = pixel(studio, arrows.position + np.array([0.6 * arrows.scale, 0, 0]))
    goal = pixel(studio, arrows.position + np.array([0.6 * arrows.scale + 10, 0, 0]))
    mouse = visitor.page.mouse
    mouse.move(*start)
    time.sleep(0.5)
    mouse.down()
    mouse.move(*goal, steps=8)
    mouse.up()
    until(lambda: tab.desk.recipe.curve.points != before)
    after = tab.desk.recipe.curve.points
    assert after[1:] == before[1:]
    assert after[0][0] > before[0][0] + 3
    assert after[0][1:] == pytest.approx(before[0][1:], abs=0.01)
    until(lambda: tab.found.report.design["curve"]["points"] == after and not tab.found.drafted)
    visitor.wait_for("exact")
    visitor.picture("studio-points.png")


def test_a_good_mesh_is_pleated_and_a_bad_one_refused(visitor, studio, tmp_path):
    good, bad = tmp_path / "roof.obj", tmp_path / "bad.obj"
    good.write_text(ROOF)
    bad.write_text("this is no mesh\n" * 50)
    tab, before = tab_of(studio), tab_of(studio).desk.toml
    visitor.tab("Surface")
    for file, words in ((bad, "not done"), (good, "coverage")):
        with visitor.page.expect_file_chooser() as chooser:
            visitor.button("Upload a mesh …")
        chooser.value.set_files(file)
        visitor.wait_for(words)
        if file is bad:
            assert tab.desk.toml == before
    assert 'file = "roof.obj"' in tab.desk.toml
    assert tab.found.report.coverage > 0.8
    visitor.picture("studio-surface.png")


def test_two_tabs_have_two_designs_and_a_closed_one_leaves_nothing(browser, studio):
    one, two = Visitor(browser, studio.port), Visitor(browser, studio.port)
    first, second = studio.tabs.values()
    two.slide("creases", "ArrowRight")
    until(lambda: second.found.report.design["pattern"]["creases"] == 8)
    assert first.desk.recipe.pattern.creases == 7
    process = second._hands.pid
    two.page.close()
    until(lambda: list(studio.tabs.values()) == [first])
    until(lambda: not Path(f"/proc/{process}").exists())
    one.page.close()
    until(lambda: not studio.tabs)


def test_controls_have_names_and_can_be_reached_with_the_keyboard(visitor):
    page = visitor.page
    for name in ("Design", "Look", "Surface", "Take away"):
        visitor.tab(name)
        time.sleep(0.5)
        unnamed = page.evaluate("""() => [...document.querySelectorAll('[role=slider], input:not([type=hidden]), textarea')]
            .filter(c => c.offsetParent && c.type != 'file'
                         && !(c.getAttribute('aria-label') || (c.labels && c.labels.length))).map(c => c.outerHTML)""")
        assert unnamed == []
    visitor.tab("Design")
    reached = set()
    for _ in range(40):
        page.keyboard.press("Tab")
        reached.add(page.evaluate("document.activeElement.getAttribute('aria-label')"))
    assert {"inclination θ (°)", "creases", "width (mm)"} <= reached


def test_a_phone_shows_the_structure_and_its_status(browser, studio):
    phone = Visitor(browser, studio.port, width=390, height=780)
    assert phone.page.evaluate("document.documentElement.scrollWidth") <= 390
    phone.picture("studio-phone.png")
    assert phone.errors == []
    phone.page.close()

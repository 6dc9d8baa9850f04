"""The report page: valid, alone, small, true to the report, and without complaint in a browser."""

import json
import re
import shutil
import subprocess
import tomllib
from html import unescape
from html.parser import HTMLParser

import numpy as np
import pytest

import plisse
from plisse.assess import assess
from plisse.draw.page_plots import sheet_svg
from plisse.draw.viewer import resource
from plisse.io.page import report_page
from plisse.io.report import report_json
from plisse.shipped import shipped_design

VOID = {"meta", "link", "img", "br", "input", "path", "line", "circle", "polyline"}


class Outline(HTMLParser):
    """Open tags, and the numbers that the page states."""

    def __init__(self):
        super().__init__()
        self.open, self.numbers, self.ids, self.targets = [], [], [], []

    def handle_starttag(self, tag, attributes):
        if tag not in VOID:
            self.open.append(tag)
        for name, value in attributes:
            if tag == "data" and name == "value":
                self.numbers.append(float(value))
            if name == "id":
                self.ids.append(value)
            if name in ("src", "href", "data", "action"):
                self.targets.append(value)

    def handle_startendtag(self, tag, attributes):
        assert tag in VOID

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def parsed(page):
    outline = Outline()
    outline.feed(page)
    outline.close()
    assert outline.open == []
    return outline


@pytest.fixture
def small_still(monkeypatch):
    """Pages whose picture does not matter are made faster."""
    monkeypatch.setattr("plisse.io.page.STILL", (150, 100))


@pytest.fixture(scope="module")
def result():
    return plisse.design(shipped_design("fig01d"))


@pytest.fixture(scope="module")
def page(result):
    return result.report_page(title="fig01d")


def test_tags_close_in_order_ids_are_unique_and_nothing_is_fetched(page):
    outline = parsed(page)
    assert len(outline.ids) == len(set(outline.ids))
    assert outline.targets and all(target.startswith("data:") for target in outline.targets)
    assert "http" not in page
    assert not re.search(r"@import|url\(|fetch\(|XMLHttpRequest|import\(", page)


def test_it_is_small(page):
    assert len(page.encode()) < 5_000_000


def test_its_numbers_are_those_of_the_report(page, result):
    told = json.loads(report_json(result.report))

    def leaves(value):
        if isinstance(value, dict):
            return [leaf for item in value.values() for leaf in leaves(item)]
        if isinstance(value, list):
            return [leaf for item in value for leaf in leaves(item)]
        return [float(value)] if isinstance(value, int | float) else []

    numbers = parsed(page).numbers
    assert set(numbers) <= set(leaves(told))
    for name in ("planarity", "angle_defect", "principal_defect", "crease_deviation"):
        assert {told[name]["max"], told[name]["mean"]} <= set(numbers)
    assert set(told["development"]["size_mm"]) <= set(numbers)


def test_its_recipe_makes_the_same_design(page, result):
    text = unescape(re.search(r'<pre id="recipe">(.*?)</pre>', page, re.DOTALL)[1])
    assert tomllib.loads(text) == result.design.to_dict()


def test_every_map_has_its_scale_and_the_deviation_is_among_them(page):
    choices = re.findall(r'name="map" value="(\w+)"', page)
    assert choices == ["paper", "planarity", "angle", "principal", "opening", "deviation"]
    assert re.findall(r'data-map="(\w+)"', page) == choices[1:]


def test_mountains_are_dash_dotted_and_valleys_dashed_on_the_sheet_and_in_its_key(page):
    for name, marks in (("mountain", 4), ("valley", 2)):
        paths = re.findall(rf'<path class="{name}"[^>]*>', page)
        dashes = [re.search(r'stroke-dasharray="([^"]*)"', path) for path in paths]
        assert len(dashes) == 2 and all(dash and len(dash[1].split()) == marks for dash in dashes)
    assert "drawn through" not in page


def test_the_sentence_below_the_chart_counts_its_points(page):
    assert f"measured {page.count('<circle')} times" in page


def test_words_of_strangers_stay_words(cones, small_still):
    report = assess(cones)
    page = report_page(cones, report, title='</title><script>alert("x")</script>')
    parsed(page)
    assert "<script>alert" not in page


def test_a_structure_without_recipe_or_sheet_has_a_page_too(cones, small_still):
    bare = cones.with_vertices(cones.vertices)
    page = report_page(bare, assess(bare))
    parsed(page)
    assert "The flat sheet" not in page and "The recipe" not in page


def test_what_is_wrong_is_said_in_plain_words(cones, small_still):
    vertices = cones.vertices.copy()
    vertices[90, 2] += 1.0
    page = report_page(cones.with_vertices(vertices), assess(cones.with_vertices(vertices)))
    assert "What is wrong, and what helps" in page
    assert "Faces are not planar" in page


def test_a_design_that_came_to_nothing_has_no_page():
    nothing = plisse.design({"curve": {"kind": "arc", "radius": 10, "angle": 180},
                             "pattern": {"creases": 30, "width": 2, "amplitude": 1}})
    assert nothing.structure is None
    with pytest.raises(ValueError, match="no structure"):
        nothing.report_page()
    assert "infeasible" in nothing._repr_html_()


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_the_script_parses(tmp_path):
    script = tmp_path / "viewer.js"
    script.write_text(resource("viewer.js"), encoding="utf-8")
    assert subprocess.run(["node", "--check", script]).returncode == 0


TIMERS = "<head><script>window.requestAnimationFrame = (frame) => setTimeout(frame, 0);</script>"
BROWSER = next((found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None)


@pytest.mark.skipif(BROWSER is None, reason="no Chromium to open the page in: apt-get install chromium")
def test_a_browser_shows_it_without_complaint(page, tmp_path):
    """Every map is chosen, every switch thrown; then the canvas must show something.

    Frames come by timers, which a browser without screen keeps in order with its virtual clock.
    """
    drive = """<script>
      for (const input of document.querySelectorAll("#viewer input:not([name=turning])")) input.click();
      document.querySelector("canvas").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowLeft" }));
      setTimeout(function () {
        const canvas = document.querySelector("canvas"), copy = document.createElement("canvas");
        copy.width = copy.height = 64;
        const pen = copy.getContext("2d");
        pen.drawImage(canvas, 0, 0, 64, 64);
        const shown = pen.getImageData(0, 0, 64, 64).data.filter((value, k) => k % 4 === 3 && value > 200).length;
        document.body.dataset.shown = shown;
        document.body.dataset.wide = document.documentElement.scrollWidth > innerWidth;
      }, 500);</script></body>"""
    shown = opened(page.replace("<head>", TIMERS).replace("</body>", drive), tmp_path)
    assert int(re.search(r'data-shown="(\d+)"', shown)[1]) > 300
    assert 'data-wide="false"' in shown


@pytest.mark.skipif(BROWSER is None, reason="no Chromium to open the page in: apt-get install chromium")
def test_the_still_picture_stands_in_while_the_context_of_the_canvas_is_lost(page, tmp_path):
    drive = """<script>
      const canvas = document.querySelector("canvas"), still = document.querySelector(".still"), seen = [];
      const context = canvas.getContext("webgl"), thief = context && context.getExtension("WEBGL_lose_context");
      const note = () => seen.push([still, canvas].map((one) => getComputedStyle(one).display).join(" "));
      note();
      if (thief) thief.loseContext();
      setTimeout(function () {
        note();
        if (thief) thief.restoreContext();
        setTimeout(function () {
          note();
          document.body.dataset.seen = seen.join(", ");
          if (!thief) return;
          const pixels = new Uint8Array(4 * canvas.width * canvas.height);
          context.readPixels(0, 0, canvas.width, canvas.height, context.RGBA, context.UNSIGNED_BYTE, pixels);
          document.body.dataset.shown = pixels.filter((value, k) => k % 4 === 3 && value > 200).length;
        }, 500);
      }, 500);</script></body>"""
    shown = opened(page.replace("<head>", TIMERS).replace("</body>", drive), tmp_path)
    assert 'data-seen="none block, block none, none block"' in shown
    assert int(re.search(r'data-shown="(\d+)"', shown)[1]) > 10_000


@pytest.mark.skipif(BROWSER is None, reason="no Chromium to print with: apt-get install chromium")
def test_rulings_do_not_drown_the_creases_in_print(result, tmp_path):
    pdfium = pytest.importorskip("pypdfium2")
    whole = sheet_svg(result.structure, "mm")
    kinds = [whole, *(re.sub(rf'<path class="(?:{names})"[^>]*>', "", whole) for names in ("ruling", "mountain|valley"))]
    pages = "".join(f'<section style="break-after:page">{kind}</section>' for kind in kinds)
    file, printed = tmp_path / "sheets.html", tmp_path / "sheets.pdf"
    file.write_text(f"<style>{resource('page.css')}</style><main>{pages}</main>", encoding="utf-8")
    subprocess.run([BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}",
                    "--no-pdf-header-footer", f"--print-to-pdf={printed}", file.as_uri()], check=True, capture_output=True,
                   timeout=120)
    with pdfium.PdfDocument(printed) as document:
        ink = [255 - np.asarray(document[k].render(scale=2, grayscale=True).to_pil(), dtype=float).mean() for k in range(3)]
    rulings, creases = ink[0] - ink[1], ink[0] - ink[2]
    assert 0 < rulings < creases


def opened(page, folder):
    """The page as a browser leaves it, which may not complain; skips where there is no WebGL."""
    file = folder / "page.html"
    file.write_text(page, encoding="utf-8")
    done = subprocess.run(
        [BROWSER, "--headless=new", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
         "--enable-unsafe-swiftshader", f"--user-data-dir={folder / 'profile'}", "--virtual-time-budget=5000",
         "--enable-logging=stderr", "--dump-dom", file.as_uri()], capture_output=True, text=True, timeout=120)
    assert [line for line in done.stderr.splitlines() if "CONSOLE" in line] == []
    if 'class="live"' not in done.stdout:
        pytest.skip("this Chromium has no WebGL")
    return done.stdout

"""A studio and a real browser to look at it; without a browser its tests are skipped, and say why."""

import os
import shutil

import pytest

from plisse.io.designs import design_from_dict

RECIPE = {"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 18, 8], [80, 18, 14], [120, 0, 16]]},
          "pattern": {"theta": 40, "creases": 7, "width": 5, "amplitude": 3, "samples": 61}, "solve": {"principal": True}}
SOFTWARE = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]


@pytest.fixture
def studio():
    pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")
    from plisse.studio.gate import Gate
    from plisse.studio.server import Studio

    running = Studio(design_from_dict(RECIPE), "a wave", Gate("127.0.0.1"), port=0)
    yield running
    running.close()


@pytest.fixture(scope="module")
def browser():
    playwright = pytest.importorskip("playwright.sync_api", reason="playwright is not installed: pip install playwright")
    names = (os.environ.get("PLISSE_BROWSER"), "chromium", "chromium-browser", "google-chrome")
    found = next((path for name in names if name and (path := shutil.which(name))), None)
    if found is None:
        pytest.skip("there is no Chromium: install the distribution's, or name one in PLISSE_BROWSER")
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=SOFTWARE)
        yield browser
        browser.close()

"""A real browser at a running studio; where there is none these tests are skipped, and say why."""

import os
import shutil
from pathlib import Path

import pytest
from recipes import WAVE
from visitor import Visitor

from plisse.io.designs import design_from_dict

SOFTWARE = ["--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
NAMES = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="session")
def browser():
    pytest.importorskip("viser", reason='viser is not installed: pip install "plisse[studio]"')
    playwright = pytest.importorskip("playwright.sync_api", reason='playwright is not installed: pip install ".[dev]"')
    with playwright.sync_playwright() as driver:
        own = driver.chromium.executable_path
        found = next((path for name in (os.environ.get("PLISSE_BROWSER"), *NAMES) if name and (path := shutil.which(name))),
                     own if Path(own).exists() else None)
        if found is None:
            pytest.skip("there is no Chromium: install the distribution's, or run `playwright install chromium`, or name "
                        "one in PLISSE_BROWSER")
        browser = driver.chromium.launch(executable_path=found, args=SOFTWARE)
        yield browser
        browser.close()


@pytest.fixture
def start(browser):
    """Starts a studio with a design and a title."""
    from plisse.studio.gate import Gate
    from plisse.studio.server import Studio

    running = []

    def start(recipe, title):
        running.append(Studio(design_from_dict(recipe), title, Gate("127.0.0.1"), port=0))
        return running[-1]

    yield start
    for studio in running:
        studio.close()


@pytest.fixture
def studio(start):
    return start(WAVE, "a wave")


@pytest.fixture
def visitor(browser, studio):
    """Somebody at the studio, to whom nothing went wrong and nothing was asked of the internet."""
    visitor = Visitor(browser, studio)
    yield visitor
    visitor.leave()

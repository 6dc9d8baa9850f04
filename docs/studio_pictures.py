"""Pictures of the studio for the docs, from a real browser: `python docs/studio_pictures.py`."""

import io
import shutil
import time
from pathlib import Path

import numpy as np
from PIL import Image
from playwright.sync_api import sync_playwright

from plisse.io.designs import design_from_dict, read_design
from plisse.shipped import shipped_design
from plisse.studio.gate import Gate
from plisse.studio.server import Studio

PLACE = Path(__file__).parent / "pictures"
SIZE = {"width": 1300, "height": 850}
WAVE = design_from_dict({"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 26, 8], [85, 24, 14], [120, -5, 16]]},
                         "pattern": {"theta": 35, "creases": 9, "width": 6, "amplitude": 4, "samples": 81},
                         "solve": {"principal": True}})
STEPS = 12
EXACT = "document.querySelector('#plisse-status')?.innerText.includes('exact')"


def opened(browser, studio: Studio):
    """A page with the studio at rest, without the browser's note about drawing in software."""
    page = browser.new_page(viewport=SIZE)
    page.goto(f"http://localhost:{studio.port}/")
    page.wait_for_function(EXACT, timeout=60_000)
    time.sleep(2)
    for button in page.locator(".mantine-Notification-closeButton").all():
        button.click()
    time.sleep(2)
    return page


def pulled(page, studio: Studio) -> list[Image.Image]:
    """Pictures while the second control point goes up and down."""
    tab, frames = next(iter(studio.tabs.values())), []
    points = np.array(tab.desk.recipe.curve.points)
    for step in range(STEPS):
        moved = points.copy()
        moved[1, 1] += 7 * np.sin(2 * np.pi * step / STEPS)
        tab._loop.call_soon_threadsafe(tab.change, {"curve.points": moved.tolist()})
        time.sleep(1.0)
        page.wait_for_function(EXACT, timeout=60_000)
        frames.append(Image.open(io.BytesIO(page.screenshot())).convert("RGB").resize((780, 510)))
    return frames


def main() -> None:
    """Write studio.png and studio.gif."""
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=[
            "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        studio = Studio(read_design(shipped_design("fig16")), "fig16", Gate("127.0.0.1"), port=0)
        shot = Image.open(io.BytesIO(opened(browser, studio).screenshot())).convert("RGB")
        shot.quantize(128).save(PLACE / "studio.png", optimize=True)
        studio.close()
        studio = Studio(WAVE, "a wave", Gate("127.0.0.1"), port=0)
        frames = [frame.quantize(64) for frame in pulled(opened(browser, studio), studio)]
        frames[0].save(PLACE / "studio.gif", save_all=True, append_images=frames[1:], duration=180, loop=0, optimize=True)
        studio.close()
        browser.close()


if __name__ == "__main__":
    main()

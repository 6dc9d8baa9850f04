"""The studio in a real browser: from a step of a slider to the new picture, and memory over many edits.

    python benchmarks/studio.py [DESIGN] [EDITS]

Needs playwright and a Chromium. The time is measured in the browser: from the key that moves the slider to the second frame
after the status of the new design has arrived. Memory is that of the server with the tab's process, edits go to and fro.
"""

import shutil
import statistics
import sys
import time
from pathlib import Path

from playwright.sync_api import sync_playwright

from plisse.io.designs import read_design
from plisse.shipped import shipped_design
from plisse.studio.gate import Gate
from plisse.studio.server import Studio

SLIDER = "inclination θ (°)"
WATCH = """() => {
  window.times = [];
  addEventListener("keydown", () => { window.begun = performance.now(); }, true);
  new MutationObserver(() => {
    const badge = document.querySelector("#plisse-status");
    if (!window.begun || !badge || !badge.innerText.includes("exact")) return;
    const begun = window.begun;
    window.begun = 0;
    requestAnimationFrame(() => requestAnimationFrame(() => window.times.push(performance.now() - begun)));
  }).observe(document.body, { childList: true, subtree: true, characterData: true });
}"""


def memory(*processes: int) -> float:
    """Resident memory of processes together in MB."""
    pages = sum(int(Path(f"/proc/{process}/statm").read_text().split()[1]) for process in processes)
    return pages * 4096 / 1e6


def main(name: str, edits: int) -> None:
    """Print the median and largest time, and memory now and then."""
    studio = Studio(read_design(shipped_design(name)), name, Gate("127.0.0.1"), port=0)
    with sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=shutil.which("chromium"), args=[
            "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"])
        page = browser.new_page(viewport={"width": 1300, "height": 900})
        page.goto(f"http://localhost:{studio.port}/")
        page.wait_for_function("document.querySelector('#plisse-status')?.innerText.includes('exact')", timeout=60_000)
        tab = next(iter(studio.tabs.values()))
        time.sleep(3)
        page.evaluate(WATCH)
        page.get_by_role("slider", name=SLIDER, exact=True).focus()
        own = int(Path("/proc/self").resolve().name)
        for edit in range(edits):
            page.keyboard.press("ArrowRight" if edit // 5 % 2 == 0 else "ArrowLeft")
            page.wait_for_function(f"window.times.length > {edit}", timeout=60_000)
            if edit % max(1, edits // 10) == 0:
                print(f"after {edit:4d} edits: {memory(own, tab._hands.pid):.0f} MB", flush=True)
        times = page.evaluate("window.times")
        median, largest = statistics.median(times), max(times)
        print(f"{name}: from the slider to the picture, median {median:.0f} ms, largest {largest:.0f} ms")
        browser.close()
    studio.close()


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "fig01d", int(sys.argv[2]) if len(sys.argv) > 2 else 200)

"""The studio in a real browser: from a step of a slider to the new picture, and memory over many edits.

    python benchmarks/studio.py [--quick]

Needs playwright and a Chromium. The time is measured in the browser: from the key that moves the slider to the second frame
after the status of the new design has arrived, with the hand at rest for a second between two steps. Memory is that of the
server with the tab's process over edits to and fro without a rest.
"""

import shutil
import statistics
import time
from pathlib import Path

from clocks import alone
from plisse.io.designs import read_design
from plisse.shipped import shipped_design
from plisse.studio.gate import Gate
from plisse.studio.server import Studio

TITLE = "The studio"
DESIGN = "fig01d"
SLIDER = "inclination θ (°)"
WATCH = """() => {
  window.times = [];
  const said = () => document.querySelector("#plisse-status")?.parentElement.innerText ?? "";
  addEventListener("keydown", () => { window.begun = performance.now(); window.before = said(); }, true);
  new MutationObserver(() => {
    if (!window.begun || said() === window.before || !said().includes("exact")) return;
    const begun = window.begun;
    window.begun = 0;
    requestAnimationFrame(() => requestAnimationFrame(() => window.times.push(performance.now() - begun)));
  }).observe(document.body, { childList: true, subtree: true, characterData: true });
}"""


def memory(*processes: int) -> float:
    """Resident memory of processes together in MB."""
    pages = sum(int(Path(f"/proc/{process}/statm").read_text().split()[1]) for process in processes)
    return pages * 4096 / 1e6


REST = 1.0


def measured(quick: bool = False) -> dict:
    """Milliseconds from a slider to the picture, and memory now and then."""
    from playwright.sync_api import sync_playwright

    edits, timed = (30, 10) if quick else (500, 100)
    studio = Studio(read_design(shipped_design(DESIGN)), DESIGN, Gate("127.0.0.1"), port=0)
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
        own, seen = int(Path("/proc/self").resolve().name), []
        for edit in range(edits):
            if edit < timed:
                time.sleep(REST)
            page.keyboard.press("ArrowRight" if edit // 5 % 2 == 0 else "ArrowLeft")
            page.wait_for_function(f"window.times.length > {edit}", timeout=60_000)
            if edit % (edits // 10) == 0:
                seen.append([edit, memory(own, tab._hands.pid)])
        times = page.evaluate("window.times")[:timed]
        browser.close()
    studio.close()
    return {"design": DESIGN, "edits": edits, "timed": timed, "median_ms": statistics.median(times),
            "largest_ms": max(times), "memory_mb": seen}


def lines(found: dict) -> list[str]:
    """Markdown."""
    memory = [megabytes for _, megabytes in found["memory_mb"]]
    return [f"{found['design']} in Chromium, which draws in software, {found['timed']} steps of a slider, one a second: "
            f"from the key to the second frame after the new design has arrived, median {found['median_ms']:.0f} ms, "
            f"largest {found['largest_ms']:.0f} ms. Memory of server and tab: {memory[0]:.0f} MB after the first edit, "
            f"{memory[-1]:.0f} MB after edit {found['memory_mb'][-1][0]}."]


if __name__ == "__main__":
    alone(measured)

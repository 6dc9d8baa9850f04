"""What a study costs beyond its designs, and what a second worker gains: `python benchmarks/studies.py`."""

import os
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory
from time import perf_counter

from clocks import alone
from plisse.study import run

TITLE = "Studies"
DESIGN = "fig01d"
TURNS = 3  # runs with one worker and with two, one after the other: clocks drift


def measured(quick: bool = False) -> dict:
    """Overhead between two designs of one worker, and designs per second with one worker and with two."""
    designs, load = 20 if quick else 120, os.getloadavg()[0]
    turns = [(_made(1, designs), _made(2, designs)) for _ in range(1 if quick else TURNS)]
    rates = [[made / seconds for seconds, made, _ in turn] for turn in turns]
    return {"designs": designs, "load": load, "seconds_per_design": median(one[2] for one, _ in turns),
            "overhead": median(one[0] / one[1] - one[2] for one, _ in turns),
            "designs_per_second": [median(column) for column in zip(*rates, strict=True)],
            "ratios": [two / one for one, two in rates], "ratio": median(two / one for one, two in rates)}


def _made(workers: int, designs: int) -> tuple[float, int, float]:
    """Seconds between the first and the last fifth of the outcomes, how many lie between, and seconds per design."""
    seen: dict[int, float] = {}

    def note(stage, fraction):
        seen.setdefault(round(fraction * designs), perf_counter())

    plan = {"base": DESIGN, "vary": {"pattern.theta": {"start": 25, "stop": 35, "count": designs}}}
    with TemporaryDirectory() as directory:
        study = run(plan, Path(directory), workers=workers, progress=note)
    first, last = min(k for k in seen if k >= designs // 5), max(k for k in seen if k <= 4 * designs // 5)
    seconds = [row.seconds for row in study.rows]
    return seen[last] - seen[first], last - first, sum(seconds) / len(seconds)


def lines(found: dict) -> list[str]:
    """Markdown."""
    one, two = found["designs_per_second"]
    return [f"A study of {found['designs']} variants of {DESIGN}: {1000 * found['seconds_per_design']:.0f} ms per "
            f"design, {1000 * found['overhead']:.1f} ms between two designs of one worker; {one:.1f} designs per second "
            f"with one worker, {two:.1f} with two, {found['ratio']:.2f} times as many (from {min(found['ratios']):.2f} to "
            f"{max(found['ratios']):.2f} in {len(found['ratios'])} turns), start-up not counted. Medians, wall clock."]


if __name__ == "__main__":
    alone(measured)

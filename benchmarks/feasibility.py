"""Where pleats on helices succeed, and whether that can be foretold: `python benchmarks/feasibility.py [DIRECTORY]`.

Runs or resumes benchmarks/feasibility.toml (128 small designs, about three minutes on two cores) and writes
docs/feasibility.md with its maps.
"""

import platform
import sys
from collections import Counter
from datetime import date
from math import pi
from pathlib import Path

from plisse.draw.region import places, write_region
from plisse.study import run
from plisse.study.outcome import OUTCOMES

HERE = Path(__file__).parent
DOCS = HERE.parent / "docs"
KINDS = {False: "general", True: "principal"}


def ratio(row):
    """Torsion over curvature of a row's helix."""
    return round(row.recipe["curve"]["pitch"] / (2 * pi * row.recipe["curve"]["radius"]), 2)


def draw(rows, kind):
    found = places((ratio(row), row.recipe["pattern"]["theta"], row.recipe["pattern"]["amplitude"], row.status)
                   for row in rows)
    write_region(found, DOCS / f"feasibility-{kind}.png", labels=("pattern.theta", "pattern.amplitude"), panels="τ / κ",
                 outcomes=OUTCOMES, title=f"{kind} designs")


def confusion(rows):
    """Lines of the table predicted × found, and the sentence below it."""
    count = Counter((bool(row.numbers["hopeful"]), row.status == "exact") for row in rows)
    right = count[True, True] + count[False, False]
    return ["| | found exact | found not exact |", "|---|--:|--:|",
            f"| predicted hopeful | {count[True, True]} | {count[True, False]} |",
            f"| predicted hopeless | {count[False, True]} | {count[False, False]} |", "",
            f"The prediction is right for {right} of {len(rows)} designs."]


def by_ruling(rows):
    """Lines of a table: share of exact designs by the smallest predicted ruling angle."""
    lines = ["| smallest ruling angle foretold | designs | exact |", "|---|--:|--:|"]
    for low, high in ((0, 5), (5, 15), (15, 30), (30, 45), (45, 90)):
        here = [row for row in rows if low <= (row.numbers["min_ruling_deg"] or 0.0) < high]
        if here:
            lines.append(f"| {low}° to {high}° | {len(here)} | {sum(row.status == 'exact' for row in here)} |")
    return lines


def page(study):
    seconds = sum(row.seconds or 0.0 for row in study.rows)
    lines = ["# Feasibility", "",
             "Which pleats are possible? 8 creases with strips of width 6 on half a turn of a helix of radius 100, for four",
             "ratios of torsion and curvature, four inclinations `theta` and four amplitudes, as general and as principal",
             "structures. *Predicted* is what `plisse` says of the pattern before it solves anything",
             "(`solve/forecast.py`: rulings above 5°, folds neither flat nor shut), *found* is the outcome.", "",
             f"Made by `python benchmarks/feasibility.py` on {date.today():%d %B %Y}, {platform.machine()}, Python "
             f"{platform.python_version()}: {len(study.rows)} designs of 480 vertices, {seconds:.0f} seconds of computing.",
             "[Studies](studies.md) says how to make such maps of your own."]
    for principal, kind in KINDS.items():
        rows = [row for row in study.rows if row.recipe["solve"]["principal"] is principal]
        draw(rows, kind)
        lines += ["", f"## {kind.capitalize()} designs", "", f"![outcomes of {kind} designs](feasibility-{kind}.png)", "",
                  *confusion(rows), "", *by_ruling(rows)]
    return "\n".join(lines) + "\n"


def main():
    directory = Path(sys.argv[1]) if len(sys.argv) > 1 else Path("feasibility")
    study = run(HERE / "feasibility.toml", directory, progress=lambda stage, fraction: print(f"\r{stage:70}", end=""))
    print()
    (DOCS / "feasibility.md").write_text(page(study), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()

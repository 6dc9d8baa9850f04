"""Seconds and memory of whole designs, beside the paper's method on the same machine: `python benchmarks/designs.py`.

Prints one JSON row per design. `ratio` is paper seconds (functional (5), same linear solver) over exact seconds, both
from this run; `optimisation` is the solve stage only.
"""

import json
import resource
import sys
from importlib.resources import files

from msgspec.structs import replace

import plisse
from plisse.io.designs import read_design


def shipped(name):
    return read_design(str(files("plisse") / "gallery" / f"{name}.toml"))


def resized(design, creases, samples):
    """The design on another grid; widths and amplitude shrink with the number of creases, theta becomes one value."""
    pattern = design.pattern
    scale = (pattern.creases - 1) / (creases - 1)
    return replace(design, pattern=replace(pattern, creases=creases, samples=samples, width=pattern.width * scale,
                                           amplitude=pattern.amplitude * scale))


def row(name, design, with_paper):
    report = plisse.design(design).report
    entry = {"name": name, "vertices": report.vertices, "status": report.status,
             "optimisation": round(report.seconds["solve"], 3), "total": round(report.seconds["total"], 3),
             "peak_mb": round(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)}
    if with_paper:
        paper = plisse.design(replace(design, solve=replace(design.solve, method="paper"))).report
        entry["paper"] = round(paper.seconds["solve"], 3)
        entry["ratio"] = round(paper.seconds["solve"] / report.seconds["solve"], 1)
    return entry


def main():
    plisse.design(shipped("fig10"))  # imports
    arc = replace(shipped("fig15b"), pattern=replace(shipped("fig15b").pattern, theta=20.0))
    cases = [("fig01d", shipped("fig01d"), True), ("fig19", shipped("fig19"), "--all" in sys.argv),
             ("fig19 at 17 x 750", resized(shipped("fig19"), 17, 750), False),
             ("helix at 50 x 2000", resized(arc, 50, 2000), False)]
    for case in cases:
        print(json.dumps(row(*case)), flush=True)


if __name__ == "__main__":
    main()

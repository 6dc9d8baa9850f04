"""Seconds and memory as designs grow to 100,000 vertices, also of the whole command: `python benchmarks/growth.py`."""

import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np

from cases import HELIX, helix, helix_settings
from clocks import alone, fresh, staged
from plots import COLOURS, MARKERS, logarithmic, panels
from systems import one_factorisation

TITLE = "Growth, and memory"
LONG, SQUARE = "50 creases, longer and longer", "as many creases as vertices along them"
SIZES = {LONG: [(50, samples) for samples in (40, 100, 250, 600, 1200, 2000)],
         SQUARE: [(side, side) for side in (32, 64, 100, 144, 200)]}
QUICK = {LONG: [(50, 40), (50, 100)]}
LARGE = 5000  # vertices from which the exponent is fitted: below, fixed costs rule
REPEATS = 3


def measured(quick: bool = False) -> dict:
    """Rows per size: processor seconds of solving, the command's seconds and memory; and the fitted exponents."""
    staged(helix(8, 40))  # imports
    families = []
    for name, sizes in (QUICK if quick else SIZES).items():
        rows = [_row(*size, 1 if quick else REPEATS) for size in sizes]
        large = [row for row in rows if row["vertices"] >= LARGE]
        families.append({"name": name, "rows": rows, "exponent": _exponent(large if len(large) > 1 else rows, "solve"),
                         "exponent_of_command": _exponent(large if len(large) > 1 else rows, "command")})
    return {"families": families}


def _row(creases: int, samples: int, repeats: int) -> dict:
    command = _command(creases, samples)
    runs = [staged(helix(creases, samples)) for _ in range(repeats)]
    result = runs[0][0]
    solve = {clock: median(spans["solve"][clock] for _, spans in runs) for clock in ("cpu", "wall")}
    whole = {clock: median(sum(stage[clock] for stage in spans.values()) for _, spans in runs) for clock in ("cpu", "wall")}
    return {"creases": creases, "samples": samples, "vertices": result.report.vertices, "status": result.status,
            "ways": 1 + len(result.report.tried), "solve": solve, "whole": whole,
            "command": {clock: command[clock] for clock in ("cpu", "wall")}, "peak_mb": command["peak_mb"],
            "limit": one_factorisation(result.structure)}


def _command(creases: int, samples: int) -> dict:
    """`plisse make` with all its files, in a process of its own."""
    settings = [text for key, value in helix_settings(creases, samples).items()
                for text in ("--set", f"pattern.{key}={value}")]
    with TemporaryDirectory() as directory:
        found = fresh(sys.executable, "-m", "plisse", "make", HELIX, "--quiet", "-o", "out", *settings,
                      directory=Path(directory))
    if found["code"]:
        raise RuntimeError(f"plisse make ended with {found['code']} for {creases} × {samples}")
    return found


def _exponent(rows: list[dict], key: str) -> float:
    return np.polyfit(np.log([row["vertices"] for row in rows]), np.log([row[key]["cpu"] for row in rows]), 1)[0]


def headline(found: dict) -> str:
    """One sentence."""
    family = found["families"][0]
    largest = family["rows"][-1]
    return (f"{largest['vertices']:,} vertices take {largest['solve']['cpu']:.1f} s of solving, "
            f"{largest['command']['wall']:.0f} s and {largest['peak_mb'] / 1024:.2f} GiB as a command with all its files; "
            f"solving grows with the number of vertices to the power {family['exponent']:.2f}.")


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Pleats on a helix, general, solved from scratch. *Solving* is the solve stage, *design* also evolution, "
           "flattening and measuring, in processor seconds; *command* is `plisse make` in a process of its own, with FOLD, "
           "OBJ, SVG, picture and report, on the wall clock, with its peak memory. Exponents are fitted from "
           f"{LARGE:,} vertices on. On squares the bandwidth grows too, and no direct solver is linear there; where creases "
           "end up farther from their guides than an amplitude, more ways are tried, and all are charged."]
    for family in found["families"]:
        out += ["", f"**{family['name'].capitalize()}**: solving grows with exponent {family['exponent']:.2f}, the command "
                f"with {family['exponent_of_command']:.2f}.", "",
                "| grid | vertices | solving s | one factorisation s | design s | command s | peak MiB | status | ways |",
                "|---|--:|--:|--:|--:|--:|--:|---|--:|"]
        out += [f"| {row['creases']} × {row['samples']} | {row['vertices']:,} | {row['solve']['cpu']:.3f} | "
                f"{row['limit']:.4f} | {row['whole']['cpu']:.2f} | {row['command']['wall']:.1f} | {row['peak_mb']:.0f} | "
                f"{row['status']} | {row['ways']} |" for row in family["rows"]]
    return out


def draw(found: dict):
    """Seconds, and memory, over vertices."""
    figure, (seconds, memory) = panels(2, height=4.0)
    styles = {LONG: ("50 × n", "-", "full", COLOURS[:2]), SQUARE: ("n × n", "--", "none", COLOURS[2:4])}
    for family in found["families"]:
        grid, line, filled, colours = styles[family["name"]]
        rows = family["rows"]
        vertices = [row["vertices"] for row in rows]
        for key, clock, colour, marker in zip(("solve", "command"), ("cpu", "wall"), colours, MARKERS, strict=False):
            seconds.plot(vertices, [row[key][clock] for row in rows], marker + line, color=colour, fillstyle=filled,
                         label=f"{'solving' if key == 'solve' else 'command'}, {grid}", markersize=5)
        seconds.plot(vertices, [row["limit"] for row in rows], ":", color=colours[0], label=f"one factorisation, {grid}")
        memory.plot(vertices, [row["peak_mb"] for row in rows], MARKERS[1] + line, color=colours[1], fillstyle=filled,
                    markersize=5)
    logarithmic(seconds, "xy")
    logarithmic(memory, "x")
    seconds.set(xlabel="vertices", ylabel="seconds")
    memory.set(xlabel="vertices", ylabel="peak memory of the command, MiB", ylim=(0, None))
    figure.legend(*seconds.get_legend_handles_labels(), loc="outside upper center", ncols=3, frameon=False)
    return figure


if __name__ == "__main__":
    alone(measured)

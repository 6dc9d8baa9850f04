"""What it costs to start, in new processes that take turns: `python benchmarks/startup.py`."""

import sys
from pathlib import Path
from statistics import median
from tempfile import TemporaryDirectory

import numpy as np

from clocks import alone, fresh
from plots import COLOURS, panels

TITLE = "Starting up"
PYTHON = (sys.executable, "-c")
PLISSE = (sys.executable, "-m", "plisse")
SLOW = "plisse make fig01a"
COMMANDS = {"python -c pass": (*PYTHON, "pass"),
            "import numpy, scipy": (*PYTHON, "import numpy, scipy"),
            "import plisse": (*PYTHON, "import plisse"),
            "import plisse; plisse.design": (*PYTHON, "import plisse; plisse.design"),
            "plisse --help": (*PLISSE, "--help"),
            "plisse make --help": (*PLISSE, "make", "--help"),
            SLOW: (*PLISSE, "make", "fig01a", "--quiet", "-o", "out")}
REPEATS = 7


def measured(quick: bool = False) -> dict:
    """Median and least seconds of every command; the first turn, which compiles, does not count."""
    commands = {name: command for name, command in COMMANDS.items() if not (quick and name == SLOW)}
    seen: dict[str, list[dict]] = {name: [] for name in commands}
    with TemporaryDirectory() as directory:
        for turn in range((1 if quick else REPEATS) + 1):
            for name, command in commands.items():
                found = fresh(*command, directory=Path(directory))
                if found["code"]:
                    raise RuntimeError(f"{name} ended with {found['code']}")
                if turn:
                    seen[name].append(found)
    return {"rows": [{"name": name, "wall": median(run["wall"] for run in runs), "cpu": median(run["cpu"] for run in runs),
                      "least": min(run["wall"] for run in runs), "peak_mb": max(run["peak_mb"] for run in runs)}
                     for name, runs in seen.items()]}


def headline(found: dict) -> str:
    """One sentence."""
    seconds = {row["name"]: row["wall"] for row in found["rows"]}
    return (f"`import plisse` takes {seconds['import plisse']:.2f} s "
            f"({seconds['import plisse; plisse.design']:.2f} s with all that solves), "
            f"`plisse --help` {seconds['plisse --help']:.2f} s; bare Python takes {seconds['python -c pass']:.2f} s.")


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Seconds on the wall clock of new processes, bytecode and files being warm. `import plisse` imports names on "
           "first use; the next line is what solving needs.", "",
           "| command | median s | least s | processor s | peak MiB |", "|---|--:|--:|--:|--:|"]
    return out + [f"| `{row['name']}` | {row['wall']:.3f} | {row['least']:.3f} | {row['cpu']:.3f} | {row['peak_mb']:.0f} |"
                  for row in found["rows"]]


def draw(found: dict):
    """Median seconds by command."""
    rows = [row for row in found["rows"] if row["name"] != SLOW]
    figure, (axes,) = panels(1, height=1.0 + 0.33 * len(rows))
    at = np.arange(len(rows))[::-1]
    axes.barh(at, [row["wall"] for row in rows], 0.6, color=COLOURS[5])
    axes.plot([row["least"] for row in rows], at, "|", color=COLOURS[6], markersize=12, label="least")
    axes.set_yticks(at, [row["name"] for row in rows])
    axes.grid(False, axis="y")
    axes.set_xlabel("seconds, median; the tick is the least")
    return figure


if __name__ == "__main__":
    alone(measured)

"""All benchmarks: one command, one JSON file, one page.

    python benchmarks/run.py [--only NAME …] [--quick] [-o DIRECTORY] [--into ROOT]

Runs every subject in a process of its own with one thread for linear algebra, writes DIRECTORY/benchmarks.json
(benchmarks/results if left out), and makes from it alone docs/benchmarks.md with its pictures, docs/table.md, and the
block between markers in README.md, all below ROOT (the checkout; for --quick the DIRECTORY). With --only the other subjects
stay as they were measured before; `--only` without a name only writes the pages again. `studies` and `studio` take longer
or need a browser and run only when named.
"""

import argparse
import json
import os
import subprocess
import sys
import time
from datetime import date
from pathlib import Path

from machine import machine
from page import publish
from plisse.threads import LIBRARIES

HERE = Path(__file__).parent
SUBJECTS = ("figure21", "methods", "scipy_solver", "growth", "factorisation", "marching", "tracing", "flattening", "motion",
            "startup")
ON_DEMAND = ("studies", "studio")


def main(arguments: list[str] | None = None) -> int:
    """Measure, write, publish."""
    asked = _parser().parse_args(arguments)
    directory = asked.output or HERE / "results"
    root = asked.into or (directory if asked.quick else HERE.parent)
    path = directory / "benchmarks.json"
    found = {"machine": machine(), "subjects": {}}
    if asked.only is not None and path.is_file():
        found = _continued(json.loads(path.read_text(encoding="utf-8")), found)
    directory.mkdir(parents=True, exist_ok=True)
    failed = []
    for name in SUBJECTS if asked.only is None else asked.only:
        print(f"{name:15}", end="", flush=True, file=sys.stderr)
        entry = _measured(name, asked.quick)
        print("failed" if entry is None else f"{entry['seconds']:6.0f} s", flush=True, file=sys.stderr)
        if entry is None:
            failed.append(name)
            continue
        found["subjects"][name] = entry
        path.write_text(json.dumps(found, indent=1, ensure_ascii=False) + "\n", encoding="utf-8", newline="\n")
    publish(json.loads(path.read_text(encoding="utf-8")), (*SUBJECTS, *ON_DEMAND), root)
    return 1 if failed else 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description="Measure plisse and write the page of benchmarks.")
    parser.add_argument("--only", nargs="*", choices=(*SUBJECTS, *ON_DEMAND), metavar="NAME",
                        help=f"some of {', '.join((*SUBJECTS, *ON_DEMAND))}; none at all to write the pages again")
    parser.add_argument("--quick", action="store_true", help="small cases, to see whether everything runs")
    parser.add_argument("-o", "--output", type=Path, metavar="DIRECTORY", help="where benchmarks.json is or will be")
    parser.add_argument("--into", type=Path, metavar="ROOT", help="the checkout whose docs and README are written")
    return parser


def _measured(name: str, quick: bool) -> dict | None:
    """What a subject found, with when and how long; None where it failed, its message being on stderr."""
    load, begun = os.getloadavg()[0], time.perf_counter()
    done = subprocess.run([sys.executable, str(HERE / f"{name}.py"), *["--quick"] * quick], stdout=subprocess.PIPE,
                          text=True, env={**os.environ, **dict.fromkeys(LIBRARIES, "1")})
    if done.returncode:
        return None
    return {"date": date.today().isoformat(), "seconds": round(time.perf_counter() - begun, 1), "load": round(load, 2),
            "quick": quick, "found": json.loads(done.stdout)}


def _continued(before: dict, now: dict) -> dict:
    """The earlier measurements, if they are of the same machine and versions."""
    if before["machine"] != now["machine"]:
        differing = ", ".join(key for key, value in now["machine"].items() if before["machine"].get(key) != value)
        raise SystemExit(f"benchmarks.json was measured with another {differing}; measure everything again, without --only")
    return before


if __name__ == "__main__":
    sys.exit(main())

"""What a study costs beyond its designs, and what a second worker gains: `python benchmarks/studies.py`.

Prints one JSON object. `overhead_ms` is the time between two designs of one worker that is not spent on a design; `ratio`
is designs per second of two workers over those of one, start-up not counted; `load` is the machine's load average before.
"""

import json
import os
from pathlib import Path
from tempfile import TemporaryDirectory
from time import perf_counter

from plisse.study import run

DESIGNS = 60
PLAN = {"base": {"curve": {"kind": "arc", "radius": 100, "angle": 90},
                 "pattern": {"theta": 20, "creases": 12, "width": 4, "amplitude": 2.5, "samples": 120}},
        "vary": {"pattern.theta": {"start": 10, "stop": 20, "count": DESIGNS}}}


def made(workers):
    """Seconds between the first and the last fifth of the outcomes, how many lie between, and seconds per design."""
    seen = {}

    def note(stage, fraction):
        seen.setdefault(round(fraction * DESIGNS), perf_counter())

    with TemporaryDirectory() as directory:
        study = run(PLAN, Path(directory), workers=workers, progress=note)
    first, last = min(k for k in seen if k >= DESIGNS // 5), max(k for k in seen if k <= 4 * DESIGNS // 5)
    seconds = sorted(row.seconds for row in study.rows)
    return seen[last] - seen[first], last - first, sum(seconds) / len(seconds)


def main():
    load = os.getloadavg()[0]
    one, two = made(1), made(2)
    print(json.dumps({"load": round(load, 1), "seconds_per_design": round(one[2], 3),
                      "overhead_ms": round(1000 * (one[0] / one[1] - one[2]), 1),
                      "designs_per_second": [round(one[1] / one[0], 2), round(two[1] / two[0], 2)],
                      "ratio": round(two[1] / two[0] / (one[1] / one[0]), 2)}))


if __name__ == "__main__":
    main()

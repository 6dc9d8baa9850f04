"""Seconds for 100 states of a motion, and for its free range: `python benchmarks/motion.py`. One JSON row per design."""

import json
import time
from importlib.resources import files

import numpy as np

import plisse
from plisse.measure.isometry import isometry_defect

STATES = 100


def row(name: str) -> dict:
    """Times, and the worst isometry of all states in mean edge lengths."""
    structure = plisse.design(str(files("plisse") / "gallery" / f"{name}.toml")).structure
    begin = time.perf_counter()
    motion = structure.flex(np.linspace(0, 200, STATES))
    states = time.perf_counter() - begin
    begin = time.perf_counter()
    free = motion.free_range
    collisions = time.perf_counter() - begin
    worst = max(isometry_defect(motion.topology, vertices, motion.development) for vertices in motion.vertices)
    return {"name": name, "vertices": motion.topology.vertex_count, "states": STATES, "seconds": round(states, 3),
            "isometry": float(f"{worst:.1e}"), "free": [free.low, free.high], "collisions_seconds": round(collisions, 3)}


def main() -> None:
    """Print a row for each design."""
    for name in ("fig10", "fig05", "fig01d", "fig26"):
        print(json.dumps(row(name)), flush=True)


if __name__ == "__main__":
    main()

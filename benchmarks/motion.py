"""Seconds for 100 states of a motion, and for its free range: `python benchmarks/motion.py`."""

import numpy as np

import plisse
from cases import shipped
from clocks import alone, spent
from plisse.measure.isometry import isometry_defect

TITLE = "Motion"
STATES = 100


def measured(quick: bool = False) -> dict:
    """A row for each design: times, and the worst isometry of all states in mean edge lengths."""
    return {"states": STATES, "rows": [_row(name) for name in ("fig10", "fig05", *(() if quick else ("fig01d", "fig26")))]}


def _row(name: str) -> dict:
    structure = plisse.design(shipped(name)).structure
    motion, states = spent(lambda: structure.flex(np.linspace(0, 200, STATES)))
    free, collisions = spent(lambda: motion.free_range)
    worst = max(isometry_defect(motion.topology, vertices, motion.development) for vertices in motion.vertices)
    return {"name": name, "vertices": motion.topology.vertex_count, **states, "isometry": worst,
            "free": [free.low, free.high], "collisions": collisions}


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = [f"{found['states']} states from flat to flat-folded, and how far the structure moves before it meets itself; "
           "processor seconds.", "",
           f"| design | vertices | {found['states']} states s | isometry defect | free range | its search s |",
           "|---|--:|--:|--:|--:|--:|"]
    return out + [f"| {row['name']} | {row['vertices']:,} | {row['cpu']:.3f} | {row['isometry']:.0e} | "
                  f"{row['free'][0]:.0f} to {row['free'][1]:.0f} % | {row['collisions']['cpu']:.2f} |"
                  for row in found["rows"]]


if __name__ == "__main__":
    alone(measured)

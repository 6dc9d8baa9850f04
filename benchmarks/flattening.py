"""Seconds and accuracy of developments: `python benchmarks/flattening.py`."""

import numpy as np

from clocks import alone, spent
from plisse.measure.isometry import isometry_defect
from plisse.solve.flatten import flatten
from plisse.structure.exact import alternating_cones

TITLE = "Flattening"
GRIDS = ((12, 242), (60, 60), (113, 113), (50, 500), (50, 2000))
QUICK = ((12, 60), (12, 242))
REPEATS = 3


def measured(quick: bool = False) -> dict:
    """Seconds and isometry defects (in mean edges) of the developments of exact cones."""
    return {"rows": [_row(*grid) for grid in (QUICK if quick else GRIDS)]}


def _row(creases: int, columns: int) -> dict:
    structure = alternating_cones(creases, columns)
    runs = [spent(lambda: flatten(structure)) for _ in range(REPEATS)]
    flat = runs[0][0].development
    clocks = min((clocks for _, clocks in runs), key=lambda clocks: clocks["cpu"])
    return {"grid": f"{creases} × {columns}", "vertices": len(flat), **clocks,
            "isometry": float(np.max(isometry_defect(structure.topology, structure.vertices, flat)))}


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Developments of pleated cones, which are exact by formula: directions from sector angles, then isometry steps. "
           "Processor seconds from scratch; the isometry defect is in mean edge lengths.", "",
           "| grid | vertices | s | isometry defect |", "|---|--:|--:|--:|"]
    return out + [f"| {row['grid']} | {row['vertices']:,} | {row['cpu']:.3f} | {row['isometry']:.0e} |"
                  for row in found["rows"]]


if __name__ == "__main__":
    alone(measured)

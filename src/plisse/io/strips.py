"""Files of strips: the cutting list as CSV, and solids as binary STL, an object of its own for every strip."""

import csv
from collections.abc import Sequence
from io import StringIO
from pathlib import Path

import numpy as np

from plisse.io.atomic import written
from plisse.recipe import MILLIMETRES
from plisse.result import StripEntry
from plisse.transform.strip_solids import StripSolid

__all__ = ["write_cutting_list", "write_solids"]

COLUMNS = ("strip", "length", "width", "curve_length", "faces", "angle_min_deg", "angle_max_deg", "shortest_ruling", "notes")


def write_cutting_list(entries: Sequence[StripEntry], path: str | Path) -> None:
    """Write one row per strip, lengths in model units, angles to the surface in degrees (empty where there is none)."""
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for entry in entries:
        angles = ("", "") if entry.inclination_deg is None else (f"{entry.inclination_deg.min:.6g}",
                                                                 f"{entry.inclination_deg.max:.6g}")
        table.writerow((entry.strip, f"{entry.length:.9g}", f"{entry.width:.9g}", f"{entry.curve_length:.9g}", entry.faces,
                        *angles, f"{entry.shortest_ruling:.9g}", "; ".join(entry.notes)))
    with written(path) as aside:
        aside.write_text(text.getvalue(), encoding="utf-8", newline="\n")


def write_solids(solids: Sequence[StripSolid], path: str | Path, *, units: str = "mm") -> None:
    """Write closed solids as one binary STL in millimetres."""
    import trimesh

    starts = np.cumsum([0, *(len(solid.vertices) for solid in solids[:-1])])
    triangles = np.concatenate([solid.triangles + start for solid, start in zip(solids, starts, strict=True)])
    vertices = np.concatenate([solid.vertices for solid in solids]) * MILLIMETRES[units]
    data: bytes = trimesh.exchange.stl.export_stl(trimesh.Trimesh(vertices, triangles, process=False))
    with written(path) as aside:
        aside.write_bytes(data)

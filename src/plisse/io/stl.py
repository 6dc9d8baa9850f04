"""STL, binary: triangles without units, which every reader takes for millimetres."""

from pathlib import Path

import numpy as np

from plisse.geometry.vectors import norm
from plisse.io.atomic import written
from plisse.recipe import MILLIMETRES
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["write_stl"]

RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def write_stl(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure in millimetres, to the seven digits that STL keeps.

    It is a sheet without thickness, no solid. Raises PlisseError where the file cannot be written.
    """
    faces, _ = triangulated(structure.topology)
    records = np.zeros(len(faces), RECORD)
    corners = structure.vertices[faces] * MILLIMETRES[units]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    records["corners"] = corners
    records["normal"] = normal / np.maximum(norm(normal), np.finfo(float).tiny)[:, None]
    header = f"plisse: {title}".encode("ascii", "replace")[:80].ljust(80)
    with written(path) as aside:
        aside.write_bytes(header + np.uint32(len(faces)).tobytes() + records.tobytes())

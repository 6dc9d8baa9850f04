"""PLY, binary: triangles in double precision, and creases as edges."""

from pathlib import Path

import numpy as np

from plisse.io.atomic import written
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["write_ply"]

FACE = np.dtype([("count", "u1"), ("vertex_indices", "<i4", 3)])


def write_ply(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure in model units with all digits; a comment says the unit.

    Raises PlisseError where the file cannot be written.
    """
    faces, _ = triangulated(structure.topology)
    edges = structure.topology.edges
    creases = edges.vertices[edges.is_crease].astype("<i4")
    triangles = np.zeros(len(faces), FACE)
    triangles["count"], triangles["vertex_indices"] = 3, faces
    comment = "".join(c if " " <= c <= "~" else "?" for c in title)
    header = ["ply", "format binary_little_endian 1.0", f"comment plisse {comment}".rstrip(), f"comment units: {units}",
              f"element vertex {len(structure.vertices)}", *(f"property double {axis}" for axis in "xyz"),
              f"element face {len(faces)}", "property list uchar int vertex_indices",
              f"element edge {len(creases)}", "property int vertex1", "property int vertex2",
              "end_header"]
    with written(path) as aside:
        aside.write_bytes("\n".join(header).encode() + b"\n" + structure.vertices.astype("<f8").tobytes()
                          + triangles.tobytes() + creases.tobytes())

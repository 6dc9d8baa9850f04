"""3MF core specification: triangles with a unit, for printers and their slicers."""

import zipfile
from collections.abc import Sequence
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from plisse.io.atomic import written
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["write_3mf", "write_package"]

UNITS = {"mm": "millimeter", "cm": "centimeter", "m": "meter", "in": "inch", "ft": "foot"}
CONTENT_TYPES = """<?xml version="1.0" encoding="UTF-8"?>
<Types xmlns="http://schemas.openxmlformats.org/package/2006/content-types">
 <Default Extension="rels" ContentType="application/vnd.openxmlformats-package.relationships+xml"/>
 <Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/>
</Types>
"""
RELATIONSHIPS = """<?xml version="1.0" encoding="UTF-8"?>
<Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
 <Relationship Target="/3D/3dmodel.model" Id="rel0" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
</Relationships>
"""
MODEL = """<?xml version="1.0" encoding="UTF-8"?>
<model unit="{unit}" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Title">{title}</metadata>
<metadata name="Application">plisse</metadata>
<resources>{objects}</resources>
<build>{items}</build>
</model>
"""


def write_3mf(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure in its own unit with all digits, as an object of type surface: a sheet is no solid.

    3MF wants coordinates of printed parts at or above zero, so the structure is moved into the first octant. Equal
    structures give equal bytes. Raises PlisseError where the file cannot be written.
    """
    faces, _ = triangulated(structure.topology)
    name = title or "structure"
    with written(path) as aside:
        write_package(aside, [(name, structure.vertices, faces)], kind="surface", title=name, units=units)


def write_package(path: Path, parts: Sequence[tuple[str, np.ndarray, np.ndarray]], *, kind: str, title: str,
                  units: str) -> None:
    """Write parts (name, vertices (V, 3), triangles (T, 3)) as objects of one `kind`, in the first octant."""
    lowest = np.min([vertices.min(axis=0) for _, vertices, _ in parts], axis=0)
    objects = [_object(number, name, kind, vertices - lowest, triangles)
               for number, (name, vertices, triangles) in enumerate(parts, 1)]
    items = "".join(f'<item objectid="{number}"/>' for number in range(1, len(parts) + 1))
    model = MODEL.format(unit=UNITS[units], title=escape(title), objects="\n".join(objects), items=items)
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in (("[Content_Types].xml", CONTENT_TYPES), ("_rels/.rels", RELATIONSHIPS),
                           ("3D/3dmodel.model", model)):
            entry = zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, text)


def _object(number: int, name: str, kind: str, vertices: np.ndarray, triangles: np.ndarray) -> str:
    points = "\n".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in vertices.tolist())
    corners = "\n".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in triangles.tolist())
    return f"""<object id="{number}" type="{kind}" name={quoteattr(name)}><mesh>
<vertices>
{points}
</vertices>
<triangles>
{corners}
</triangles>
</mesh></object>"""

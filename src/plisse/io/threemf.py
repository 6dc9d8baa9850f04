"""3MF core specification: triangles with a unit, for printers and their slicers."""

import zipfile
from pathlib import Path
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from plisse.io.atomic import written
from plisse.structure.pleated import PleatedStructure
from plisse.structure.triangles import triangulated

__all__ = ["write_3mf"]

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


def write_3mf(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure in its own unit with all digits, as an object of type surface: a sheet is no solid.

    3MF wants coordinates of printed parts at or above zero, so the structure is moved into the first octant. Equal
    structures give equal bytes. Raises PlisseError where the file cannot be written.
    """
    faces, _ = triangulated(structure.topology)
    vertices = structure.vertices - structure.vertices.min(axis=0)
    model = _model(vertices, faces, title or "structure", UNITS[units])
    with written(path) as aside, zipfile.ZipFile(aside, "w", zipfile.ZIP_DEFLATED) as package:
        for name, text in (("[Content_Types].xml", CONTENT_TYPES), ("_rels/.rels", RELATIONSHIPS),
                           ("3D/3dmodel.model", model)):
            entry = zipfile.ZipInfo(name, date_time=(1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            package.writestr(entry, text)


def _model(vertices: np.ndarray, faces: np.ndarray, title: str, unit: str) -> str:
    points = "\n".join(f'<vertex x="{x!r}" y="{y!r}" z="{z!r}"/>' for x, y, z in vertices.tolist())
    corners = "\n".join(f'<triangle v1="{a}" v2="{b}" v3="{c}"/>' for a, b, c in faces.tolist())
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<model unit="{unit}" xml:lang="en-US" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
<metadata name="Title">{escape(title)}</metadata>
<metadata name="Application">plisse</metadata>
<resources><object id="1" type="surface" name={quoteattr(title)}><mesh>
<vertices>
{points}
</vertices>
<triangles>
{corners}
</triangles>
</mesh></object></resources>
<build><item objectid="1"/></build>
</model>
"""

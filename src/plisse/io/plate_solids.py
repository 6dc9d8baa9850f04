"""Plates as solids in files: OBJ with a group per plate, STL, GLB and 3MF with an object per plate."""

from pathlib import Path

import numpy as np

from plisse.draw.colours import PAPER, rgb
from plisse.errors import InvalidDesign
from plisse.io.atomic import written
from plisse.io.gltf import upright
from plisse.io.threemf import write_package
from plisse.recipe import MILLIMETRES
from plisse.transform.plates import Plates
from plisse.transform.solids import Solid, solids

__all__ = ["FORMATS", "require_format", "write_plate_solids", "write_solid_stl"]


def require_format(path: str | Path) -> None:
    """Nothing; raises InvalidDesign for a file name that no format of FORMATS belongs to."""
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        raise InvalidDesign(f"plates cannot be written as {suffix}; give a file that ends in {', '.join(FORMATS)}, "
                            "or a directory")


def write_plate_solids(plates: Plates, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write all plates where the structure has them, in the format that the file name asks for.

    OBJ and 3MF keep model units, STL is in millimetres, GLB in metres with y upwards. Raises InvalidDesign for other
    formats, PlisseError where the file cannot be written.
    """
    require_format(path)
    with written(path) as aside:
        FORMATS[Path(path).suffix.lower()](solids(plates), aside, title, units)


def write_solid_stl(solid: Solid, path: str | Path, units: str = "mm") -> None:
    """Write one solid as binary STL in millimetres."""
    _write_stl([solid], Path(path), "", units)


def _write_obj(parts: list[Solid], path: Path, title: str, units: str) -> None:
    lines, start = [f"# plisse plates {title}".rstrip(), f"# units: {units}"], 1
    for number, part in enumerate(parts, 1):
        lines.append(f"g {_name(number, len(parts))}")
        lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in part.vertices.tolist()]
        lines += ["f " + " ".join(str(start + vertex) for vertex in face) for face in part.faces]
        start += len(part.vertices)
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def _write_stl(parts: list[Solid], path: Path, title: str, units: str) -> None:
    path.write_bytes(_joined(parts, MILLIMETRES[units]).export(file_type="stl"))


def _write_glb(parts: list[Solid], path: Path, title: str, units: str) -> None:
    import trimesh

    scene = trimesh.Scene()
    material = trimesh.visual.material.PBRMaterial(baseColorFactor=[*rgb(PAPER), 1.0], metallicFactor=0.0,
                                                   roughnessFactor=0.9)
    for number, part in enumerate(parts, 1):
        corners = upright(part.vertices[part.triangles], units)
        # corners of their own for every triangle: plates have sharp edges
        mesh = trimesh.Trimesh(corners.reshape(-1, 3), np.arange(corners.size // 3).reshape(-1, 3), process=False)
        mesh.visual = trimesh.visual.TextureVisuals(material=material)
        scene.add_geometry(mesh, geom_name=_name(number, len(parts)), node_name=_name(number, len(parts)))
    path.write_bytes(scene.export(file_type="glb", include_normals=True))


def _write_3mf(parts: list[Solid], path: Path, title: str, units: str) -> None:
    named = [(_name(number, len(parts)), part.vertices, part.triangles) for number, part in enumerate(parts, 1)]
    write_package(path, named, kind="model", title=title or "plates", units=units)


def _joined(parts: list[Solid], scale: float):
    """All solids as one trimesh mesh."""
    import trimesh

    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    triangles = np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=True)])
    return trimesh.Trimesh(np.concatenate([part.vertices for part in parts]) * scale, triangles, process=False)


def _name(number: int, count: int) -> str:
    return f"plate_{number:0{len(str(count))}d}"


FORMATS = {".obj": _write_obj, ".stl": _write_stl, ".glb": _write_glb, ".3mf": _write_3mf}

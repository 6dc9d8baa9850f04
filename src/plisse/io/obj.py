"""Wavefront OBJ: quads as faces, creases as polylines, written and read."""

from dataclasses import replace
from importlib.metadata import version
from itertools import pairwise
from pathlib import Path
from typing import NamedTuple

import numpy as np

from plisse.errors import InvalidStructure
from plisse.io.atomic import written
from plisse.io.coordinates import checked_coordinates
from plisse.io.labels import folding_evidence, labelled_topology
from plisse.io.model import Model
from plisse.io.welding import attached, used_only, welded
from plisse.recipe import MILLIMETRES
from plisse.structure.lines import Polyline, joined
from plisse.structure.pleated import PleatedStructure

__all__ = ["load_obj", "read_obj", "write_obj"]

UNITS = "# units:"


def write_obj(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure: `f` 1-based quads and hubs, `l` one polyline per crease, all digits kept.

    Closed structures stay closed, seams are polylines in a group of their own. Raises PlisseError where the file cannot
    be written.
    """
    topology = structure.topology
    name = " ".join(title.split()) or "structure"
    lines = [f"# {name}: written by plisse {version('plisse')}", f"{UNITS} {units}",
             "# faces start on a crease; every l is a crease", f"o {name}"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in structure.vertices.tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in topology.faces]
    lines += _polylines(topology.creases)
    if len(topology.seams):
        lines += ["g seams", *_polylines(joined(topology.seams))]
    with written(path) as aside:
        aside.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def _polylines(chains: tuple[Polyline, ...]) -> list[str]:
    """One line of text per polyline."""
    closed = (chain.path for chain in chains)
    return ["l " + " ".join(str(v + 1) for v in vertices.tolist()) for vertices in closed]


def read_obj(path: str | Path) -> PleatedStructure:
    """The quad mesh in an OBJ file, its edges labelled; not developed.

    Creases are the `l` polylines; without them the family of edges that folds more. Polylines in a group `seams` are
    seams. Raises InvalidStructure when the file is missing, not OBJ, or not made of quads.
    """
    return load_obj(path).structure


def load_obj(path: str | Path) -> Model:
    """The quad mesh in an OBJ file, with the unit that a comment `# units: cm` names, and the name of the object."""
    path = Path(path)
    texts = _lines(path)
    found = _parse(texts, path)
    if not found.faces:
        raise InvalidStructure(f"{path.name} has no faces (no lines that start with f); give a quad mesh")
    if len(found.objects) > 1:
        names = ", ".join(found.objects[:3]) + ", …" * (len(found.objects) > 3)
        raise InvalidStructure(f"{path.name} holds {len(found.objects)} objects ({names}), but a structure is one; "
                               "export one of them alone")
    vertices = checked_coordinates(np.array(found.vertices, dtype=float).reshape(-1, 3), path)
    vertices, (faces, creases, seams) = welded(vertices, found.faces, found.creases, found.seams)
    creases = attached(vertices, faces, creases)
    _require_edges(creases + seams, faces, path)
    vertices, (faces, creases, seams) = used_only(vertices, faces, creases, seams)
    evidence = _marked(creases) if creases else folding_evidence(vertices, faces)
    topology = labelled_topology(len(vertices), faces, evidence)
    edges = np.array([edge for line in seams for edge in pairwise(line)], np.int64)
    units = next((text.removeprefix(UNITS).strip() for text in texts if text.startswith(UNITS)), "mm")
    return Model(PleatedStructure(replace(topology, seams=edges), vertices), units if units in MILLIMETRES else "mm",
                 found.objects[0] if found.objects else "")


class _Contents(NamedTuple):
    """Vertices, and by their numbers from 0: faces, creases and seams; names of objects that have faces."""

    vertices: list[list[float]]
    faces: list[list[int]]
    creases: list[list[int]]
    seams: list[list[int]]
    objects: list[str]


def _parse(texts: list[str], path: Path) -> _Contents:
    found = _Contents([], [], [], [], [])
    lines, name = found.creases, ""
    for number, text in enumerate(texts, 1):
        keyword, *fields = text.split() or [""]
        try:
            if keyword == "v":
                found.vertices.append([float(fields[0]), float(fields[1]), float(fields[2])])
            elif keyword in ("f", "l"):
                indices = [_index(field, len(found.vertices)) for field in fields]
                (found.faces if keyword == "f" else lines).append(indices)
                if keyword == "f" and name:
                    found.objects.append(name)
                    name = ""
            elif keyword in ("g", "o"):
                lines = found.seams if keyword == "g" and fields == ["seams"] else found.creases
                name = name if keyword == "g" else " ".join(fields) or "unnamed"
        except (ValueError, IndexError):
            raise InvalidStructure(f"line {number} of {path.name} is no OBJ: {text.strip()[:40]!r}") from None
    for k, face in enumerate(found.faces):
        if not all(0 <= v < len(found.vertices) for v in face):
            raise InvalidStructure(f"face {k + 1} of {path.name} names a vertex outside 1 to {len(found.vertices)}")
    return found


def _require_edges(lines: list[list[int]], faces: list[list[int]], path: Path) -> None:
    """Raise InvalidStructure where a polyline does not run along edges of faces."""
    edges = {frozenset((face[k - 1], face[k])) for face in faces for k in range(len(face))}
    for number, line in enumerate(lines, 1):
        for a, b in pairwise(line):
            if frozenset((a, b)) not in edges:
                raise InvalidStructure(f"polyline {number} of {path.name} runs from vertex {a + 1} to {b + 1}, which is no "
                                       "edge of a face; let creases run along edges")


def _lines(path: Path) -> list[str]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InvalidStructure(f"there is no file {path}; give a FOLD, OBJ or 3DM file") from None
    except OSError as error:
        raise InvalidStructure(f"{path} cannot be read ({error.strerror})") from None
    except UnicodeDecodeError:
        raise InvalidStructure(f"{path.name} is not an OBJ file, because it is not text") from None
    return text.replace("\\\n", " ").splitlines()


def _index(field: str, count: int) -> int:
    index = int(field.split("/")[0])
    if index == 0:
        raise ValueError("OBJ counts from 1")
    return index - 1 if index > 0 else count + index


def _marked(lines: list[list[int]]):
    """Evidence from polylines: 1 on their edges, 0 elsewhere."""
    marked = {frozenset(edge) for line in lines for edge in pairwise(line)}

    def evidence(start: np.ndarray, end: np.ndarray) -> np.ndarray:
        return np.array([float(frozenset(edge) in marked)
                         for edge in zip(start.tolist(), end.tolist(), strict=True)])

    return evidence

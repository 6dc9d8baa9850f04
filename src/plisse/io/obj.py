"""Wavefront OBJ: quads as faces, creases as polylines, written and read."""

from importlib.metadata import version
from itertools import pairwise
from pathlib import Path

import numpy as np

from plisse.errors import InvalidStructure
from plisse.io.atomic import written
from plisse.io.coordinates import checked_coordinates
from plisse.io.labels import labelled_topology
from plisse.measure.folds import fold_angles
from plisse.structure.pleated import PleatedStructure

__all__ = ["read_obj", "write_obj"]


def write_obj(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm") -> None:
    """Write the folded structure: `f` 1-based quads and hubs, `l` one polyline per crease, all digits kept.

    Closed structures stay closed. Raises PlisseError where the file cannot be written.
    """
    topology = structure.topology
    name = " ".join(title.split()) or "structure"
    lines = [f"# {name}: written by plisse {version('plisse')}", f"# units: {units}",
             "# faces start on a crease; every l is a crease", f"o {name}"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in structure.vertices.tolist()]
    lines += ["f " + " ".join(str(v + 1) for v in face) for face in topology.faces]
    for crease in topology.creases:
        vertices = crease.vertices.tolist() + ([int(crease.vertices[0])] if crease.closed else [])
        lines.append("l " + " ".join(str(v + 1) for v in vertices))
    with written(path) as aside:
        aside.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def read_obj(path: str | Path) -> PleatedStructure:
    """The quad mesh in an OBJ file, its edges labelled; not developed.

    Creases are the `l` polylines; without them the family of edges that folds more. Raises InvalidStructure
    when the file is missing, not OBJ, or not made of quads.
    """
    path = Path(path)
    vertices, faces, lines = _parse(path)
    if not faces:
        raise InvalidStructure(f"{path.name} has no faces (no lines that start with f); give a quad mesh")
    vertices = checked_coordinates(vertices, path)
    _require_edges(lines, faces, path)
    evidence = _marked(lines) if lines else _folded(vertices, faces)
    return PleatedStructure(labelled_topology(len(vertices), faces, evidence), vertices)


def _parse(path: Path) -> tuple[np.ndarray, list[list[int]], list[list[int]]]:
    vertices: list[list[float]] = []
    faces: list[list[int]] = []
    lines: list[list[int]] = []
    for number, text in enumerate(_lines(path), 1):
        keyword, *fields = text.split() or [""]
        try:
            if keyword == "v":
                vertices.append([float(fields[0]), float(fields[1]), float(fields[2])])
            elif keyword in ("f", "l"):
                indices = [_index(field, len(vertices)) for field in fields]
                (faces if keyword == "f" else lines).append(indices)
        except (ValueError, IndexError):
            raise InvalidStructure(f"line {number} of {path.name} is no OBJ: {text.strip()[:40]!r}") from None
    for k, face in enumerate(faces):
        if not all(0 <= v < len(vertices) for v in face):
            raise InvalidStructure(f"face {k + 1} of {path.name} names a vertex outside 1 to {len(vertices)}")
    return np.array(vertices, dtype=float).reshape(-1, 3), faces, lines


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
        raise InvalidStructure(f"there is no file {path}; give a FOLD or OBJ file") from None
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


def _folded(vertices: np.ndarray, faces: list[list[int]]):
    """Evidence from the shape: how far the surface folds at an edge, in radians."""
    topology = labelled_topology(len(vertices), faces, lambda start, end: np.zeros(len(start)))
    key = np.sort(topology.edges.vertices, axis=1) @ [len(vertices), 1]
    order = np.argsort(key)
    angle = np.abs(fold_angles(topology, vertices))[order]

    def evidence(start: np.ndarray, end: np.ndarray) -> np.ndarray:
        wanted = np.minimum(start, end) * len(vertices) + np.maximum(start, end)
        return angle[np.searchsorted(key[order], wanted)]

    return evidence

"""FOLD 1.2: the crease pattern as key frame and the folded form as second frame, written and read.

Creases are M or V with their fold angle. Rulings are F with fold angle 0, as FOLD wants unfolded edges,
although the discrete paper bends there a little: their true angles stand in `edges_plisse:rulingAngle`.
`edges_plisse:kind` says which edges lie on creases (on the boundary too) and which on seams; `vertices_plisse:source`
which vertices were one before a structure was cut open or parted along its seams.
"""

import json
from dataclasses import replace
from importlib.metadata import version
from pathlib import Path

import msgspec
import numpy as np

from plisse.errors import InvalidStructure
from plisse.io.atomic import written
from plisse.io.coordinates import checked_coordinates
from plisse.io.curved_creases import curved_document
from plisse.io.labels import folding_evidence, labelled_topology
from plisse.io.model import Model
from plisse.measure.folds import assignments, fold_angles
from plisse.recipe import MILLIMETRES
from plisse.structure.cut import Cut
from plisse.structure.front import front_up
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["PERCENT", "fold_bytes", "fold_document", "load_fold", "read_fold", "write_fold"]

PERCENT = "frame_plisse:percent"
EVIDENCE = {"M": 1.0, "V": 1.0, "F": -1.0, "J": -1.0}
MILLIMETRES_OF_OTHERS = {"pt": 25.4 / 72, "um": 1e-3, "nm": 1e-6}


def write_fold(structure: PleatedStructure, path: str | Path, *, title: str = "", units: str = "mm",
               curves: bool = False) -> None:
    """Write the structure as FOLD; coordinates keep all digits and equal structures give equal bytes.

    `curves` adds the creases as splines. Raises InvalidStructure when there is no development, PlisseError where the
    file cannot be written.
    """
    document = fold_document(structure, title=title, units=units)
    document = curved_document(document, structure) if curves else document
    with written(path) as aside:
        aside.write_bytes(fold_bytes(document))


def fold_document(structure: PleatedStructure, *, title: str = "", units: str = "mm") -> dict:
    """The FOLD document of a structure as plain lists and dictionaries, lengths in model units."""
    flat, folded = front_up(structure), structure.opened
    topology = folded.topology
    letters, degrees, bends = _folds(folded)
    document = {
        "file_spec": 1.2,
        "file_creator": f"plisse {version('plisse')}",
        "file_title": title,
        "file_classes": ["singleModel"],
        "frame_title": "development",
        "frame_classes": ["creasePattern"],
        "frame_attributes": ["2D", "manifold", "orientable"],
        "frame_unit": units,
        "vertices_coords": flat.tolist(),
        "edges_vertices": topology.edges.vertices.tolist(),
        "edges_assignment": letters.tolist(),
        "edges_foldAngle": degrees.tolist(),
        "edges_plisse:kind": _kinds(structure).tolist(),
        "edges_plisse:rulingAngle": bends.tolist(),
        "faces_vertices": topology.faces,
        "file_frames": [{
            "frame_title": "folded",
            "frame_classes": ["foldedForm"],
            "frame_attributes": ["3D", "manifold", "orientable"],
            "frame_parent": 0,
            "frame_inherit": True,
            "vertices_coords": folded.vertices.tolist(),
        }],
    }
    if not structure.cut.is_trivial:
        document["vertices_plisse:source"] = structure.cut.source.tolist()
    return document


def _kinds(structure: PleatedStructure) -> np.ndarray:
    """crease, ruling or seam (E,) for every edge of the opened structure."""
    edges, count = structure.opened.topology.edges, structure.topology.vertex_count
    ends, seams = np.sort(structure.cut.source[edges.vertices], axis=1), np.sort(structure.topology.seams, axis=1)
    on_seam = np.isin(ends @ [count, 1], seams @ [count, 1])
    return np.where(on_seam, "seam", np.where(edges.is_crease, "crease", "ruling"))


def _folds(folded: PleatedStructure) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Letters, fold angles of creases and bends of rulings in degrees, one per edge; 0 for the other kind."""
    edges = folded.topology.edges
    degrees = np.degrees(fold_angles(folded.topology, folded.vertices))
    letters = assignments(folded.topology, folded.vertices)
    letters = np.where(edges.is_crease | edges.is_boundary, letters, "F")
    folded_here = np.isin(letters, ["M", "V"])
    return letters, np.where(folded_here, degrees, 0.0), np.where(edges.is_crease, 0.0, degrees)


def fold_bytes(document: dict) -> bytes:
    """The text of a FOLD document, one line per property, so that people and version control can read it."""
    lines = [msgspec.json.encode(key) + b": " + msgspec.json.encode(value) for key, value in document.items()]
    return b"{\n" + b",\n".join(lines) + b"\n}\n"


def read_fold(path: str | Path) -> PleatedStructure:
    """The structure in a FOLD file, closed again along the cut; lengths in the file's unit.

    Of the frames of a motion the one nearest to the designed state is taken. In files of others the M and V edges tell
    the creases from the rulings, or else the sharper folds. Raises InvalidStructure for files that are no FOLD, have no
    folded form, or no quads between creases.
    """
    return load_fold(path).structure


def load_fold(path: str | Path) -> Model:
    """The structure in a FOLD file with its unit and title; units that designs do not know become millimetres."""
    path = Path(path)
    frames = _frames(_load(path))
    structure = _structure(frames, path)
    unit, title = (value if isinstance(value := frames[0].get(key), str) else "" for key in ("frame_unit", "file_title"))
    if unit in MILLIMETRES_OF_OTHERS:
        scale = MILLIMETRES_OF_OTHERS[unit]
        flat = None if structure.development is None else structure.development * scale
        structure = replace(structure, vertices=structure.vertices * scale, development=flat)
    return Model(structure, unit if unit in MILLIMETRES else "mm", title)


def _structure(frames: list[dict], path: Path) -> PleatedStructure:
    folded = _folded(frames)
    if "creasePattern" in _list(folded, "frame_classes"):
        raise InvalidStructure(f"{path.name} holds a crease pattern, but no folded form; save that frame too")
    faces = _faces(folded, path)
    vertices = _coordinates(folded, path, 3)
    topology = labelled_topology(len(vertices), faces, _evidence(folded) or folding_evidence(vertices, faces))
    flat = next((f for f in frames if "creasePattern" in _list(f, "frame_classes")), None)
    development = None if flat is None or flat is folded else _coordinates(flat, path, 2)
    if development is not None and len(development) != len(vertices):
        development = None
    source = folded.get("vertices_plisse:source")
    if source is None:
        return PleatedStructure(topology, vertices, development=development)
    if not isinstance(source, list) or not all(type(vertex) is int for vertex in source):
        raise InvalidStructure(f"vertices_plisse:source in {path.name} does not describe a cut structure")
    return _welded(topology, vertices, development, np.array(source, np.int64), _seams(folded), path)


def _welded(topology: Topology, vertices: np.ndarray, development: np.ndarray | None, source: np.ndarray,
            seams: np.ndarray, path: Path) -> PleatedStructure:
    used, first = np.unique(source, return_index=True)
    if source.shape != (len(vertices),) or not np.array_equal(used, np.arange(len(used))):
        raise InvalidStructure(f"vertices_plisse:source in {path.name} does not describe a cut structure")
    if seams.min(initial=0) < 0 or seams.max(initial=0) >= len(source):
        raise InvalidStructure(f"an edge of kind seam in {path.name} names a vertex outside 0 to {len(source) - 1}")
    closed = Topology(len(used), source[topology.quads], tuple(source[hub] for hub in topology.hubs), seams=source[seams])
    _ = closed.edges
    return PleatedStructure(closed, vertices[first], Cut(topology, source), development)


def _load(path: Path) -> dict:
    try:
        data = json.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise InvalidStructure(f"there is no file {path}; give a FOLD, OBJ or 3DM file") from None
    except OSError as error:
        raise InvalidStructure(f"{path} cannot be read ({error.strerror})") from None
    except (UnicodeDecodeError, ValueError, RecursionError):
        raise InvalidStructure(f"{path.name} is not a FOLD file: it does not hold valid JSON") from None
    if not isinstance(data, dict):
        raise InvalidStructure(f"{path.name} is not a FOLD file, because its JSON is not an object")
    return data


def _frames(data: dict) -> list[dict]:
    """All frames with what they inherit."""
    frames = [{key: value for key, value in data.items() if key != "file_frames"}]
    for frame in _list(data, "file_frames"):
        if not isinstance(frame, dict):
            continue
        parent = frame.get("frame_parent", 0)
        inherits = frame.get("frame_inherit") and isinstance(parent, int) and 0 <= parent < len(frames)
        frames.append(frames[parent] | frame if inherits else frame)
    return frames


def _folded(frames: list[dict]) -> dict:
    """The first folded form, in a motion the one nearest to 100 percent; without any the first frame."""
    def off(frame: dict) -> float:
        percent = frame.get(PERCENT)
        return abs(percent - 100) if isinstance(percent, int | float) else 0.0

    return min((frame for frame in frames if "foldedForm" in _list(frame, "frame_classes")), key=off, default=frames[0])


def _faces(frame: dict, path: Path) -> list[list[int]]:
    faces = _list(frame, "faces_vertices")
    if not faces:
        raise InvalidStructure(f"{path.name} has no faces_vertices; let a FOLD tool compute the faces first")
    count = len(_list(frame, "vertices_coords"))
    for k, face in enumerate(faces):
        if not isinstance(face, list) or not all(type(v) is int and 0 <= v < count for v in face):
            raise InvalidStructure(f"faces_vertices[{k}] of {path.name} does not name vertices from 0 to {count - 1}")
    return faces


def _coordinates(frame: dict, path: Path, dimension: int) -> np.ndarray:
    """Coordinates (V, dimension), filled with zeros as FOLD says."""
    try:
        rows = np.array([(list(map(float, row)) + [0.0] * dimension)[:dimension] for row in frame["vertices_coords"]],
                        dtype=float).reshape(-1, dimension)
    except (KeyError, TypeError, ValueError, OverflowError):
        raise InvalidStructure(f"{path.name} has no vertices_coords that are lists of numbers") from None
    return checked_coordinates(rows, path)


def _seams(frame: dict) -> np.ndarray:
    """Edges (S, 2) that are seams according to our labels; both copies of each."""
    pairs = zip(_list(frame, "edges_vertices"), _list(frame, "edges_plisse:kind"), strict=False)
    edges = [edge for edge, kind in pairs if kind == "seam" and isinstance(edge, list) and len(edge) == 2
             and all(type(vertex) is int for vertex in edge)]
    return np.array(edges, np.int64).reshape(-1, 2)


def _evidence(frame: dict):
    """A function that is large on creases: from our labels, or else from what others assign; None if nobody says."""
    edges, kinds = _list(frame, "edges_vertices"), _list(frame, "edges_plisse:kind")
    if len(kinds) == len(edges) and kinds:
        values = [1.0 if kind == "crease" else -1.0 for kind in kinds]
    else:
        values = [EVIDENCE.get(letter, 0.0) if isinstance(letter, str) else 0.0
                  for letter in _list(frame, "edges_assignment")]
    if not any(values):
        return None
    pairs = zip(edges, values, strict=False)
    known = {frozenset(edge): value for edge, value in pairs
             if isinstance(edge, list) and all(type(vertex) is int for vertex in edge)}

    def evidence(start: np.ndarray, end: np.ndarray) -> np.ndarray:
        ends = zip(start.tolist(), end.tolist(), strict=True)
        return np.array([known.get(frozenset(edge), 0.0) for edge in ends])

    return evidence


def _list(frame: dict, key: str) -> list:
    value = frame.get(key)
    return value if isinstance(value, list) else []

"""Reference meshes from anything trimesh reads (.obj, .ply, .stl, .off, .glb, …)."""

import logging
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path

import numpy as np

from plisse.errors import InvalidMesh
from plisse.geometry.cleaning import cleaned
from plisse.geometry.mesh import ReferenceMesh

__all__ = ["read_mesh"]

MAX_BYTES = 300_000_000


def read_mesh(path: str | Path) -> ReferenceMesh:
    """The surface in a mesh file, in its own units, cleaned; what was repaired stands in its `notes`.

    Raises InvalidMesh, in one sentence, for files that hold no single surface.
    """
    path = Path(path)
    _refuse_bad_file(path)
    vertices, faces = _load(path)
    try:
        return cleaned(vertices, faces)
    except InvalidMesh as error:
        raise InvalidMesh(f"{path.name}: {error}") from None


def _refuse_bad_file(path: Path) -> None:
    import trimesh

    if path.is_dir():
        raise InvalidMesh(f"{path} is a folder; give a mesh file")
    if not path.is_file():
        raise InvalidMesh(f"there is no mesh file {path}; give a path relative to the design")
    suffix = path.suffix.lower().lstrip(".")
    if suffix not in set(trimesh.exchange.load.mesh_formats()):
        raise InvalidMesh(f"{path.name} is not a mesh file that can be read here; give .obj, .ply, .stl, .off or .glb")
    size = path.stat().st_size
    if size == 0:
        raise InvalidMesh(f"{path.name} is empty")
    if size > MAX_BYTES:
        raise InvalidMesh(f"{path.name} has {size / 1e6:.0f} MB, more than the {MAX_BYTES / 1e6:.0f} MB that plisse "
                          "takes; decimate it first")


def _load(path: Path) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and triangles of all meshes in the file, with the transformations of a scene applied."""
    import trimesh

    try:
        with _silence():
            source, kind = _source(path)
            pieces = trimesh.load_scene(source, file_type=kind, process=False, skip_materials=True).dump()
    except Exception as error:  # trimesh's readers raise whatever the bytes provoke
        raise InvalidMesh(f"{path.name} does not hold a mesh ({_reason(error)})") from None
    meshes = [piece for piece in pieces if isinstance(piece, trimesh.Trimesh) and len(piece.faces)]
    if not meshes:
        raise InvalidMesh(f"{path.name} holds {_contents(pieces)}no faces; give a surface of triangles or quads")
    offsets = np.cumsum([0] + [len(mesh.vertices) for mesh in meshes[:-1]])
    return (np.concatenate([np.asarray(mesh.vertices, dtype=float) for mesh in meshes]),
            np.concatenate([np.asarray(mesh.faces) + offset for mesh, offset in zip(meshes, offsets, strict=True)]))


def _source(path: Path) -> tuple[str | BytesIO, str]:
    """What trimesh shall read, and its format; text with accents in an old encoding is turned into UTF-8."""
    kind = path.suffix.lower().lstrip(".")
    if kind in ("obj", "off"):
        data = path.read_bytes()
        try:
            data.decode()
        except UnicodeDecodeError:
            if b"\0" in data:
                raise
            return BytesIO(data.decode("latin-1").encode()), kind
    return str(path), kind


def _reason(error: Exception) -> str:
    """What a reader's exception means to the person who gave the file."""
    name = getattr(error, "name", None)
    if isinstance(error, ModuleNotFoundError) and name != "charset_normalizer":
        return f"reading this format needs the Python package {name}; .obj, .ply, .stl, .off and .glb need none"
    if isinstance(error, (UnicodeError, ModuleNotFoundError)):
        return "its bytes are not those of such a file"
    if isinstance(error, (LookupError, AttributeError, TypeError)):
        return "it is incomplete or refers to something that is not there"
    return " ".join(str(error).split())[:120] or type(error).__name__


def _contents(pieces: list) -> str:
    names = {"PointCloud": "points", "Path3D": "lines", "Path2D": "lines"}
    found = sorted({names.get(type(piece).__name__, "vertices") for piece in pieces})
    return " and ".join(found) + " but " if found else ""


@contextmanager
def _silence() -> Iterator[None]:
    """Keep trimesh's warnings and log lines from the terminal: what matters is said by the cleaning."""
    logger = logging.getLogger("trimesh")
    before = logger.disabled
    logger.disabled = True
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield
    finally:
        logger.disabled = before

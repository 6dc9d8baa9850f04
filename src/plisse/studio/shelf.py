"""Meshes that a browser gave: data under names of our own, never under a name from the browser."""

import re
import shutil
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import msgspec

from plisse.errors import InvalidDesign, InvalidMesh
from plisse.recipe import Recipe

__all__ = ["LARGEST_MESH", "MESH_FORMATS", "Shelf"]

LARGEST_MESH = 50_000_000
MOST = 8
MESH_FORMATS = (".obj", ".ply", ".stl", ".off", ".glb")
FILE_KEYS = (("curve", "file"), ("surface", "file"), ("surface", "edited_file"), ("surface", "guide_file"))


class Shelf:
    """The mesh files that a client's designs may name; those it gave lie in a directory that `close` removes."""

    def __init__(self):
        self._paths: dict[str, Path] = {}
        self._directory: Path | None = None

    def put(self, name: str, content: bytes) -> str:
        """The name by which designs may mean an uploaded mesh; raises InvalidMesh for what is too large or no mesh file."""
        suffix = next((known for known in MESH_FORMATS if name.lower().endswith(known)), None)
        if suffix is None:
            raise InvalidMesh(f"the file is no mesh that can be read here; give {', '.join(MESH_FORMATS)}")
        if not 0 < len(content) <= LARGEST_MESH:
            raise InvalidMesh(f"the file has {len(content) / 1e6:.1f} MB; give a mesh of up to {LARGEST_MESH / 1e6:.0f} MB")
        if self._directory is None:
            self._directory = Path(tempfile.mkdtemp(prefix="plisse-studio-"))
        shown = f"{_harmless(name[:-len(suffix)])}{suffix}"
        path = self._directory / f"{len(list(self._directory.iterdir()))}{suffix}"
        path.write_bytes(content)
        self._paths.pop(shown, None)
        self._paths[shown] = path
        while len(self._paths) > MOST:
            self._paths.pop(next(iter(self._paths)))
        return shown

    def adopt(self, recipe: Recipe) -> Recipe:
        """A recipe read from the user's own disk, its mesh files on the shelf and named without their place."""
        return _with_files(recipe, self._adopted)

    def shown(self, data: dict) -> dict:
        """The same data, as read from a browser's text; raises InvalidDesign where it names files that are not here."""
        for section, key in FILE_KEYS:
            table = data.get(section)
            name = table.get(key) if isinstance(table, dict) else None
            if name is not None and not (section == "surface" and key != "guide_file" and name in self._paths):
                raise InvalidDesign(f"{section}.{key} names a file, and the studio opens none from a text; upload the mesh "
                                    "first, or start plisse studio with the design file")
        return data

    def placed(self, recipe: Recipe) -> Recipe:
        """The recipe with the places of its mesh files, to be solved."""
        return _with_files(recipe, lambda name: str(self._paths[name]))

    def path(self, name: str) -> str:
        """The place of a mesh."""
        return str(self._paths[name])

    def close(self) -> None:
        """Remove what was uploaded."""
        self._paths.clear()
        if self._directory is not None:
            shutil.rmtree(self._directory, ignore_errors=True)
            self._directory = None

    def _adopted(self, file: str) -> str:
        path = Path(file).absolute()
        self._paths[path.name] = path
        return path.name


def _with_files(recipe: Recipe, name_of: Callable[[str], str]) -> Recipe:
    """The recipe with other names for the mesh files of its surface; points of curves were taken in when it was read."""
    surface: Any = getattr(recipe, "surface", None)
    files = {key: name_of(value) for key in ("file", "edited_file") if (value := getattr(surface, key, None)) is not None}
    return msgspec.structs.replace(recipe, surface=msgspec.structs.replace(surface, **files)) if files else recipe


def _harmless(name: str) -> str:
    """A short file name without anything but letters and digits."""
    return re.sub(r"[^A-Za-z0-9_]+", "-", name).strip("-")[-40:] or "mesh"

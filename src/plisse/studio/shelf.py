"""Meshes that a browser gave: data under names of our own, never under a name from the browser."""

import re
import shutil
import tempfile
from collections.abc import Callable
from itertools import count
from pathlib import Path
from typing import Any

import msgspec

from plisse.errors import InvalidDesign, InvalidMesh
from plisse.recipe import Recipe

__all__ = ["LARGEST_MESH", "MESH_FORMATS", "Shelf"]

LARGEST_MESH = 50_000_000
MOST_BYTES = 10 * LARGEST_MESH
MESH_FORMATS = (".obj", ".ply", ".stl", ".off", ".glb")
FILE_KEYS = (("curve", "file"), ("surface", "file"), ("surface", "edited_file"), ("surface", "guide_file"))


class Shelf:
    """The mesh files that a client's designs may name; those it gave lie in a directory that `close` removes.

    A name that a design was let mean is that of one file for good, so that every step of a desk can be gone back to.
    An upload that became no design is given up by the next.
    """

    def __init__(self):
        self._paths: dict[str, Path] = {}
        self._meant: set[str] = set()
        self._numbers = count()
        self._directory: Path | None = None

    def put(self, name: str, content: bytes) -> str:
        """The name by which designs may mean an uploaded mesh, with a number where another mesh has its name.

        Raises InvalidMesh for what is no mesh file, too large, or more than is kept.
        """
        suffix = next((known for known in MESH_FORMATS if name.lower().endswith(known)), None)
        if suffix is None:
            raise InvalidMesh(f"the file is no mesh that can be read here; give {', '.join(MESH_FORMATS)}")
        if not 0 < len(content) <= LARGEST_MESH:
            raise InvalidMesh(f"the file has {len(content) / 1e6:.1f} MB; give a mesh of up to {LARGEST_MESH / 1e6:.0f} MB")
        for idle in self._paths.keys() - self._meant:
            self._paths.pop(idle).unlink(missing_ok=True)
        shown = self._name(_harmless(name[:-len(suffix)]), suffix,
                           lambda path: path.parent == self._directory and path.read_bytes() == content)
        if shown not in self._paths:
            self._paths[shown] = self._kept(content, suffix)
        return shown

    def adopt(self, recipe: Recipe) -> Recipe:
        """A recipe read from the user's own disk, its mesh files on the shelf and named without their place."""
        return _with_files(recipe, self._adopted)

    def shown(self, data: dict) -> dict:
        """The same data, as read from a browser's text; raises InvalidDesign where it names files that are not here."""
        for section, key in FILE_KEYS:
            table = data.get(section)
            name = table.get(key) if isinstance(table, dict) else None
            if name is not None and not (section == "surface" and key != "guide_file" and str(name) in self._paths):
                raise InvalidDesign(f"{section}.{key} names a file, and the studio opens none from a text; upload the mesh "
                                    "first, or start plisse studio with the design file")
            if name is not None:
                self._meant.add(str(name))
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
        self._meant.clear()
        if self._directory is not None:
            shutil.rmtree(self._directory, ignore_errors=True)
            self._directory = None

    def _adopted(self, file: str) -> str:
        path = Path(file).absolute()
        shown = self._name(path.stem, path.suffix, lambda other: other == path)
        self._paths[shown] = path
        self._meant.add(shown)
        return shown

    def _name(self, stem: str, suffix: str, is_same: Callable[[Path], bool]) -> str:
        """The first of the names stem, stem-2, stem-3, … that means the same file or none."""
        names = (f"{stem}{suffix}" if number == 1 else f"{stem}-{number}{suffix}" for number in count(1))
        return next(name for name in names if name not in self._paths or is_same(self._paths[name]))

    def _kept(self, content: bytes, suffix: str) -> Path:
        """The file that an uploaded mesh is written to."""
        if self._directory is None:
            self._directory = Path(tempfile.mkdtemp(prefix="plisse-studio-"))
        if sum(file.stat().st_size for file in self._directory.iterdir()) + len(content) > MOST_BYTES:
            raise InvalidMesh(f"with this one the meshes of this tab have more than {MOST_BYTES / 1e6:.0f} MB, and steps "
                              "back need all others; upload it in a new tab of the studio")
        path = self._directory / f"{next(self._numbers)}{suffix}"
        path.write_bytes(content)
        return path


def _with_files(recipe: Recipe, name_of: Callable[[str], str]) -> Recipe:
    """The recipe with other names for the mesh files of its surface; points of curves were taken in when it was read."""
    surface: Any = getattr(recipe, "surface", None)
    files = {key: name_of(value) for key in ("file", "edited_file") if (value := getattr(surface, key, None)) is not None}
    return msgspec.structs.replace(recipe, surface=msgspec.structs.replace(surface, **files)) if files else recipe


def _harmless(name: str) -> str:
    """A short file name without anything but letters and digits."""
    return re.sub(r"[^A-Za-z0-9_]+", "-", name).strip("-")[-40:] or "mesh"

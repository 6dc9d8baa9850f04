"""Structures from files of any kind that can hold one."""

from pathlib import Path

from plisse.errors import InvalidStructure
from plisse.io.fold import read_fold
from plisse.io.obj import read_obj
from plisse.structure.pleated import PleatedStructure

__all__ = ["read_structure"]

READERS = {".fold": read_fold, ".json": read_fold, ".obj": read_obj}


def read_structure(path: str | Path) -> PleatedStructure:
    """The structure in a .fold or .obj file; raises InvalidStructure for other files and meshes."""
    path = Path(path)
    if path.suffix.lower() not in READERS:
        raise InvalidStructure(f"{path.name} is neither a .fold nor an .obj file; give one of these")
    return READERS[path.suffix.lower()](path)

"""Structures from files of any kind that can hold one."""

from pathlib import Path

from plisse.errors import InvalidStructure
from plisse.io.fold import load_fold
from plisse.io.model import Model
from plisse.io.obj import load_obj
from plisse.io.rhino import load_3dm
from plisse.structure.pleated import PleatedStructure

__all__ = ["read_model", "read_structure"]

READERS = {".fold": load_fold, ".json": load_fold, ".obj": load_obj, ".3dm": load_3dm}


def read_structure(path: str | Path) -> PleatedStructure:
    """The structure in a .fold, .obj or .3dm file; raises InvalidStructure for other files and meshes."""
    return read_model(path).structure


def read_model(path: str | Path) -> Model:
    """The structure in a file with its unit and title; the file's name where it has no title."""
    path = Path(path)
    if path.suffix.lower() not in READERS:
        raise InvalidStructure(f"{path.name} is neither a .fold nor an .obj or .3dm file; give one of these")
    model = READERS[path.suffix.lower()](path)
    return model if model.title else Model(model.structure, model.units, path.stem)

"""Designs that come with the package, found by name."""

import difflib
import re
from importlib.resources import files
from pathlib import Path

from plisse.errors import InvalidDesign

__all__ = ["description", "find_design", "shipped_design", "shipped_names"]


def shipped_names() -> list[str]:
    """Names of all shipped designs, numbers in them in their natural order."""
    folder = files("plisse") / "gallery"
    names = [entry.name[:-5] for entry in folder.iterdir() if entry.name.endswith(".toml")]
    return sorted(names, key=_natural)


def _natural(name: str) -> list[int | str]:
    return [int(part) if part.isdigit() else part for part in re.split(r"(\d+)", name)]


def shipped_design(name: str) -> Path:
    """File of the shipped design of that name; raises InvalidDesign with similar names when there is none."""
    if name not in shipped_names():
        raise InvalidDesign(f"there is no design {name} in the gallery; {_suggestion(name)}")
    return Path(str(files("plisse") / "gallery" / f"{name}.toml"))


def description(name: str) -> str:
    """What the design shows: the first comment line of its file."""
    for line in shipped_design(name).read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            return line.lstrip("# ").strip()
    return ""


def find_design(argument: str) -> Path:
    """The design file meant by a path or a gallery name; raises InvalidDesign when there is neither.

    A directory of that name is no obstacle: `plisse make fig01d` makes one.
    """
    path = Path(argument)
    if path.is_file():
        return path
    if argument in shipped_names():
        return shipped_design(argument)
    if path.is_dir():
        raise InvalidDesign(f"{argument} is a directory; give a design file or a name from `plisse gallery`")
    raise InvalidDesign(f"there is no file {argument} and no design of that name in the gallery; "
                        f"{_suggestion(path.stem)}")


def _suggestion(name: str) -> str:
    close = difflib.get_close_matches(name, shipped_names(), n=3, cutoff=0.5)
    return f"did you mean {' or '.join(close)}?" if close else "`plisse gallery` lists the names"

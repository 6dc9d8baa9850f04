"""STUDY.toml: a base design, the keys to vary, limits, and what to show at the end."""

import tomllib
from pathlib import Path
from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from plisse.errors import InvalidDesign
from plisse.io.mistakes import hint, refuse_non_finite
from plisse.recipe.fields import Strict
from plisse.shipped import shipped_design, shipped_names
from plisse.study.wording import expected

__all__ = ["Limits", "Map", "Plan", "read_plan"]

By = Annotated[Literal["regularity", "deviation", "opening", "sheet_area"],
               Meta(description="regularity, deviation, opening or sheet_area")]
GIB = 2**30


class Limits(Strict, kw_only=True, frozen=True):
    """What one design may cost: seconds, and memory in GiB beyond that of the program itself."""

    seconds: Annotated[float, Meta(gt=0, le=1e7, description="seconds above 0")] = 300.0
    memory: Annotated[float, Meta(ge=0.01, le=1e5, description="GiB from 0.01")] = 4.0

    @property
    def bytes(self) -> int:
        """The memory limit in bytes."""
        return int(self.memory * GIB)


class Map(Strict, kw_only=True, frozen=True):
    """Axes of the map of the feasible region: two keys, and a third one that gets a panel for each of its values."""

    keys: Annotated[list[str], Meta(min_length=2, max_length=2, description="two varied keys")]
    panels: Annotated[str, Meta(description="a varied key")] | None = None


class Plan(Strict, kw_only=True, frozen=True):
    """A study as its file says it; `folder` is where file names in it start.

    `vary` are blocks of dotted keys of a design, each with a list of values, a range (start, stop, count), or bounds
    (low, high) between which the block's `samples` are drawn.
    """

    base: Annotated[str | dict, Meta(description="a design file, a gallery name, or a table")]
    vary: Annotated[dict | list[dict], Meta(description="a table of keys and values, or several as [[vary]]")]
    limits: Limits = msgspec.field(default_factory=Limits)
    map: Map | None = None
    by: By = "regularity"
    forecast: Annotated[bool, Meta(description="true or false")] = False
    folder: str = "."

    @property
    def blocks(self) -> list[dict]:
        """The tables of varied keys, one or several."""
        return [self.vary] if isinstance(self.vary, dict) else self.vary


def read_plan(source: str | Path | dict) -> Plan:
    """The checked study of a TOML file or dictionary, with the base design read in.

    Raises InvalidDesign with the key, what was found and what to do.
    """
    if not isinstance(source, dict | str | Path):
        raise InvalidDesign(f"a study is {source!r}; give a dictionary or the path of a TOML file")
    folder = Path(source).parent.absolute() if not isinstance(source, dict) else Path.cwd()
    data = source if isinstance(source, dict) else _toml(Path(source), "a study file")
    refuse_non_finite(data)
    if "folder" in data:
        raise InvalidDesign(_said("unknown field `folder`"))
    try:
        plan = msgspec.convert({**data, "folder": str(folder)}, Plan)
    except msgspec.ValidationError as error:
        raise InvalidDesign(f"the study cannot be read: {_said(str(error))}") from None
    if isinstance(plan.base, dict):
        return plan
    path = _base_file(folder, plan.base)
    return msgspec.structs.replace(plan, base=_toml(path, "a design file"), folder=str(path.parent.absolute()))


def _base_file(folder: Path, name: str) -> Path:
    if (folder / name).is_file():
        return folder / name
    if name in shipped_names():
        return shipped_design(name)
    raise InvalidDesign(f"base is {name!r}, but there is no such file beside the study and no such design in the gallery; "
                        "`plisse gallery` lists the names")


def _toml(path: Path, what: str) -> dict:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except FileNotFoundError:
        raise InvalidDesign(f"there is no file {path}; give {what} (TOML)") from None
    except (OSError, UnicodeDecodeError):
        raise InvalidDesign(f"{path} cannot be read as text; give {what} (TOML)") from None
    except (tomllib.TOMLDecodeError, RecursionError) as error:
        raise InvalidDesign(f"{path} is not valid TOML: {error}; mend that line") from None


def _said(message: str) -> str:
    """One sentence with the key from a validation message `what - at `$.path``."""
    what, _, where = message.partition(" - at `$")
    path = where.rstrip("`").lstrip(".")
    structs: dict[str, type[msgspec.Struct]] = {"limits": Limits, "map": Map}
    struct = structs.get(path.split(".")[0], Plan)
    known = [name for name in struct.__struct_fields__ if name != "folder"]
    if "unknown field" in what or "missing required field" in what:
        key = ".".join(part for part in (path, what.split("`")[1]) if part)
        verb = "is missing" if "missing" in what else "is not a key of a study"
        return f"{key} {verb}; known here: {', '.join(known)}"
    wanted = hint(struct, path.split(".")[-1].split("[")[0])
    return f"{path}: {expected(what)}" + (f"; give {wanted}" if wanted else "")

"""What of a design can be set by a control: keys, units and limits, read from the types of the recipe."""

import math
import re
import tomllib
from dataclasses import dataclass, field
from typing import Literal

import msgspec
from msgspec import inspect

from plisse.errors import InvalidDesign
from plisse.io.toml import toml_text
from plisse.recipe import Recipe
from plisse.studio.series import SERIES, series_of
from plisse.studio.words import TITLES, Words, words_of

__all__ = ["DIGITS", "Field", "fields_of", "list_text", "value_of_text"]

LEFT_OUT = {"curve.points", "curve.file", "surface.file", "surface.height", "surface.radius", "surface.torus", "surface.x",
            "surface.y", "surface.guide", "surface.guide_file", "surface.handles", "surface.edited_file", "solve.weights",
            "solve.iterations", "surface.guide_section", "parallel.moves"}
DIGITS = 6  # after the point, in what is typed: it may be finer than a step
NARROW, MOST_CREASES, FARTHEST = 10.0, 40, 1e9
NUMBERS = inspect.FloatType | inspect.IntType
UNITS = ((r"degrees", "°"), (r"percent", "%"), (r"model units|\bone length", "unit"))


@dataclass(frozen=True)
class Field:
    """A control: `key` as `plisse.Session.update` takes it, its label, kind, value and limits, and what else is said."""

    key: str
    label: str
    kind: Literal["slider", "whole", "number", "switch", "choice", "list"]
    value: object
    low: float | None = None
    high: float | None = None
    step: float | None = None
    choices: tuple[str, ...] = ()
    words: Words = field(default_factory=lambda: Words(""))

    @property
    def section(self) -> str:
        """The section of the design that it belongs to."""
        return self.key.partition(".")[0]

    @property
    def shown(self) -> object:
        """The value as the control shows it."""
        return self.words.choices.get(str(self.value), self.value) if self.kind == "choice" else self.value

    @property
    def shown_choices(self) -> tuple[str, ...]:
        """The choices as the control shows them."""
        return tuple(self.words.choices.get(choice, choice) for choice in self.choices)

    def meant(self, shown: object) -> object:
        """The value that something in the control means; raises InvalidDesign for texts that are no numbers."""
        if self.kind == "choice":
            return dict(zip(self.shown_choices, self.choices, strict=True)).get(str(shown), shown)
        return value_of_text(str(shown)) if self.kind == "list" else shown


def fields_of(recipe: Recipe) -> list[Field]:
    """All controls for a recipe, section by section; keys that are not set and have no default are left out."""
    found: list[Field | None] = []
    for section in TITLES:
        struct = getattr(recipe, section, None)
        if struct is None:
            continue
        info = inspect.type_info(type(struct))
        assert isinstance(info, inspect.StructType)
        for entry in info.fields:
            key, value = f"{section}.{entry.name}", getattr(struct, entry.name)
            has_rows = key in SERIES and isinstance(value, list) and series_of(recipe, key) is not None
            if key not in LEFT_OUT and not has_rows and value is not None and not isinstance(value, msgspec.Struct):
                found.append(_field(key, value, entry.type, recipe.units))
    return [field for field in found if field is not None]


def value_of_text(text: str) -> object:
    """The value that a text means in TOML, numbers and lists only; raises InvalidDesign for anything else."""
    try:
        value = tomllib.loads(f"value = {' '.join(text.split())}")["value"]
    except (tomllib.TOMLDecodeError, RecursionError):
        value = None
    if isinstance(value, bool) or not isinstance(value, int | float | list):
        raise InvalidDesign(f"{text[:60]!r} is neither a number nor a list; give for example 30 or [30, 35, 40]")
    return value


def list_text(values) -> str:
    """A list as TOML, in one line."""
    return re.sub(r"\.0\b", "", toml_text({"v": values}).partition(" = ")[2].strip())


def _field(key: str, value, kind: inspect.Type, units: str) -> Field | None:
    words, unit = words_of(key), _unit(kind, units)
    label = f"{words.label} ({unit})" if unit and not isinstance(value, bool | str) else words.label
    if isinstance(value, bool):
        return Field(key, label, "switch", value, words=words)
    if isinstance(value, str):
        choices = _choices(kind)
        return Field(key, label, "choice", value, choices=choices, words=words) if choices else None
    if isinstance(value, list | tuple):
        each = ", one by one" if any(isinstance(part, NUMBERS) for part in _parts(kind)) else " (x, y, z)"
        return Field(key, label + each, "list", list_text(value[0] if len(value) == 1 else list(value)), words=words)
    return _number(key, label, value, kind, words)


def _number(key: str, label: str, value: float, kind: inspect.Type, words: Words) -> Field:
    choices = _choices(kind)
    if choices:
        return Field(key, label, "whole", value, int(choices[0]), int(choices[-1]), 1, words=words)
    low, high = _limits(kind)
    if isinstance(value, int) and _is_whole(kind):
        if key.endswith(".samples"):
            return Field(key, label, "number", value, low, high, 1, words=words)
        return Field(key, label, "whole", value, low, max(MOST_CREASES, 2 * value), 1, words=words)
    value = float(value)
    if "°" not in label and value != 0 and high - low > NARROW * abs(value):
        most = 4 * abs(value)
        low, high = max(low, abs(value) / 4 if low > 0 else -most), min(high, most)
    return Field(key, label, "slider", value, low, high, _step(high - low), words=words)


def _unit(kind: inspect.Type, units: str) -> str:
    """The unit that the type of a number speaks of; empty for none."""
    said = " ".join(str((node.extra_json_schema or {}).get("description", "")) for node in _metadata(kind))
    return next((unit for pattern, unit in UNITS if re.search(pattern, said)), "").replace("unit", units)


def _step(span: float) -> float:
    """A round step of about a five-hundredth of the span."""
    power = 10.0 ** math.floor(math.log10(span / 500))
    return next(power * step for step in (1, 2, 5, 10) if power * step >= span / 500)


def _metadata(kind: inspect.Type) -> list[inspect.Metadata]:
    if isinstance(kind, inspect.Metadata):
        return [kind, *_metadata(kind.type)]
    return [node for entry in kind.types for node in _metadata(entry)] if isinstance(kind, inspect.UnionType) else []


def _parts(kind: inspect.Type) -> list[inspect.Type]:
    if isinstance(kind, inspect.Metadata):
        return _parts(kind.type)
    return [part for entry in kind.types for part in _parts(entry)] if isinstance(kind, inspect.UnionType) else [kind]


def _is_whole(kind: inspect.Type) -> bool:
    parts = _parts(kind)
    return any(isinstance(part, inspect.IntType) for part in parts) \
        and not any(isinstance(part, inspect.FloatType) for part in parts)


def _limits(kind: inspect.Type) -> tuple[float, float]:
    """Smallest and largest number that the type allows, a little inside of limits that are excluded."""
    for part in _parts(kind):
        if isinstance(part, NUMBERS):
            low, high = (part.gt if part.ge is None else part.ge), (part.lt if part.le is None else part.le)
            least, most = -FARTHEST if low is None else float(low), FARTHEST if high is None else float(high)
            inside = min(0.5, 10.0 ** math.floor(math.log10(0.01 * (most - least))))
            return least + inside * (part.gt is not None), most - inside * (part.lt is not None)
    return -FARTHEST, FARTHEST


def _choices(kind: inspect.Type) -> tuple[str, ...]:
    return tuple(str(value) for part in _parts(kind) if isinstance(part, inspect.LiteralType) for value in part.values)

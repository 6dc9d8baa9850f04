"""One sentence for a value of the wrong kind: the key, what was found, and what to give instead."""

import math
import re

import msgspec

from plisse.errors import InvalidDesign
from plisse.recipe import (
    AsymptoticDesign,
    AsymptoticPattern,
    AsymptoticSurface,
    ClosedForm,
    Curve,
    Design,
    March,
    Move,
    Parallel,
    Pattern,
    Pull,
    Section,
    Solve,
    Strips,
    Surface,
    SurfaceDesign,
    SurfacePattern,
    WeierstrassData,
)

__all__ = ["WORDS", "hint", "is_asymptotic", "refuse_non_finite", "sentence"]

SECTIONS = {"": Design, "pattern": Pattern, "march": March, "solve": Solve, "parallel": Parallel,
            "strips": Strips}
SURFACE_SECTIONS = {"": SurfaceDesign, "surface": Surface, "pattern": SurfacePattern, "solve": Solve,
                    "strips": Strips}
ASYMPTOTIC_SECTIONS = {"": AsymptoticDesign, "surface": AsymptoticSurface, "pattern": AsymptoticPattern}
TABLES = {"surface.weierstrass": WeierstrassData, "surface.guide_section": Section, "surface.handles": Pull,
          "parallel.moves": Move}
OUT_OF_RANGE = ("invalid enum value", "expected `float` ", "expected `int` ")
WORDS = {"float": "a number", "int": "a whole number", "str": "text", "bool": "true or false", "array": "a list",
         "object": "a table"}
KINDS = {"curve": Curve, "closed_form": ClosedForm}


def is_asymptotic(data: dict) -> bool:
    """Whether a design in dictionaries asks for pleats along asymptotic curves: its surface has a `kind`."""
    return isinstance(data.get("surface"), dict) and "kind" in data["surface"]


def refuse_non_finite(value: object, path: str = "") -> None:
    """Raise InvalidDesign for the first nan, infinity or absurd integer in nested dictionaries and lists."""
    if isinstance(value, dict):
        for key, item in value.items():
            refuse_non_finite(item, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for k, item in enumerate(value):
            refuse_non_finite(item, f"{path}[{k}]")
    elif isinstance(value, float) and not math.isfinite(value):
        raise InvalidDesign(f"{path} is {value}; give a finite number")
    elif isinstance(value, int) and abs(value) > 2**53:
        raise InvalidDesign(f"{path} is {value}; give a number of sensible size")


def sentence(message: str, data: dict) -> str:
    """One sentence from a validation message `what - at `$.path``."""
    what, _, where = message.partition(" - at `$")
    path = where.rstrip("`").lstrip(".").removesuffix("[...]")
    what = what[0].lower() + what[1:].replace(" | null", "")
    if match := re.match(r"object contains unknown field `(.*)`", what):
        key = f"{path}.{match[1]}" if path else match[1]
        known = _known_keys(path, data)
        return f"{key} is not a key of a design; known {'here' if path else 'sections'}: {', '.join(known)}"
    if match := re.match(r"object missing required field `(.*)`", what):
        key = f"{path}.{match[1]}" if path else match[1]
        wanted = _wanted(key, data)
        return f"{key} is missing; add it" + (f" ({wanted})" if wanted else "")
    wanted = _wanted(path, data)
    found = _lookup(data, path)
    if wanted and what.startswith(OUT_OF_RANGE) and not isinstance(found, dict | list):
        return f"{path} is {found!r}; give {wanted}"
    what = re.sub(r"`(\w+)`", lambda match: WORDS.get(match[1], match[0]), what)
    shown = "" if isinstance(found, dict | list) or found is None else f", found {found!r}"
    return f"{path or 'the design'}: {what}{shown}" + (f"; give {wanted}" if wanted else "")


def hint(struct: type, key: str) -> str:
    """What a key of a struct takes, from the description that its type carries; empty where there is none."""
    field = next((field for field in msgspec.structs.fields(struct) if field.name == key), None)
    return _description(msgspec.inspect.type_info(field.type)) if field else ""


def _struct_at(path: str, data: dict) -> type | None:
    section = path.split(".")[0].split("[")[0]
    if (table := TABLES.get(re.sub(r"\[.*", "", path))) is not None:
        return table
    if section not in KINDS:
        sections = ASYMPTOTIC_SECTIONS if is_asymptotic(data) else SURFACE_SECTIONS if "surface" in data else SECTIONS
        return sections.get(section)
    entry = data.get(section)
    kind = entry.get("kind") if isinstance(entry, dict) else None
    return next((c for c in KINDS[section].__args__ if c.__struct_config__.tag == kind), None)


def _known_keys(path: str, data: dict) -> list[str]:
    struct = _struct_at(path, data)
    if struct is None:
        return _kinds(path)
    return (["kind"] if path in KINDS else []) + [field.name for field in msgspec.structs.fields(struct)]


def _kinds(path: str) -> list[str]:
    return [str(c.__struct_config__.tag) for c in KINDS[path.split(".")[0]].__args__]


def _wanted(path: str, data: dict) -> str:
    """What the key at a path takes."""
    if path.removesuffix(".kind") in KINDS:
        return "kind = one of " + ", ".join(_kinds(path))
    section, _, key = re.sub(r"\[.*?\]", "", path).rpartition(".")
    struct = _struct_at(section, data)
    return "" if struct is None else hint(struct, key)


def _description(info: msgspec.inspect.Type) -> str:
    if isinstance(info, msgspec.inspect.Metadata):
        return (info.extra_json_schema or {}).get("description", "") or _description(info.type)
    if isinstance(info, msgspec.inspect.UnionType):
        return next((text for text in map(_description, info.types) if text), "")
    return "true or false" if isinstance(info, msgspec.inspect.BoolType) else ""


def _lookup(data: object, path: str) -> object:
    for key in re.findall(r"[^.\[\]]+", path):
        if isinstance(data, dict):
            data = data.get(key)
        elif isinstance(data, list) and key.isdigit() and int(key) < len(data):
            data = data[int(key)]
        else:
            return None
    return data

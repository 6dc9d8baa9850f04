"""DESIGN.toml: reading, overriding and checking recipes, with one sentence for every mistake."""

import math
import re
import tomllib
from collections.abc import Iterable
from itertools import pairwise
from pathlib import Path

import msgspec

from plisse.errors import InvalidDesign
from plisse.io.polylines import read_polyline
from plisse.recipe import Arc, ClosedForm, Curve, Design, Ellipse, Helix, Pattern, Points, Solve, Spline, TorusKnot

__all__ = ["design_from_dict", "parse_assignment", "read_design"]

MAX_VERTICES = 250_000


def read_design(path: str | Path, overrides: Iterable[str] = ()) -> Design:
    """The design in a TOML file, with `section.key=value` overrides applied.

    Curve files are found beside the design and their points taken into it, so that the design stands alone.
    Raises InvalidDesign with the key, what was found and what to do.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InvalidDesign(f"there is no file {path}; give a design file or a name that `plisse gallery` lists") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidDesign(f"{path} cannot be read as text ({_reason(error)}); give a TOML file") from None
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InvalidDesign(f"{path} is not valid TOML: {error}; mend that line") from None
    for override in overrides:
        keys, value = parse_assignment(override)
        _assign(data, keys, value)
    return design_from_dict(data, base=path.parent)


def design_from_dict(data: dict, base: str | Path = ".") -> Design:
    """The checked design in nested dictionaries as TOML holds them; file names are relative to `base`."""
    _refuse_non_finite(data, "")
    try:
        design = msgspec.convert(data, Design)
    except msgspec.ValidationError as error:
        raise InvalidDesign(_sentence(str(error), data)) from None
    return check_design(_with_points(design, Path(base)))


def check_design(design: Design) -> Design:
    """The same design; raises InvalidDesign where its numbers contradict each other."""
    if design.closed_form is not None:
        if design.curve is not None or design.pattern is not None:
            raise InvalidDesign("a design has either closed_form or curve and pattern, but this one has both; remove one")
        _check_size("closed_form", design.closed_form)
        return design
    if design.curve is None or design.pattern is None:
        section = "curve" if design.curve is None else "pattern"
        raise InvalidDesign(f"{section} is missing; add a [{section}] section, as `plisse gallery fig01d` shows")
    _check_size("pattern", design.pattern)
    _check_pattern(design.pattern)
    if design.curve.closed and design.pattern.samples < 5:
        raise InvalidDesign(f"pattern.samples is {design.pattern.samples}, too few for a closed curve; give at least 5")
    if design.solve.cut is not None and not design.curve.closed:
        raise InvalidDesign("solve.cut is set, but the curve is open and needs no cut; remove it or set curve.closed")
    _check_curve(design.curve)
    return design


def _check_size(section: str, grid: Pattern | ClosedForm) -> None:
    vertices = grid.creases * grid.samples
    if vertices > MAX_VERTICES:
        raise InvalidDesign(f"{section}.creases × {section}.samples = {vertices} vertices is more than plisse solves "
                            f"({MAX_VERTICES}, about a minute and 2 GB); lower {section}.samples")


def _check_pattern(pattern: Pattern) -> None:
    if isinstance(pattern.theta, list) and len(pattern.theta) != pattern.creases:
        raise InvalidDesign(f"pattern.theta has {len(pattern.theta)} values, but pattern.creases is "
                            f"{pattern.creases}; give one value, or one per crease")
    _check_width(pattern.width, pattern.creases)


def _check_curve(curve: Curve) -> None:
    if isinstance(curve, Spline | Points):
        _check_points(curve)
    elif isinstance(curve, Helix) and curve.closed:
        raise InvalidDesign("curve.closed is true, but a helix never closes; set curve.closed = false")
    elif isinstance(curve, Arc | Ellipse) and curve.closed and curve.angle < 360:
        raise InvalidDesign(f"curve.angle is {curve.angle} degrees, but curve.closed asks for a closed curve; "
                            "set curve.closed = false or curve.angle = 360")
    elif isinstance(curve, TorusKnot) and math.gcd(curve.p, curve.q) != 1:
        raise InvalidDesign(f"curve.p = {curve.p} and curve.q = {curve.q} have a common divisor, so the torus knot "
                            "would run over itself; give numbers without one")
    elif isinstance(curve, TorusKnot) and curve.r >= curve.R:
        raise InvalidDesign(f"curve.r = {curve.r} is not smaller than curve.R = {curve.R}; give a thinner tube")


def parse_assignment(text: str) -> tuple[list[str], object]:
    """Keys and value of `section.key=value`; values are TOML, bare words are strings."""
    name, equals, value = text.partition("=")
    keys = name.strip().split(".")
    if not equals or not all(keys):
        raise InvalidDesign(f"--set {text} is not of the form section.key=value, for example pattern.theta=30")
    try:
        return keys, tomllib.loads(f"value = {value.strip()}")["value"]
    except tomllib.TOMLDecodeError:
        return keys, value.strip()


def _assign(data: dict, keys: list[str], value: object) -> None:
    for key in keys[:-1]:
        data = data.setdefault(key, {})
        if not isinstance(data, dict):
            raise InvalidDesign(f"--set {'.'.join(keys)} goes through {key}, which is a value and not a section")
    data[keys[-1]] = value


def _with_points(design: Design, base: Path) -> Design:
    curve = design.curve
    if not isinstance(curve, Spline | Points):
        return design
    if (curve.points is None) == (curve.file is None):
        both = "both curve.points and curve.file" if curve.points is not None else "neither curve.points nor curve.file"
        raise InvalidDesign(f"a {_kind(curve)} needs points, but {both} is given; give one of them")
    if curve.file is None:
        return design
    points = read_polyline(base / curve.file)
    return msgspec.structs.replace(design, curve=msgspec.structs.replace(curve, points=points.tolist(), file=None))


def _check_points(curve: Spline | Points) -> None:
    points = curve.points or []
    least = 4 if curve.closed else 3
    if len(points) < least:
        raise InvalidDesign(f"curve.points has {len(points)} points; give at least {least}")
    if len(points) > 100_000:
        raise InvalidDesign(f"curve.points has {len(points)} points; give at most 100000")
    last = len(points) if curve.closed and points[0] != points[-1] else len(points) - 1
    for i in range(last):
        j = (i + 1) % len(points)
        if points[i] == points[j]:
            raise InvalidDesign(f"curve.points[{i}] and curve.points[{j}] are the same point {points[i]}; remove one")
    size = max(max(p[k] for p in points) - min(p[k] for p in points) for k in range(3))
    largest = max(abs(x) for p in points for x in p)
    if largest > 1e12 or size < 1e-9 * largest or size < 1e-12:
        raise InvalidDesign(f"curve.points span {size:g} model units at coordinates up to {largest:g}; "
                            "that is lost in rounding, so scale or move the curve")


def _check_width(width: object, creases: int) -> None:
    if not isinstance(width, list):
        return
    tables = [isinstance(entry, list) for entry in width]
    if any(tables) and not all(tables):
        raise InvalidDesign("pattern.width mixes lengths and [position, width] rows; give one kind")
    if not all(tables) or not width:
        if len(width) != creases - 1:
            raise InvalidDesign(f"pattern.width has {len(width)} values, but {creases} creases have {creases - 1} "
                                "strips between them; give one value, one per strip, or a table [[position, width], …]")
        return
    for k, row in enumerate(width):
        if len(row) != 2 or row[1] <= 0 or not 0 <= row[0] <= 1:
            raise InvalidDesign(f"pattern.width[{k}] is {row}; give [position from 0 to 1 along the curve, width above 0]")
    positions = [row[0] for row in width]
    if len(width) < 2 or any(b <= a for a, b in pairwise(positions)):
        raise InvalidDesign(f"pattern.width has the positions {positions}; give at least two, in increasing order")


def _refuse_non_finite(value: object, path: str) -> None:
    if isinstance(value, dict):
        for key, item in value.items():
            _refuse_non_finite(item, f"{path}.{key}" if path else str(key))
    elif isinstance(value, list):
        for k, item in enumerate(value):
            _refuse_non_finite(item, f"{path}[{k}]")
    elif isinstance(value, float) and not math.isfinite(value):
        raise InvalidDesign(f"{path} is {value}; give a finite number")
    elif isinstance(value, int) and abs(value) > 2**53:
        raise InvalidDesign(f"{path} is {value}; give a number of sensible size")


def _sentence(message: str, data: dict) -> str:
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
        hint = _hint(key, data)
        return f"{key} is missing; add it" + (f" ({hint})" if hint else "")
    hint = _hint(path, data)
    found = _lookup(data, path)
    shown = "" if isinstance(found, dict | list) or found is None else f", found {found!r}"
    return f"{path or 'the design'}: {what}{shown}" + (f"; give {hint}" if hint else "")


SECTIONS = {"": Design, "pattern": Pattern, "solve": Solve}
KINDS = {"curve": Curve, "closed_form": ClosedForm}


def _struct_at(path: str, data: dict) -> type | None:
    section = path.split(".")[0].split("[")[0]
    if section not in KINDS:
        return SECTIONS.get(section)
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


def _hint(path: str, data: dict) -> str:
    """What the key wants, from the description that its type carries."""
    if path.removesuffix(".kind") in KINDS:
        return "kind = one of " + ", ".join(_kinds(path))
    section, _, key = re.sub(r"\[.*", "", path).partition(".")
    struct = _struct_at(section if key else "", data)
    if struct is None:
        return ""
    field = next((f for f in msgspec.structs.fields(struct) if f.name == (key or section)), None)
    return _description(msgspec.inspect.type_info(field.type)) if field else ""


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


def _kind(curve: Spline | Points) -> str:
    return str(type(curve).__struct_config__.tag)


def _reason(error: Exception) -> str:
    return error.strerror or type(error).__name__ if isinstance(error, OSError) else "it is not UTF-8"

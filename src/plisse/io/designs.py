"""DESIGN.toml: reading, overriding and checking recipes, with one sentence for every mistake."""

import tomllib
from collections.abc import Iterable
from pathlib import Path

import msgspec

from plisse.errors import InvalidDesign
from plisse.io.asymptotic_consistency import check_asymptotic_design
from plisse.io.consistency import check_design
from plisse.io.mistakes import is_asymptotic, refuse_non_finite, sentence
from plisse.io.polylines import read_polyline
from plisse.io.surface_consistency import check_surface_design
from plisse.recipe import AsymptoticDesign, Design, Points, Recipe, Spline, SurfaceDesign

__all__ = ["checked_design", "design_from_dict", "parse_assignment", "read_design", "section_from_options"]


def checked_design(recipe: Recipe | dict | str | Path) -> Recipe:
    """The checked design meant by a recipe, nested dictionaries, or the path of a file; raises InvalidDesign."""
    if isinstance(recipe, str | Path):
        return read_design(recipe)
    # recipes made in Python are not validated before
    return design_from_dict(recipe if isinstance(recipe, dict) else recipe.to_dict())


def read_design(path: str | Path, overrides: Iterable[str] = ()) -> Recipe:
    """The design in a TOML file, with `section.key=value` overrides applied.

    Curve files are found beside the design and their points taken into it, so that the design stands alone.
    Raises InvalidDesign with the key, what was found and what to do.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except FileNotFoundError:
        raise InvalidDesign(f"there is no file {path}; give a design file or a name that `plisse gallery` lists") from None
    except (OSError, UnicodeDecodeError) as error:
        raise InvalidDesign(f"{path} cannot be read as text ({_reason(error)}); give a TOML file") from None
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise InvalidDesign(f"{path} is not valid TOML: {error}; mend that line") from None
    except RecursionError:
        raise InvalidDesign(f"{path} nests lists or tables too deeply; a design needs two levels") from None
    for override in overrides:
        keys, value = parse_assignment(override)
        _assign(data, keys, value)
    return design_from_dict(data, base=path.parent)


def design_from_dict(data: dict, base: str | Path = ".") -> Recipe:
    """The checked design in nested dictionaries as TOML holds them; file names are relative to `base`.

    A `surface` section makes it the design of a reconstruction, one with a `kind` that of pleats along asymptotic curves.
    """
    data = _with_curve_kind(_plain(data))
    refuse_non_finite(data)
    if "march" in data and "pattern" in data:
        raise InvalidDesign("designs with [march] take no [pattern]: creases are marched from the curve by the numbers of "
                            "[march]; remove one of both sections")
    try:
        if is_asymptotic(data):
            return _with_its_mesh(check_asymptotic_design(msgspec.convert(data, AsymptoticDesign)), Path(base))
        if "surface" in data:
            design = check_surface_design(msgspec.convert(data, SurfaceDesign))
            return _with_guide(_with_mesh(design, Path(base)), Path(base))
        curved = msgspec.convert(data, Design)
    except msgspec.ValidationError as error:
        raise InvalidDesign(sentence(str(error), data)) from None
    return check_design(_with_points(curved, Path(base)))


def section_from_options(name: str, options: dict):
    """The section of that name with the options that are not None; raises InvalidDesign as for a file."""
    data = {name: {key: value for key, value in options.items() if value is not None}}
    refuse_non_finite(data)
    try:
        return getattr(msgspec.convert(data, Design), name)
    except msgspec.ValidationError as error:
        raise InvalidDesign(sentence(str(error), data)) from None


def parse_assignment(text: str) -> tuple[list[str], object]:
    """Keys and value of `section.key=value`; values are TOML, bare words are strings."""
    name, equals, value = text.partition("=")
    keys = name.strip().split(".")
    if not equals or not all(keys) or len(text.splitlines()) > 1 or len(keys) > 4:
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


def _with_curve_kind(data: dict) -> dict:
    """The same design; a curve that names a file and no kind is one of measured points."""
    curve = data.get("curve")
    if not isinstance(curve, dict) or "kind" in curve or "file" not in curve:
        return data
    return {**data, "curve": {"kind": "points", **curve}}


def _plain(value):
    """The same data with NumPy arrays and numbers as lists and numbers."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    return value.tolist() if hasattr(value, "tolist") else value


def _with_mesh(design: SurfaceDesign, base: Path) -> SurfaceDesign:
    surface = design.surface
    if surface.file is None or base == Path():
        return design
    edited = None if surface.edited_file is None else str(base / surface.edited_file)
    surface = msgspec.structs.replace(surface, file=str(base / surface.file), edited_file=edited)
    return msgspec.structs.replace(design, surface=surface)


def _with_its_mesh(design: AsymptoticDesign, base: Path) -> AsymptoticDesign:
    if design.surface.file is None or base == Path():
        return design
    surface = msgspec.structs.replace(design.surface, file=str(base / design.surface.file))
    return msgspec.structs.replace(design, surface=surface)


def _with_guide(design: SurfaceDesign, base: Path) -> SurfaceDesign:
    surface = design.surface
    if surface.guide_file is None:
        return design
    points = read_polyline(base / surface.guide_file, least=3 if surface.guide_closed else 2)
    return msgspec.structs.replace(design, surface=msgspec.structs.replace(surface, guide=points.tolist(), guide_file=None))


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


def _kind(curve: Spline | Points) -> str:
    return str(type(curve).__struct_config__.tag)


def _reason(error: Exception) -> str:
    return error.strerror or type(error).__name__ if isinstance(error, OSError) else "it is not UTF-8"

"""From a plan to its designs: recipes with a key each, the same whenever and wherever they are made."""

import copy
import hashlib
from functools import lru_cache
from pathlib import Path

import msgspec

from plisse.errors import InvalidDesign, PlisseError
from plisse.io.designs import design_from_dict
from plisse.study.plan import Map, Plan
from plisse.study.ranges import MOST
from plisse.study.values import assignments, read_block

__all__ = ["Sample", "mesh_files", "samples", "value_at"]

FILES = ("file", "edited_file")
PANELS = 24


class Sample(msgspec.Struct, frozen=True):
    """One design of a study: its key, the values of the varied keys, its whole recipe, and what is wrong with it, if so."""

    key: str
    parameters: dict
    recipe: dict
    mistake: str | None = None


def samples(plan: Plan) -> list[Sample]:
    """All designs of a plan in order, equal ones once.

    Raises InvalidDesign where not a single one is possible, with the reason of the first, where there are too many, and for
    a map that cannot be drawn.
    """
    _content.cache_clear()  # meshes may have changed since
    blocks = [read_block(block) for block in plan.blocks]
    count = sum(block.designs for block in blocks)
    if count > MOST:
        raise InvalidDesign(f"vary asks for {count:,} designs; a study holds up to {MOST:,}")
    for key in {key: None for block in blocks for key in block.varied if "." not in key}:
        _require_section(plan, key)
    found: dict[str, Sample] = {}
    for block in blocks:
        for parameters in assignments(block):
            sample = _sample(plan, parameters)
            found.setdefault(sample.key, sample)
    if not found:
        raise InvalidDesign("vary is empty; add a key of a design with its values, for example pattern.theta = [20, 30]")
    if all(sample.mistake for sample in found.values()):
        raise InvalidDesign(f"no design of this study is possible; the first: {next(iter(found.values())).mistake}")
    if plan.map is not None:
        _check_map(plan.map, list(found.values()))
    return list(found.values())


def value_at(recipe: dict, key: str) -> object:
    """The value under a dotted key of nested dictionaries, None where there is none."""
    place: object = recipe
    for name in key.split("."):
        place = place.get(name) if isinstance(place, dict) else None
    return place


def mesh_files(recipe: dict) -> dict[str, str]:
    """The files that a recipe names, by their keys in its surface; all others were read with it."""
    surface = recipe.get("surface")
    return {key: surface[key] for key in FILES if surface.get(key)} if isinstance(surface, dict) else {}


def _check_map(axes: Map, found: list[Sample]) -> None:
    keys = [*axes.keys, axes.panels] if axes.panels is not None else axes.keys
    for number, key in enumerate(keys):
        if key in keys[:number]:
            raise InvalidDesign(f"map names {key} twice; give different keys")
        if all(value_at(sample.recipe, key) is None for sample in found):
            raise InvalidDesign(f"map names {key}, a key that no design of this study has; give one of "
                                f"{', '.join(found[0].parameters)}")
    count = 1 if axes.panels is None else len({repr(value_at(sample.recipe, axes.panels)) for sample in found})
    if count > PANELS:
        raise InvalidDesign(f"map.panels = {axes.panels} has {count} values, and a map up to {PANELS} panels; give another "
                            "key, or take map.panels away")


def _require_section(plan: Plan, key: str) -> None:
    """Nothing; raises InvalidDesign where one section of the base design has the key, and none is named."""
    assert isinstance(plan.base, dict)
    try:
        base = design_from_dict(plan.base, base=plan.folder).to_dict()
    except PlisseError:
        return
    sections = [name for name, section in base.items() if isinstance(section, dict) and key in section]
    if key not in base and len(sections) == 1:
        raise InvalidDesign(f"vary.{key} names no section of a design; write {sections[0]}.{key}")


def _sample(plan: Plan, parameters: dict) -> Sample:
    assert isinstance(plan.base, dict)  # a plan that was read has its base design
    data = copy.deepcopy(plan.base)
    for key, value in parameters.items():
        _assign(data, key, copy.deepcopy(value))  # tables that vary are filled in further
    try:
        recipe = design_from_dict(data, base=plan.folder).to_dict()
    except PlisseError as error:
        return Sample(_key(data), parameters, data, str(error))
    return Sample(_key(recipe), parameters, recipe)


def _assign(data: dict, key: str, value: object) -> None:
    *sections, last = key.split(".")
    for section in sections:
        data = data.setdefault(section, {})
        if not isinstance(data, dict):
            raise InvalidDesign(f"vary.{key} goes through {section}, which is a value of the base design and not a section")
    data[last] = value


def _key(recipe: dict) -> str:
    """Sixteen hexadecimal digits of a recipe: of its numbers and of the contents of files, not of where they lie."""
    if files := mesh_files(recipe):
        contents = {key: _content(path) for key, path in files.items()}
        recipe = {**recipe, "surface": {**recipe["surface"], **contents}}
    return hashlib.sha256(msgspec.json.encode(recipe, order="deterministic")).hexdigest()[:16]


@lru_cache(maxsize=256)
def _content(path: str) -> str:
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError:
        return path

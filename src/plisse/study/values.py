"""Designs of a [[vary]] table: combinations of lists and ranges, and samples between bounds."""

import math
from itertools import product
from typing import Annotated, Literal, NamedTuple

import msgspec
import numpy as np
from msgspec import Meta

from plisse.errors import InvalidDesign
from plisse.io.mistakes import hint
from plisse.recipe.fields import Strict
from plisse.study.ranges import BOUNDS, RANGE, Bounds, Count, Range, checked_bounds, checked_range, is_range
from plisse.study.wording import expected

__all__ = ["Block", "assignments", "read_block"]

Method = Annotated[Literal["latin-hypercube", "random"], Meta(description='"latin-hypercube" or "random"')]


class Drawing(Strict, kw_only=True, frozen=True):
    """How samples between bounds are drawn; what stands beside the keys of a block."""

    samples: Count | None = None
    method: Method = "latin-hypercube"
    seed: Annotated[int, Meta(ge=0, description="a whole number from 0")] = 0


class Block(NamedTuple):
    """Varied keys in their order with what they take, and how samples between bounds are drawn."""

    varied: dict[str, list | Range | Bounds]
    drawing: Drawing

    @property
    def designs(self) -> int:
        """How many designs the block asks for."""
        lengths = [value.count if isinstance(value, Range) else len(value)
                   for value in self.varied.values() if not isinstance(value, Bounds)]
        return math.prod(lengths) * (self.drawing.samples or 1)


def read_block(block: dict) -> Block:
    """The checked keys of a [[vary]] table; raises InvalidDesign with the key."""
    drawing = _converted({key: block[key] for key in Drawing.__struct_fields__ if key in block}, Drawing, "vary")
    varied = {key: _values(key, value) for key, value in _flat(block).items()}
    if not varied:
        raise InvalidDesign(f"vary names no key of a design; add one, for example pattern.theta = [20, 30] or {RANGE}")
    bounds = {key: value for key, value in varied.items() if isinstance(value, Bounds)}
    if bounds and drawing.samples is None:
        raise InvalidDesign(f"vary.{next(iter(bounds))} has bounds, but vary.samples is missing; add samples = 50")
    if drawing.samples is not None and not bounds:
        raise InvalidDesign(f"vary.samples is given, but no key has bounds; give one, for example pattern.theta = {BOUNDS}")
    return Block(varied, drawing)


def assignments(block: Block) -> list[dict[str, object]]:
    """Dictionaries {dotted key: value}, one per design of a block: all combinations of lists and ranges, each with every
    sample between bounds; the same for the same block."""
    bounds = {key: value for key, value in block.varied.items() if isinstance(value, Bounds)}
    lists = {key: value.values() if isinstance(value, Range) else value
             for key, value in block.varied.items() if not isinstance(value, Bounds)}
    drawn = _drawn(bounds, block.drawing)
    return [{key: (dict(zip(lists, combination, strict=True)) | sample)[key] for key in block.varied}
            for combination in product(*lists.values()) for sample in drawn]


def _drawn(bounds: dict[str, Bounds], drawing: Drawing) -> list[dict[str, object]]:
    """One dictionary per sample; of random samples the first ones stay when more are asked for."""
    if not bounds or drawing.samples is None:
        return [{}]
    rng = np.random.default_rng(drawing.seed)
    if drawing.method == "random":
        shares = rng.random((drawing.samples, len(bounds)))
    else:
        from scipy.stats import qmc

        shares = qmc.LatinHypercube(len(bounds), seed=rng).random(drawing.samples)
    return [{key: bound.at(share) for (key, bound), share in zip(bounds.items(), row, strict=True)}
            for row in shares.tolist()]


def _flat(block: dict, path: str = "") -> dict[str, object]:
    """Dotted keys with what stands under them, whether TOML nests them or not."""
    out: dict[str, object] = {}
    for key, value in block.items():
        if not path and key in Drawing.__struct_fields__:
            continue
        name = f"{path}.{key}" if path else key
        if isinstance(value, dict) and not is_range(value):
            out |= _flat(value, name)
        else:
            out[name] = value
    return out


def _values(key: str, value: object) -> list | Range | Bounds:
    if isinstance(value, list) and value:
        return value
    if isinstance(value, dict) and ("low" in value or "high" in value):
        return checked_bounds(key, _converted(value, Bounds, f"vary.{key}"))
    if isinstance(value, dict):
        return checked_range(key, _converted(value, Range, f"vary.{key}"))
    raise InvalidDesign(f"vary.{key} is {value!r}; give a list of values, a range {RANGE}, or bounds {BOUNDS}")


def _converted(value: dict, kind: type[msgspec.Struct], where: str):
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        what, _, path = str(error).partition(" - at `$")
        path = path.rstrip("`")
        wanted = hint(kind, path.lstrip("."))
        remedy = f"give {wanted}" if wanted else f"known here: {', '.join(kind.__struct_fields__)}"
        raise InvalidDesign(f"{where}{path}: {expected(what)}; {remedy}") from None

"""Values of varied keys: lists, ranges, and samples between bounds."""

import math
from itertools import product
from typing import Annotated, Literal

import msgspec
import numpy as np
from msgspec import Meta

from plisse.errors import InvalidDesign
from plisse.recipe.fields import Strict

__all__ = ["Bounds", "Range", "assignments"]

MOST = 1_000_000
DIGITS = 9
Count = Annotated[int, Meta(ge=1, le=MOST)]
Scale = Literal["linear", "log"]
RANGE = "{ start = 1, stop = 5, count = 3 }"
BOUNDS = "{ low = 1, high = 5 }"


class Range(Strict, kw_only=True, frozen=True):
    """`count` evenly spaced values from `start` to `stop`, both included."""

    start: float | int
    stop: float | int
    count: Count
    scale: Scale = "linear"

    def values(self) -> list[float | int]:
        """The values in their order; whole numbers where the range consists of them."""
        space = np.geomspace if self.scale == "log" else np.linspace
        values = [_short(float(value)) for value in space(self.start, self.stop, self.count)]
        whole = isinstance(self.start, int) and isinstance(self.stop, int) and all(v.is_integer() for v in values)
        return [int(value) for value in values] if whole else list(values)


class Bounds(Strict, kw_only=True, frozen=True):
    """Anything from `low` to `high`, in multiples of `step` from `low` where it is given."""

    low: float | int
    high: float | int
    step: float | int | None = None
    scale: Scale = "linear"

    def at(self, share: float) -> float | int:
        """The value that far between the bounds, `share` in 0…1; steps get equal parts of it."""
        if self.step is not None:
            count = math.floor((self.high - self.low) / self.step + 1e-9) + 1
            value = self.low + min(int(share * count), count - 1) * self.step
            return value if isinstance(value, int) else _short(value)
        if self.scale == "log":
            return _short(self.low * (self.high / self.low) ** share)
        return _short(self.low + (self.high - self.low) * share)


class Drawing(Strict, kw_only=True, frozen=True):
    """How samples between bounds are drawn; what stands beside the keys of a block."""

    samples: Count | None = None
    method: Literal["latin-hypercube", "random"] = "latin-hypercube"
    seed: Annotated[int, Meta(ge=0)] = 0


def assignments(block: dict) -> list[dict[str, object]]:
    """Dictionaries {dotted key: value}, one per design of a block: all combinations of lists and ranges, each with every
    sample between bounds; the same for the same block. Raises InvalidDesign with the key."""
    drawing = _converted({key: block[key] for key in Drawing.__struct_fields__ if key in block}, Drawing, "vary")
    varied = {key: _values(key, value) for key, value in _flat(block).items()}
    if not varied:
        raise InvalidDesign(f"vary names no key of a design; add one, for example pattern.theta = [20, 30] or {RANGE}")
    bounds = {key: value for key, value in varied.items() if isinstance(value, Bounds)}
    if bounds and drawing.samples is None:
        raise InvalidDesign(f"vary.{next(iter(bounds))} has bounds, but vary.samples is missing; add samples = 50")
    if drawing.samples is not None and not bounds:
        raise InvalidDesign(f"vary.samples is given, but no key has bounds; give one, for example pattern.theta = {BOUNDS}")
    lists = {key: value for key, value in varied.items() if isinstance(value, list)}
    count = math.prod(map(len, lists.values())) * (drawing.samples or 1)
    if count > MOST:
        raise InvalidDesign(f"vary asks for {count:,} designs; a study holds up to {MOST:,}")
    drawn = _drawn(bounds, drawing)
    return [{key: (dict(zip(lists, combination, strict=True)) | sample)[key] for key in varied}
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
        if isinstance(value, dict) and not {"start", "stop", "low", "high"} & set(value):
            out |= _flat(value, name)
        else:
            out[name] = value
    return out


def _values(key: str, value: object) -> list | Bounds:
    if isinstance(value, list) and value:
        return value
    if isinstance(value, dict) and ("low" in value or "high" in value):
        return _checked(key, _converted(value, Bounds, f"vary.{key}"))
    if isinstance(value, dict):
        given = _converted(value, Range, f"vary.{key}")
        if given.scale == "log" and not (given.start > 0 and given.stop > 0):
            raise InvalidDesign(f"vary.{key} has a logarithmic scale, but ends that are not above 0; give larger ones")
        return given.values()
    raise InvalidDesign(f"vary.{key} is {value!r}; give a list of values, a range {RANGE}, or bounds {BOUNDS}")


def _checked(key: str, bounds: Bounds) -> Bounds:
    if not bounds.low < bounds.high:
        raise InvalidDesign(f"vary.{key} has low = {bounds.low} and high = {bounds.high}; low must be below high")
    if bounds.step is not None and not bounds.step > 0:
        raise InvalidDesign(f"vary.{key}.step is {bounds.step}; give a number above 0")
    if bounds.step is not None and bounds.scale == "log":
        raise InvalidDesign(f"vary.{key} has both a step and a logarithmic scale; leave one of them out")
    if bounds.scale == "log" and not bounds.low > 0:
        raise InvalidDesign(f"vary.{key} has a logarithmic scale, but low = {bounds.low}; give a number above 0")
    return bounds


def _converted(value: dict, kind: type[msgspec.Struct], where: str):
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError as error:
        what, _, path = str(error).partition(" - at `$")
        known = ", ".join(kind.__struct_fields__)
        raise InvalidDesign(f"{where}{path.rstrip('`')}: {what[0].lower()}{what[1:]}; known here: {known}") from None


def _short(value: float) -> float:
    """The value to nine digits, so that steps of a tenth look like it."""
    return float(f"{value:.{DIGITS}g}")

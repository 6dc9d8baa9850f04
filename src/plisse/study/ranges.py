"""Ranges and bounds of varied keys, and the values in them."""

import math
from typing import Annotated, Literal

import numpy as np
from msgspec import Meta

from plisse.errors import InvalidDesign
from plisse.recipe.fields import Strict

__all__ = ["BOUNDS", "MOST", "RANGE", "Bounds", "Count", "Range", "checked_bounds", "checked_range", "is_range"]

MOST = 1_000_000
DIGITS = 9
ENDS = {"start", "stop", "low", "high"}
RANGE = "{ start = 1, stop = 5, count = 3 }"
BOUNDS = "{ low = 1, high = 5 }"
Count = Annotated[int, Meta(ge=1, le=MOST, description=f"a whole number from 1 to {MOST:,}")]
Number = Annotated[float | int, Meta(description="a number")]
Scale = Annotated[Literal["linear", "log"], Meta(description='"linear" or "log"')]


class Range(Strict, kw_only=True, frozen=True):
    """`count` evenly spaced values from `start` to `stop`, both included."""

    start: Number
    stop: Number
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

    low: Number
    high: Number
    step: Number | None = None
    scale: Scale = "linear"

    @property
    def steps(self) -> float:
        """How many steps lie between the bounds."""
        return math.inf if self.step is None else (self.high - self.low) / self.step + 1e-9

    def at(self, share: float) -> float | int:
        """The value that far between the bounds, `share` in 0…1; steps get equal parts of it."""
        if self.step is not None:
            count = math.floor(self.steps) + 1
            value = self.low + min(int(share * count), count - 1) * self.step
            return value if isinstance(value, int) else _short(value)
        if self.scale == "log":
            return _short(self.low * (self.high / self.low) ** share)
        return _short(self.low + (self.high - self.low) * share)


def is_range(table: dict) -> bool:
    """Whether a table has an end and nothing in it that varies: `start` is a key of closed forms as well."""
    return bool(ENDS & set(table)) and not any(isinstance(value, list | dict) for value in table.values())


def checked_range(key: str, given: Range) -> Range:
    """The range of a key; raises InvalidDesign where it has no values."""
    if given.scale == "log" and not (given.start > 0 and given.stop > 0):
        raise InvalidDesign(f"vary.{key} has a logarithmic scale, but ends that are not above 0; give larger ones")
    _require_finite(key, given.start, given.stop, given.scale)
    return given


def checked_bounds(key: str, bounds: Bounds) -> Bounds:
    """The bounds of a key; raises InvalidDesign where nothing lies between them."""
    if not bounds.low < bounds.high:
        raise InvalidDesign(f"vary.{key} has low = {bounds.low} and high = {bounds.high}; low must be below high")
    if bounds.step is not None and not bounds.step > 0:
        raise InvalidDesign(f"vary.{key}.step is {bounds.step}; give a number above 0")
    if bounds.step is not None and bounds.scale == "log":
        raise InvalidDesign(f"vary.{key} has both a step and a logarithmic scale; leave one of them out")
    if bounds.scale == "log" and not bounds.low > 0:
        raise InvalidDesign(f"vary.{key} has a logarithmic scale, but low = {bounds.low}; give a number above 0")
    _require_finite(key, bounds.low, bounds.high, bounds.scale)
    if bounds.step is not None and not bounds.steps >= 1:
        raise InvalidDesign(f"vary.{key}.step is {bounds.step}, more than from low = {bounds.low} to high = {bounds.high}; "
                            "give a smaller step")
    if bounds.step is not None and not math.isfinite(bounds.steps):
        raise InvalidDesign(f"vary.{key}.step is {bounds.step}, too small to be counted from low = {bounds.low} to "
                            f"high = {bounds.high}; give a larger step")
    return bounds


def _require_finite(key: str, start: float, stop: float, scale: str) -> None:
    if not math.isfinite(stop / start if scale == "log" else stop - start):
        raise InvalidDesign(f"vary.{key} goes from {start} to {stop}, too far for a number; give ends that lie closer")


def _short(value: float) -> float:
    """The value to nine digits, so that steps of a tenth look like it."""
    return float(f"{value:.{DIGITS}g}")

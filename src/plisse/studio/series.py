"""Numbers that may be the same everywhere, one per crease or strip, or a table of positions along the curve."""

from dataclasses import dataclass

import numpy as np

from plisse.recipe import Design, Recipe

__all__ = ["ALONG", "EACH", "SAME", "SERIES", "Series", "fitted", "series_of", "with_place_after", "without_place"]

SAME, EACH, ALONG = "the same everywhere", "one by one", "along the curve"
SERIES = {"pattern.theta": ("crease", (SAME, EACH)), "pattern.width": ("strip", (SAME, EACH, ALONG))}


@dataclass(frozen=True)
class Series:
    """The value of a key of SERIES in a design of so many creases; all values are as TOML has them."""

    key: str
    value: float | list
    count: int
    closed: bool

    @property
    def kind(self) -> str:
        """SAME, EACH or ALONG."""
        if not isinstance(self.value, list):
            return SAME
        return ALONG if self.value and isinstance(self.value[0], list) else EACH

    def turned(self, kind: str) -> float | list:
        """The value in another way, numbers kept where both ways have them."""
        first = self._numbers[0]
        if kind == self.kind:
            return self.value
        if kind == ALONG:
            return [[place, first] for place in ([0.0, 0.5] if self.closed else [0.0, 0.5, 1.0])]
        return [first] * self.count if kind == EACH else first

    def resized(self, count: int) -> list[float]:
        """So many of its numbers; what is new repeats the last but one."""
        found = list(self._numbers)
        while len(found) < count:
            found.append(found[-2] if len(found) > 1 else found[-1])
        return found[:count]

    @property
    def _numbers(self) -> list[float]:
        if not isinstance(self.value, list):
            return [self.value]
        return [entry[-1] for entry in self.value] if self.kind == ALONG else self.value


def series_of(recipe: Recipe, key: str) -> Series | None:
    """The series of a key in a recipe; None where the recipe has none."""
    if not isinstance(recipe, Design) or recipe.pattern is None:
        return None
    count = recipe.pattern.creases - (key == "pattern.width")
    return Series(key, getattr(recipe.pattern, key.partition(".")[2]), count, recipe.is_closed)


def fitted(recipe: Recipe, changes: dict) -> dict:
    """The changes, and where they change the number of creases, series of one by one with as many numbers.

    New creases and strips have the numbers of the one before the last, for mountains and valleys take turns.
    """
    creases = changes.get("pattern.creases")
    if not isinstance(creases, int) or not isinstance(recipe, Design):
        return changes
    found = dict(changes)
    for key in SERIES:
        series = series_of(recipe, key)
        if series is not None and series.kind == EACH and key not in changes:
            found[key] = series.resized(creases - (key == "pattern.width"))
    return found


def with_place_after(table: list, index: int) -> list:
    """The table [[position, number], …] with one more place between number `index` and a neighbour."""
    index = min(index, len(table) - 2)
    between = np.mean([table[index], table[index + 1]], axis=0).round(6).tolist()
    return [*table[:index + 1], between, *table[index + 1:]]


def without_place(table: list, index: int) -> list:
    """The table without its place number `index`."""
    return [row for k, row in enumerate(table) if k != index]

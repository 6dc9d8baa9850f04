"""Coarse while pulling: which samples are solved at once, so that the picture follows the hand."""

import msgspec

from plisse.recipe import Design, Recipe
from plisse.studio.requests import Found

__all__ = ["Pace"]

FAST = 0.1
FEWEST = 25


class Pace:
    """How long full answers took, and what to solve first while a design changes."""

    def __init__(self):
        self._per_vertex = 0.0
        self.is_fast = False

    def learn(self, found: Found, seconds: float) -> None:
        """Remember how long a full answer took."""
        self.is_fast = seconds <= 2 * FAST
        if not found.drafted and found.report.vertices:
            self._per_vertex = seconds / found.report.vertices

    def draft(self, recipe: Recipe) -> Design | None:
        """The recipe with as few samples as are solved within a tenth of a second; None where all of them are.

        Surfaces and closed forms have none: they are answered in full when the hand rests.
        """
        if not isinstance(recipe, Design) or recipe.pattern is None:
            return None
        pattern = recipe.pattern
        seconds = self._per_vertex * pattern.creases * pattern.samples
        if seconds <= FAST:
            return None
        samples = max(FEWEST, round(pattern.samples * FAST / seconds))
        samples += 1 - samples % 2  # closed principal structures close for odd numbers only
        if samples >= pattern.samples:
            return None
        return msgspec.structs.replace(recipe, pattern=msgspec.structs.replace(pattern, samples=samples))

    def waits(self, recipe: Recipe) -> bool:
        """Whether a full answer is worth asking for only when the hand rests."""
        return not isinstance(recipe, Design) or self.draft(recipe) is not None

"""Coarse while pulling: which samples are solved at once, so that the picture follows the hand."""

from collections import deque

import msgspec

from plisse.recipe import Design, Recipe
from plisse.studio.requests import Found

__all__ = ["Pace"]

FAST = 0.1
FEWEST = 25
LAST = 3  # answers of a kind of which the fastest counts: one that was slow, as the first with its imports, says little


class Pace:
    """How long answers took, and what to solve first while a design changes."""

    def __init__(self):
        self._per_vertex = {drafted: deque[float](maxlen=LAST) for drafted in (False, True)}
        self.is_fast = False

    def learn(self, found: Found, seconds: float) -> None:
        """Remember how long an answer took; small drafts take longer per vertex, so that they never make others coarser."""
        if not found.drafted:
            self.is_fast = seconds <= 2 * FAST
        if found.report.vertices:
            self._per_vertex[found.drafted].append(seconds / found.report.vertices)

    def draft(self, recipe: Recipe) -> Design | None:
        """The recipe with as few samples as are solved within a tenth of a second; None where all of them are.

        Surfaces and closed forms have none: they are answered in full when the hand rests.
        """
        if not isinstance(recipe, Design) or recipe.pattern is None:
            return None
        pattern = recipe.pattern
        seconds = pattern.creases * pattern.samples * min((*self._per_vertex[False], *self._per_vertex[True]), default=0.0)
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

"""The design on one client's desk: what is on screen, as a recipe and as TOML, and the way back."""

import time
import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

from plisse.errors import InvalidDesign
from plisse.io.design_text import design_text
from plisse.io.designs import design_from_dict
from plisse.recipe import Recipe
from plisse.session import changed
from plisse.studio.shelf import Shelf

__all__ = ["Desk", "Step"]

TOGETHER = 1.0
MOST_STEPS = 1000
LONGEST_TEXT = 1_000_000
LONGEST_TITLE = 200
KINDS = ("surface", "march", "closed_form", "strips", "parallel", "curve", "units")  # sections that name a design


@dataclass(frozen=True)
class Step:
    """A design with its title."""

    recipe: Recipe
    title: str

    @cached_property
    def toml(self) -> str:
        """The design as text; equal designs give equal text."""
        return design_text(self.recipe, title=self.title)


class Desk:
    """The design that a client works on, and all steps before and after it.

    Changes of the same keys within a second are one step: a slider that is pulled goes back in one. Whatever is
    refused leaves the desk as it was.
    """

    def __init__(self, recipe: Recipe, title: str = "", *, clock: Callable[[], float] = time.monotonic):
        self.shelf = Shelf()
        self._steps = [Step(self.shelf.adopt(recipe), title)]
        self._at = 0
        self._clock = clock
        self._last: tuple[frozenset[str], float] = (frozenset(), 0.0)

    @property
    def step(self) -> Step:
        """What is on screen."""
        return self._steps[self._at]

    @property
    def recipe(self) -> Recipe:
        """The recipe on screen."""
        return self.step.recipe

    @property
    def toml(self) -> str:
        """The text of the recipe on screen."""
        return self.step.toml

    @property
    def solvable(self) -> Recipe:
        """The recipe with the places of its files."""
        return self.shelf.placed(self.recipe)

    @property
    def can_undo(self) -> bool:
        """Whether there is a step before this one."""
        return self._at > 0

    @property
    def can_redo(self) -> bool:
        """Whether a step was undone."""
        return self._at < len(self._steps) - 1

    def change(self, changes: dict) -> bool:
        """Whether the recipe is another one after changes named as in `plisse.Session.update`; raises InvalidDesign."""
        recipe = changed(self.recipe, changes)
        if recipe == self.recipe:
            return False
        keys, now = frozenset(changes), self._clock()
        before, when = self._last
        if keys == before and now - when < TOGETHER and self._at > 0 and not self.can_redo:
            self._steps[self._at] = Step(recipe, self.step.title)
        else:
            self._push(Step(recipe, self.step.title))
        self._last = keys, now
        return True

    def open(self, recipe: Recipe, title: str) -> None:
        """Put another design on the desk, as a step that can be undone."""
        self._push(Step(self.shelf.adopt(recipe), title))

    def read(self, text: str, title: str = "") -> None:
        """Put a design from a browser's text on the desk; raises InvalidDesign for what is none or names files."""
        if len(text) > LONGEST_TEXT:
            raise InvalidDesign(f"the text has {len(text)} characters; a design has at most {LONGEST_TEXT}")
        try:
            data = tomllib.loads(text)
        except (tomllib.TOMLDecodeError, RecursionError) as error:
            raise InvalidDesign(f"the text is not valid TOML: {error}; mend that line") from None
        recipe = design_from_dict(self.shelf.shown(data))
        self._push(Step(recipe, title or _title_of(text, recipe)))

    def undo(self) -> None:
        """Go one step back, if there is one."""
        self._go(-1 if self.can_undo else 0)

    def redo(self) -> None:
        """Go one step forward, if one was undone."""
        self._go(1 if self.can_redo else 0)

    def close(self) -> None:
        """Remove the files of the desk."""
        self.shelf.close()

    def _go(self, by: int) -> None:
        self._at += by
        self._last = frozenset(), 0.0

    def _push(self, step: Step) -> None:
        self._steps = [*self._steps[:self._at + 1], step][-MOST_STEPS:]
        self._at = len(self._steps) - 1
        self._last = frozenset(), 0.0


def _title_of(text: str, recipe: Recipe) -> str:
    """The comment that the text begins with, else the kind of the design."""
    first = text.lstrip().partition("\n")[0]
    said = first.lstrip("# ").strip()[:LONGEST_TITLE] if first.startswith("#") else ""
    return said or next(name for name in KINDS if getattr(recipe, name, None) is not None).replace("_", " ")

"""What the process of one client keeps between requests: the last result, and the patterns of its linear systems."""

from collections.abc import Callable
from functools import cached_property

from plisse.errors import InvalidStructure
from plisse.recipe import Recipe
from plisse.result import Result
from plisse.session import Session
from plisse.structure.pleated import PleatedStructure
from plisse.transform.flex import Motion

__all__ = ["Bench", "Progress", "required"]

Progress = Callable[[str, float], None]


class Bench:
    """Results by recipe: asked again for the same one, it answers at once; everything else is `plisse.Session`."""

    def __init__(self):
        self._session: Session | None = None
        self._held: _Held | None = None

    def result(self, recipe: Recipe, progress: Progress | None = None) -> Result:
        """What the recipe comes to; errors are those of `plisse.design`."""
        return self._of(recipe, progress).result

    def motion(self, recipe: Recipe) -> Motion:
        """The motion of the recipe's structure; raises InvalidStructure where it is not principal."""
        return self._of(recipe, None).motion

    def _of(self, recipe: Recipe, progress: Progress | None) -> "_Held":
        if self._held is None or self._held.recipe != recipe:
            if self._session is None:
                self._session = Session(recipe, progress=progress)
                result = self._session.result
            else:
                result = self._session.open(recipe, progress=progress)
            self._held = _Held(recipe, result)
        return self._held


class _Held:
    """A recipe with its result and, once asked for, its motion."""

    def __init__(self, recipe: Recipe, result: Result):
        self.recipe, self.result = recipe, result

    @cached_property
    def motion(self) -> Motion:
        """The motion of the result's structure."""
        return required(self.result).flex(100)


def required(result: Result) -> PleatedStructure:
    """The structure of a result; raises InvalidStructure where there is none."""
    if result.structure is None:
        raise InvalidStructure("the design broke down before there was a structure; its report says where")
    return result.structure

"""What stands in the status: how it is with the newest design, and above that what was refused or holds for the picture."""

from __future__ import annotations

from dataclasses import dataclass

from plisse.studio.requests import Found
from plisse.studio.status import Status, broken, refused, remark, searching, solved, working
from plisse.transform.collisions import FreeRange

__all__ = ["Standing"]

BEGUN = "solving", 0.0


@dataclass
class Standing:
    """The newest design and the title under which it was found, or why it broke down, or the stage of its solve.

    A stage is a name with the fraction of the work that is done. `seen` is what the scene shows, pale or not; a refusal and
    the stage of a search for layouts stand above all this and change nothing of it.
    """

    found: Found | None = None
    title: str = ""
    seen: Found | None = None
    breakdown: str = ""
    stage: tuple[str, float] | None = None
    search: tuple[str, float] | None = None
    refusal: str = ""

    def find(self, found: Found, title: str) -> None:
        """A design was solved."""
        self.found, self.title, self.breakdown, self.stage = found, title, "", None

    def break_down(self, sentence: str) -> None:
        """The newest design has come to nothing."""
        self.found, self.breakdown, self.stage = None, sentence, None

    def status(self, is_pale: bool, percent: float, free: FreeRange | None) -> Status:
        """All of it in words, with what holds for a picture that is pale, or in a state of the motion."""
        above = remark(is_pale, percent, free)
        if self.search is not None:
            above = searching(*self.search) + above
        if self.refusal:
            above = refused(self.refusal) + above
        said = self._state(self.seen if is_pale else None, above)
        return said.under(self.refusal) if self.refusal else said

    def _state(self, pale: Found | None, above: str) -> Status:
        if self.stage is None and self.breakdown:
            return broken(self.breakdown, pale, above)
        if self.stage is None and self.found is not None:
            return solved(self.found, self.title, above)
        return working(*(self.stage or BEGUN), self.found or pale, above)

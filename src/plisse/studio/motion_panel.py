"""The motion of a principal structure, from the flat sheet to the flat-folded state."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plisse.recipe import Recipe
from plisse.studio.inside import set_marks
from plisse.studio.requests import Found
from plisse.transform.collisions import FreeRange

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["MotionPanel", "marks_of", "why_fixed"]

FIXED = ("This structure is not principal, so it has no motion that keeps its rulings; switch “folds flat” on under Design, "
         "Exactness.")
NO_STRUCTURE = "There is no structure, so there is no motion; the status says why."
NOT_YET = "This structure is not principal although “folds flat” is on, so it does not move; the status says why."
MEASURING = "The range that is free of collisions is being measured …"
STATES = {0.0: "flat", 100.0: "as designed", 200.0: "folded"}
HINT = "0 is the flat sheet, 100 the structure as it was designed, 200 folded flat"
APART = 40.0  # percent between marks whose words do not touch


def marks_of(free: FreeRange) -> list[tuple[float, str]]:
    """Marks with their words: the ends of the free range, and the named states that are not too near to them."""
    ends = [(end, f"{words} {end:.0f}") for end, words in ((free.low, "free from"), (free.high, "free to"))
            if end not in STATES]
    named = [(state, words) for state, words in STATES.items() if all(abs(state - end) >= APART for end, _ in ends)]
    return sorted([*ends, *named])


def why_fixed(found: Found | None, recipe: Recipe) -> str:
    """Why what was found does not move; empty where it does."""
    if found is None or found.folded is None:
        return NO_STRUCTURE
    if found.report.principal:
        return ""
    return NOT_YET if getattr(getattr(recipe, "solve", None), "principal", False) else FIXED


class MotionPanel:
    """One slider, and the range in which nothing collides."""

    def __init__(self, tab: Tab):
        self._tab, gui = tab, tab.client.gui
        with gui.add_folder("Motion"):
            self._percent = gui.add_slider("folded (%)", 0.0, 200.0, 0.5, 100.0, marks=tuple(STATES.items()), hint=HINT)
            self._words = gui.add_markdown("")
        self._percent.on_update(self._moved)

    def refresh(self) -> None:
        """Bring the slider to the design on screen."""
        fixed = why_fixed(self._tab.found, self._tab.desk.recipe)
        self._percent.disabled = fixed != ""
        self._percent.value = self._tab.dress.chosen.percent
        if fixed:
            self._words.content = fixed

    def forget_reach(self) -> None:
        """Take the marks of a free range away, which belong to another structure."""
        if self._words.content != MEASURING:
            self._words.content = MEASURING
            set_marks(self._percent, list(STATES.items()))

    def show_reach(self, free: FreeRange) -> None:
        """Mark the free range."""
        collisions = "".join(f"\n\n{sentence[:1].upper()}{sentence[1:]}" for sentence in free.collisions)
        self._words.content = f"Free of collisions from {free.low:.4g} to {free.high:.4g} %.{collisions}"
        set_marks(self._percent, marks_of(free))

    async def _moved(self, event) -> None:
        if event.client is not None:
            self._tab.pose(float(self._percent.value))

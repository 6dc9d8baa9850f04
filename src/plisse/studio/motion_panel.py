"""The motion of a principal structure, from the flat sheet to the flat-folded state."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plisse.transform.collisions import FreeRange

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["MotionPanel"]

FIXED = "This structure is not principal, so it has no motion that keeps its rulings; switch principal on under Exactness."


class MotionPanel:
    """One slider, and the range in which nothing collides."""

    def __init__(self, tab: Tab):
        self._tab, gui = tab, tab.client.gui
        with gui.add_folder("Motion"):
            self._percent = gui.add_slider("folded (%)", 0.0, 200.0, 0.5, 100.0,
                                           marks=((0.0, "flat"), (100.0, "as designed"), (200.0, "folded")))
            self._words = gui.add_markdown("")
        self._percent.on_update(self._moved)

    def refresh(self) -> None:
        """Bring the slider to the design on screen."""
        found = self._tab.found
        moves = found is not None and found.report.principal
        self._percent.disabled = not moves
        self._percent.value = self._tab.percent
        if not moves:
            self._words.content = FIXED
        elif self._words.content == FIXED:
            self._words.content = ""

    def show_reach(self, free: FreeRange) -> None:
        """Mark the free range."""
        collisions = "".join(f"\n\n{sentence}" for sentence in free.collisions)
        self._words.content = f"Free of collisions from {free.low:.4g} to {free.high:.4g} %.{collisions}"
        ends = {0.0: "flat", 100.0: "as designed", 200.0: "folded", free.low: "free from", free.high: "free to"}
        from viser._messages import GuiSliderMark

        self._percent._marks = tuple(GuiSliderMark(value, label) for value, label in sorted(ends.items()))

    async def _moved(self, event) -> None:
        if event.client is not None:
            self._tab.pose(float(self._percent.value))

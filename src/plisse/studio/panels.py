"""The controls of one tab: status on top, then design, look, surface and what can be taken away."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from plisse.studio.design_panel import DesignPanel
from plisse.studio.framing import is_narrow
from plisse.studio.gallery_panel import GalleryPanel
from plisse.studio.look_panel import LookPanel
from plisse.studio.motion_panel import MotionPanel
from plisse.studio.points_panel import PointsPanel
from plisse.studio.series_panel import SeriesPanel
from plisse.studio.status import Status
from plisse.studio.surface_panel import SurfacePanel
from plisse.studio.take_panel import TakePanel
from plisse.studio.view import Tint

if TYPE_CHECKING:
    from plisse.studio.candidates import Choice
    from plisse.studio.tab import Tab
    from plisse.transform.collisions import FreeRange

__all__ = ["Panels"]

NAME, LONGEST_LABEL = "plisse studio", 60


class Panels:
    """All controls; nothing here computes, everything asks the tab."""

    def __init__(self, tab: Tab):
        self._tab, gui = tab, tab.client.gui
        self._brief = self._label = ""
        self._status = gui.add_html("") if is_narrow(tab.client.camera) else self._status_above()
        tab.client.camera.on_update(self._resized)
        gui.add_button("a note was said", icon="message").on_click(self._noted)  # which the page does, and nobody sees
        self._undo = gui.add_button("undo", icon="arrow-back-up", disabled=True)
        self._redo = gui.add_button("redo", icon="arrow-forward-up", disabled=True)
        self._undo.on_click(self._back)
        self._redo.on_click(self._forth)
        gui.add_command("Undo", hotkey="Z", modifier="cmd/ctrl").on_trigger(self._back)
        gui.add_command("Redo", hotkey="Z", modifier="cmd/ctrl+shift").on_trigger(self._forth)
        tabs = gui.add_tab_group()
        with tabs.add_tab("Design"):
            self._gallery = GalleryPanel(tab)
            self._design = DesignPanel(tab)
            self._series = (SeriesPanel(tab, "pattern.theta", "inclination θ"), SeriesPanel(tab, "pattern.width", "width"))
            self._points = PointsPanel(tab)
        with tabs.add_tab("Look"):
            self._motion = MotionPanel(tab)
            self._look = LookPanel(tab)
        with tabs.add_tab("Surface"):
            self._surface = SurfacePanel(tab)
        with tabs.add_tab("Take away"):
            self._take = TakePanel(tab)
        self.refresh()

    def _status_above(self):
        """A place for the status that stays when the controls below are scrolled."""
        gui = self._tab.client.gui
        gui.main_panel.dock_right()
        panel = gui.add_panel()
        with panel.add_tab("Status"):
            status = gui.add_html("")
        panel.dock_above(gui.main_panel)
        return status

    @property
    def manner(self) -> dict[str, Any]:
        """How files are made, as `downloads.Order` has it."""
        return self._look.manner

    @property
    def handles_wanted(self) -> bool:
        """Whether control points are to be seen."""
        return self._points.wanted

    def point_moved(self, index: int, place: np.ndarray) -> None:
        """The handle of a point was pulled to a place."""
        self._points.move(index, place)

    def point_chosen(self, index: int) -> None:
        """The handle of another point was clicked."""
        self._points.choose(index)

    def say(self, status: Status) -> None:
        """Show a status."""
        self._status.content = status.html
        self._brief = status.brief[:LONGEST_LABEL]
        self._show_label()

    async def _resized(self, _camera) -> None:
        self._show_label()

    def _show_label(self) -> None:
        """Say the status in a few words on the bar of a narrow window, the name on that of a wide one."""
        label = self._brief if is_narrow(self._tab.client.camera) else NAME
        if label != self._label:
            self._label = label
            self._tab.client.gui.set_panel_label(label)

    def note(self, words: str) -> None:
        """Show a passing message."""
        self._tab.client.add_notification(NAME, words, auto_close_seconds=4.0)

    def refresh(self) -> None:
        """Bring all controls to what is on the desk."""
        self._undo.disabled, self._redo.disabled = not self._tab.desk.can_undo, not self._tab.desk.can_redo
        for panel in (self._design, *self._series, self._points, self._motion, self._look, self._surface, self._take):
            panel.refresh()

    def show_chosen(self) -> None:
        """Bring the choices of colours and plates alone to what is chosen."""
        self._look.show_chosen()

    def fit(self, size: float) -> None:
        """Suggest lengths for structures of a size (radius)."""
        self._look.fit(size)

    def show_scale(self, tint: Tint | None) -> None:
        """Show what colours mean."""
        self._look.show_scale(tint)

    def forget_reach(self) -> None:
        """Say nothing about motion and offsets, for the structure is another one."""
        self._motion.forget_reach()
        self._look.forget_offsets()

    def show_reach(self, free: FreeRange, offsets: tuple[float, float]) -> None:
        """Show how far the structure moves and can be offset."""
        self._motion.show_reach(free)
        self._look.show_offsets(offsets)

    def show_candidates(self, choices: list[Choice]) -> None:
        """Show layouts to choose from."""
        self._surface.show_candidates(choices)

    async def _back(self, _event) -> None:
        self._tab.act(self._tab.desk.undo)

    async def _forth(self, _event) -> None:
        self._tab.act(self._tab.desk.redo)

    async def _noted(self, _event) -> None:
        self._tab.forget_refusal()

"""What can be taken away: the design as text, and every file made of it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plisse.studio.downloads import KINDS, MATERIAL, file_name
from plisse.studio.fields import DIGITS

if TYPE_CHECKING:
    from plisse.studio.model import Step
    from plisse.studio.tab import Tab

__all__ = ["TakePanel"]

SMALLEST, LARGEST = (50.0, 50.0), (5000.0, 5000.0)  # mm


class TakePanel:
    """The text is that of the design on screen; what was typed and not taken stays until that is another one."""

    def __init__(self, tab: Tab):
        self._tab, gui = tab, tab.client.gui
        self._shown: Step | None = None
        with gui.add_folder("Files"):
            self._kind = gui.add_dropdown("format", tuple(KINDS), hint="What is made of the design on screen")
            self._material = gui.add_vector2("material of pieces (mm)", MATERIAL, min=SMALLEST, max=LARGEST, step=1.0,
                                              hint="Width and height of the sheets that you have; pieces are nested on them")
            self._material.precision = DIGITS
            gui.add_button("Download", icon="download").on_click(self._taken)
        with gui.add_folder("Design as text"):
            self._text = gui.add_text("design (TOML)", "", multiline=True,
                                      hint="Change it, then read it; plisse make takes it, too")
            gui.add_button("Read the text above").on_click(self._read)
            gui.add_button("Download the text", icon="download").on_click(self._saved)
            gui.add_upload_button("Open a design file …", icon="upload", mime_type=".toml").on_upload(self._uploaded)

    def refresh(self) -> None:
        """Bring the text to the design on the desk, where that is another one."""
        if self._tab.desk.step is not self._shown:
            self._shown, self._text.value = self._tab.desk.step, self._tab.desk.toml

    async def _taken(self, _event) -> None:
        material = float(self._material.value[0]), float(self._material.value[1])
        manner = {"material": material, **self._tab.panels.manner}
        self._tab.act(lambda: self._tab.errands.take(self._kind.value, **manner))

    async def _read(self, _event) -> None:
        self._tab.read(self._text.value)

    async def _saved(self, _event) -> None:
        name = file_name(self._tab.desk.step.title, "FOLD").replace(".fold", ".toml")
        self._tab.client.send_file_download(name, self._tab.desk.toml.encode(), save_immediately=True)

    async def _uploaded(self, event) -> None:
        file = event.target.value
        self._tab.read(file.content[:2_000_000].decode("utf-8-sig", errors="replace"), file.name.removesuffix(".toml")[:60])

"""The shipped designs with their pictures."""

from __future__ import annotations

import base64
from html import escape
from importlib.resources import files
from typing import TYPE_CHECKING

from plisse.shipped import description, shipped_names

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["GalleryPanel", "thumbnail_html"]


def thumbnail_html(name: str) -> str:
    """What a shipped design shows, with its picture where there is one."""
    picture = files("plisse") / "gallery" / "thumbnails" / f"{name}.png"
    image = ""
    if picture.is_file():
        data = base64.b64encode(picture.read_bytes()).decode()
        image = f"<img alt='{escape(name)}' src='data:image/png;base64,{data}' style='width:100%;max-width:240px'>"
    words = f"<div>{escape(description(name))}</div>"
    return f"<div class='plisse-design' style='font-size:0.86em;padding:0 0.7em'>{image}{words}</div>"


class GalleryPanel:
    """A button that opens a window with all shipped designs."""

    def __init__(self, tab: Tab):
        self._tab = tab
        button = tab.client.gui.add_button("Gallery …", icon="photo", hint="Start from a design that comes with plisse")
        button.on_click(self._open)

    async def _open(self, _event) -> None:
        gui = self._tab.client.gui
        modal = gui.add_modal("Gallery: choose a design to start from")
        with modal:
            close = gui.add_button("Close")
            close.on_click(self._chosen(modal, None))
            for name in shipped_names():
                gui.add_html(thumbnail_html(name))
                gui.add_button(f"Open {name}").on_click(self._chosen(modal, name))

    def _chosen(self, modal, name: str | None):
        async def chosen(_event) -> None:
            modal.close()
            if name is not None:
                self._tab.open_shipped(name)

        return chosen

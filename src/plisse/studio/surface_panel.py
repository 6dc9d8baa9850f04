"""Pleats over a surface: upload it, choose a layout, or click where creases start."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from plisse.recipe import SurfaceDesign
from plisse.studio.picking import first_hit
from plisse.studio.shelf import LARGEST_MESH, MESH_FORMATS

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["SurfacePanel"]

NOTHING, CENTRE, GUIDE = "turns the view", "sets the centre", "adds a guide point"
WORDS = (f"Upload a mesh ({', '.join(MESH_FORMATS)}, up to {LARGEST_MESH // 1_000_000} MB). It is read as data on this "
         "machine and goes nowhere else.")


class SurfacePanel:
    """What is done with a reference surface."""

    def __init__(self, tab: Tab):
        self._tab, self._gui = tab, tab.client.gui
        gui = self._gui
        gui.add_markdown(WORDS)
        gui.add_upload_button("Upload a mesh …", icon="upload", mime_type=",".join(MESH_FORMATS)).on_upload(self._uploaded)
        self._folder = gui.add_folder("Layout")
        with self._folder:
            self._count = gui.add_slider("layouts to try", 1, 20, 1, 6)
            self._search = gui.add_button("Search for layouts", icon="search")
            self._click = gui.add_dropdown("a click on the surface", (NOTHING, CENTRE, GUIDE))
            self._forget = gui.add_button("Forget guide and centre")
            self._results = gui.add_folder("Candidates", visible=False)
        self._shown: list = []
        self._guide: list[list[float]] = []
        self._search.on_click(self._searched)
        self._click.on_update(self._click_changed)
        self._forget.on_click(self._forgotten)

    def refresh(self) -> None:
        """Show what belongs to surfaces for surfaces only."""
        self._folder.visible = isinstance(self._tab.desk.recipe, SurfaceDesign)

    def show_candidates(self, picture: bytes, choices: list[tuple[str, dict]]) -> None:
        """Show the picture of all layouts and a button for each."""
        from PIL import Image

        for node in self._shown:
            node.remove()
        self._shown, self._results.visible = [], True
        with self._results:
            image = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"))
            self._shown.append(self._gui.add_image(image, label="layouts, seen from above"))
            for words, changes in choices:
                button = self._gui.add_button(words)
                button.on_click(self._taken(changes))
                self._shown.append(button)

    def _taken(self, changes: dict):
        async def taken(_event) -> None:
            self._tab.change(changes)

        return taken

    async def _uploaded(self, event) -> None:
        file = event.target.value
        self._tab.act(lambda: self._tab.errands.upload_mesh(file.name, file.content))

    async def _searched(self, _event) -> None:
        self._tab.errands.lay_out(self._count.value)

    async def _forgotten(self, _event) -> None:
        self._guide = []
        self._tab.change({"surface.guide": None, "surface.centre": None, "surface.directions": None, "surface.reach": None,
                          "pattern.creases": None})

    async def _click_changed(self, _event) -> None:
        scene = self._tab.client.scene
        scene.remove_click_callback()
        self._guide = []
        if self._click.value != NOTHING:
            scene.on_click()(self._clicked)

    async def _clicked(self, event) -> None:
        found, recipe = self._tab.found, self._tab.desk.recipe
        if found is None or found.reference is None or not isinstance(recipe, SurfaceDesign):
            return
        points = found.reference.points
        hit = first_hit(points, found.reference.triangles, np.array(event.ray_origin), np.array(event.ray_direction))
        if hit is None:
            return
        size = float(np.linalg.norm(np.ptp(points, axis=0)))
        place = np.round(hit, max(0, int(4 - np.floor(np.log10(size))))).tolist()
        if self._click.value == CENTRE:
            self._tab.change({"surface.guide": None, "surface.directions": None, "surface.centre": place})
            return
        self._guide.append(place)
        if len(self._guide) >= 2:
            self._tab.change({"surface.centre": None, "surface.guide": self._guide, **_sizes(recipe, size)})


def _sizes(recipe: SurfaceDesign, size: float) -> dict:
    """What creases along a guide need, where the design does not say."""
    width = recipe.pattern.width or size / 30
    wanted = {"theta": 45.0, "width": float(f"{width:.3g}"), "amplitude": float(f"{0.6 * width:.3g}")}
    return {f"pattern.{name}": value for name, value in wanted.items() if getattr(recipe.pattern, name) is None}

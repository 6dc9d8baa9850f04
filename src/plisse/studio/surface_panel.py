"""Pleats over a surface: upload it, choose a layout, or click where creases start."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from plisse.draw import colours
from plisse.recipe import Recipe, SurfaceDesign
from plisse.solve.candidate import FARNESS, FARNESS_APART
from plisse.studio.paper import ink_bytes
from plisse.studio.picking import first_hit
from plisse.studio.shelf import LARGEST_MESH, MESH_FORMATS

if TYPE_CHECKING:
    from plisse.studio.candidates import Choice
    from plisse.studio.tab import Tab

__all__ = ["SurfacePanel", "kept_guide", "shape_of"]

NOTHING, CENTRE, GUIDE = "turns the view", "sets the centre", "adds a guide point"
DOT = "/guide"
COUNT_HINT = ("How many layouts are tried; one that covers all and lies near ends the search. The best is shown first: by "
              f"coverage, less {100 * FARNESS:g} % for every amplitude away ({100 * FARNESS_APART:g} % with seams), a "
              "little for seams, holes and narrow angles")
MISSED = "That click met no point of the reference surface; nothing was changed."
CLICK_HINT = "Rows of pleats are laid around the centre; along a guide creases start one beside the other"
SHAPE = ("file", "edited_file", "handles", "height", "radius", "torus", "x", "y")
WORDS = (f"Upload a mesh ({', '.join(MESH_FORMATS)}, up to {LARGEST_MESH // 1_000_000} MB). It is read as data on this "
         "machine and goes nowhere else.")


def shape_of(recipe: Recipe) -> tuple:
    """What the surface of a recipe is, whatever is laid over it; empty for designs without one."""
    if not isinstance(recipe, SurfaceDesign):
        return ()
    return tuple(getattr(recipe.surface, name) for name in SHAPE)


def kept_guide(clicked: list[list[float]], recipe: Recipe) -> list[list[float]]:
    """The points that were clicked, as far as the design still has them: the next click goes on from there."""
    surface = recipe.surface if isinstance(recipe, SurfaceDesign) else None
    guide = [] if surface is None or surface.guide is None else [[float(x) for x in point] for point in surface.guide]
    if guide and guide[:len(clicked)] == clicked:
        return guide if clicked else []
    if len(clicked) == 1:
        return clicked  # one point is no guide yet
    return guide if clicked[:len(guide)] == guide else []


class SurfacePanel:
    """What is done with a reference surface."""

    def __init__(self, tab: Tab):
        self._tab, self._gui = tab, tab.client.gui
        gui = self._gui
        gui.add_markdown(WORDS)
        gui.add_upload_button("Upload a mesh …", icon="upload", mime_type=",".join(MESH_FORMATS)).on_upload(self._uploaded)
        self._folder = gui.add_folder("Layout")
        with self._folder:
            self._count = gui.add_slider("layouts at most", 1, 20, 1, 6, hint=COUNT_HINT)
            self._search = gui.add_button("Search for layouts", icon="search")
            self._click = gui.add_dropdown("a click on the surface", (NOTHING, CENTRE, GUIDE), hint=CLICK_HINT)
            self._forget = gui.add_button("Forget guide and centre")
            self._results = gui.add_folder("Candidates", visible=False)
        self._shown: list = []
        self._guide: list[list[float]] = []
        self._shape: tuple = ()
        self._search.on_click(self._searched)
        self._click.on_update(self._click_changed)
        self._forget.on_click(self._forgotten)

    def refresh(self) -> None:
        """Show what belongs to surfaces for surfaces only."""
        recipe = self._tab.desk.recipe
        self._folder.visible = isinstance(recipe, SurfaceDesign)
        if shape_of(recipe) != self._shape:
            self._shape = shape_of(recipe)
            self._forget_candidates()
            self._begin_guide([])
        guide = kept_guide(self._guide, recipe)
        if guide != self._guide:
            self._begin_guide(guide)

    def show_candidates(self, choices: list[Choice]) -> None:
        """Show a picture of every layout and a button that takes it."""
        from PIL import Image

        self._forget_candidates()
        self._results.visible = True
        with self._results:
            for number, choice in enumerate(choices, 1):
                image = np.asarray(Image.open(io.BytesIO(choice.picture)).convert("RGB"))
                picture = self._gui.add_image(image, label=f"layout {number}, seen from above")
                button = self._gui.add_button(choice.words)
                button.on_click(self._taken(choice.changes))
                self._shown += [picture, button]

    def _forget_candidates(self) -> None:
        for node in self._shown:
            node.remove()
        self._shown, self._results.visible = [], False

    def _begin_guide(self, points: list[list[float]]) -> None:
        """Go on from points; the dot of a first click disappears."""
        self._guide = points
        self._tab.client.scene.remove_by_name(DOT)

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
        self._begin_guide([])
        self._tab.change({"surface.guide": None, "surface.centre": None, "surface.directions": None, "surface.reach": None,
                          "pattern.creases": None})

    async def _click_changed(self, _event) -> None:
        scene = self._tab.client.scene
        scene.remove_click_callback()
        self._begin_guide([])
        if self._click.value != NOTHING:
            scene.on_click()(self._clicked)

    async def _clicked(self, event) -> None:
        found, recipe = self._tab.found, self._tab.desk.recipe
        if found is None or found.reference is None or not isinstance(recipe, SurfaceDesign):
            self._tab.panels.note(MISSED)
            return
        points = found.reference.points
        hit = first_hit(points, found.reference.triangles, np.array(event.ray_origin), np.array(event.ray_direction))
        if hit is None:
            self._tab.panels.note(MISSED)
            return
        size = float(np.linalg.norm(np.ptp(points, axis=0)))
        place = np.round(hit, max(0, int(4 - np.floor(np.log10(size))))).tolist()
        if self._click.value == CENTRE:
            self._tab.change({"surface.guide": None, "surface.directions": None, "surface.centre": place})
            return
        guide = [*self._guide, place]
        self._begin_guide(guide)
        if len(guide) == 1:
            scene = self._tab.client.scene
            scene.add_icosphere(DOT, 0.01 * size, ink_bytes(colours.MOUNTAIN), position=place, cast_shadow=False)
            self._tab.panels.note("The first point of a guide; click where it goes next.")
        else:
            self._tab.change({"surface.centre": None, "surface.guide": guide, **_sizes(recipe, size)})


def _sizes(recipe: SurfaceDesign, size: float) -> dict:
    """What creases along a guide need, where the design does not say."""
    width = recipe.pattern.width or size / 30
    wanted = {"theta": 45.0, "width": float(f"{width:.3g}"), "amplitude": float(f"{0.6 * width:.3g}")}
    return {f"pattern.{name}": value for name, value in wanted.items() if getattr(recipe.pattern, name) is None}

"""The scene of one client: paper, creases, rulings, the sheet beside, marks and the reference surface."""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import Camera
from plisse.studio.framing import FIELD_OF_VIEW, FILLED, SEEN, TINY, Manner, SheetPlace, Stand, Window, beside, seen_by
from plisse.studio.paper import Paper, Shown, ink_bytes
from plisse.studio.requests import Found
from plisse.studio.shading import Grooves, light, textured
from plisse.studio.view import Tint, View

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Scene"]

GLASS, OPEN = "#7f9bb0", "#d99a2b"
SEED, MARK = colours.INK, colours.MOUNTAIN
MARKS, OVERLAP = ("/trouble", "/trouble/words", "/seed"), ("/overlap", "/overlap/words")
SURFACES = {True: ("/reference/covered", GLASS, 0.25), False: ("/reference/open", OPEN, 0.4)}
CALM = 1.1  # how much nearer the camera must come before the sheet lies elsewhere


class Scene:
    """Nodes of a client's scene, updated in place; everything here runs in the server's event loop."""

    def __init__(self, client: ClientHandle, loop: asyncio.AbstractEventLoop):
        self.shown = Shown()
        self._client, self._scene = client, client.scene
        self._found: Found | None = None
        self._view: View | None = None
        self._best = Camera(np.eye(3), np.array([0.0, 1.0, 0.0]))
        self._manner = Manner(below=client.camera.aspect < 1)
        self._known = np.empty((0, 3)), np.empty((0, 3))
        self._stood: Stand | None = None
        self._aspect = client.camera.aspect
        client.camera.on_update(self._resized)
        self._tint = None
        self.is_pale = False
        self._folded, self._sheet = Paper(client.scene, "/folded"), Paper(client.scene, "/sheet")
        self._grooves = Grooves(client.scene, "/grooves", self._folded, loop)

    @property
    def extent(self) -> tuple[np.ndarray, float]:
        """Middle (3,) and radius of what was shown last."""
        found = self._found
        if found is None or found.folded is None:
            return np.zeros(3), 100.0
        points = found.folded.points
        middle = 0.5 * (points.min(axis=0) + points.max(axis=0))
        return middle, float(np.linalg.norm(points - middle, axis=1).max())

    @property
    def scale_of_sheet(self) -> float:
        """How large the sheet is shown, 1 as large as the structure; 0 where it is not shown."""
        found = self._found
        if found is None or found.sheet is None or found.folded is None or self.is_pale or not self.shown.sheet:
            return 0.0
        return self._sheet_place(found).scale

    @property
    def points(self) -> np.ndarray:
        """Points (N, 3) of the paper, or the plates, on screen."""
        return self._folded.points

    @property
    def height_of_paper(self) -> float:
        """Smallest extent of the paper as it is on screen: that of the flat sheet is 0."""
        points = self.points
        if not len(points):
            return 0.0
        return float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1] / np.sqrt(len(points)))

    def show(self, found: Found) -> None:
        """Show a solved design; what it lacks disappears."""
        self._found, self.is_pale = found, False
        if found.camera is not None:
            self._best = found.camera
        with self._client.atomic():
            self._put(found.folded)
            self._show_around(found)

    def pose(self, view: View | None) -> None:
        """Show another state, or plates, instead of the structure; marks that belong to it disappear."""
        self._put(view)
        self.follow()

    def _put(self, view: View | None) -> None:
        with self._client.atomic():
            self._drop_tint()
            self._view = view
            self._folded.show(view, self.shown)
            self._grooves.wait(view)
            self._remove(MARKS)

    def tint(self, tint: Tint) -> None:
        """Lay colours over the structure."""
        with self._client.atomic():
            self._drop_tint()
            self._grooves.leave()
            self._folded.hide_paper()
            self._tint = self._scene.add_mesh_trimesh("/colours", textured(tint), cast_shadow=False, receive_shadow=False)

    def close(self) -> None:
        """Change nothing any more: the tab is closed."""
        self._grooves.stop()

    def pale(self) -> None:
        """Show that what is on screen, if anything is, is not the structure of the design any more."""
        self.is_pale = self._view is not None
        with self._client.atomic():
            self._drop_tint()
            self._grooves.leave()
            self._remove((*MARKS, *OVERLAP))
            for paper in (self._folded, self._sheet):
                paper.pale()

    def redraw(self) -> None:
        """Show the same again, after a switch was turned."""
        if self._found is None or self.is_pale:
            return
        with self._client.atomic():
            self._folded.show(self._view, self.shown)
            if self._tint is None:
                self._grooves.wait(self._view)
            else:
                self._folded.hide_paper()
            self._remove(MARKS)
            self._show_around(self._found)

    def frame(self) -> None:
        """Move the camera to where the whole structure, and the sheet beside it, is best seen.

        What is shown instead, as a state of its motion, is not small for the sake of the sheet: that leaves the window.
        """
        self._lay_sheet()
        camera = self._client.camera
        camera.fov = FIELD_OF_VIEW
        is_designed = self._found is None or self._view is self._found.folded
        self._stand(self._best, least=0.0 if is_designed else TINY)
        light(self._scene, self._best.axes, *self.extent)

    def follow(self) -> None:
        """Move the camera back or forth where what it showed has left the window or become small; else leave it alone."""
        known, self._known, camera = self._known, self._in_view, self._client.camera
        if not all(map(len, (*known, *self._known))):
            return
        window = Window.of(camera)
        has_left = any(window.reach(now, camera) > SEEN >= window.reach(before, camera)
                       for before, now in zip(known, self._known, strict=True))
        before, now = (window.share(structure, camera) for structure, _ in (known, self._known))
        if has_left or now < TINY <= before:
            self._stand(seen_by(camera))

    async def _resized(self, camera) -> None:
        """Fill a window whose shape has changed, unless somebody has moved the camera."""
        stood = self._stood  # a browser that has not heard of it yet is still elsewhere, and will say so again
        if stood is None or camera.aspect == self._aspect:
            return
        if np.allclose(camera.position, stood.position, atol=1e-3 * stood.distance):
            self._lay_sheet()
            self._stand(seen_by(camera))

    def _stand(self, view: Camera, *, least: float = 0.0) -> None:
        """Put the camera where everything fills the window as seen in a direction, if there is anything.

        It is nearer where the structure alone would take less than about the `least` share of the window.
        """
        camera, known = self._client.camera, self._in_view
        if not len(known[1]):
            return
        window = Window.of(camera)
        stand = window.stand(known[1], view.axes)
        if least:
            alone = window.stand(known[0], view.axes)
            stand = stand.nearer(alone, alone.distance * FILLED / least)
        self._stood, self._aspect = stand, camera.aspect
        camera.near, camera.far = 0.002 * stand.distance, 50 * stand.distance
        camera.position, camera.look_at, camera.up_direction = stand.position, stand.middle, view.upright
        self._known = known

    @property
    def _in_view(self) -> tuple[np.ndarray, np.ndarray]:
        """Points (N, 3) of the structure, or what is shown instead of it, alone, and with the sheet beside."""
        return np.empty((0, 3)) if self._view is None else self._view.points, self._everything

    @property
    def _everything(self) -> np.ndarray:
        """Points (N, 3) of what is to be seen: the paper on screen, and the sheet where it is shown."""
        found = self._found
        if found is None or self._view is None:
            return np.empty((0, 3))
        if found.sheet is None or found.folded is None or not self.shown.sheet:
            return self._view.points
        return np.concatenate([self._view.points, self._sheet_place(found).placed(found.sheet.points)])

    def _lay_sheet(self) -> None:
        """Choose on which side the sheet lies, and how it is turned, so that everything is large."""
        found = self._found
        if found is None or found.folded is None or found.sheet is None or not self.shown.sheet:
            return
        manners = [self._manner, *(Manner(*flags) for flags in itertools.product((False, True), repeat=3))]
        self._manner = min(manners, key=lambda manner: self._distance(manner, found))
        self._show_sheet(found)

    def _distance(self, manner: Manner, found: Found) -> float:
        """How far the camera would be from everything, a little more where the sheet is not as it was or reduced."""
        assert found.folded is not None
        assert found.sheet is not None
        flat, axes = found.sheet.points[:, :2], self._best.axes
        points = np.concatenate([found.folded.points, beside(found.folded.points, flat, axes, manner).placed(flat)])
        reluctance = CALM ** (int(manner != self._manner) + manner.reduced)
        return Window.of(self._client.camera).stand(points, axes).distance * reluctance

    def _show_around(self, found: Found) -> None:
        self._show_sheet(found)
        if self._view is found.folded:
            self._show_marks(found)
        self._show_reference(found)

    def _remove(self, names: Iterable[str]) -> None:
        for name in names:
            self._scene.remove_by_name(name)

    def _drop_tint(self) -> None:
        if self._tint is not None:
            self._tint.remove()
            self._tint = None

    def _show_sheet(self, found: Found) -> None:
        view = found.sheet if self.shown.sheet else None
        self._sheet.show(view, self.shown)
        self._remove(OVERLAP)
        if view is None or found.folded is None:
            return
        place = self._sheet_place(found)
        self._sheet.place(place.origin, place.scale, place.turn)
        if found.overlap is not None:
            self._mark("/overlap", place.placed(found.overlap), 0.015 * self.extent[1], "overlaps here")

    def _sheet_place(self, found: Found) -> SheetPlace:
        """Where the sheet lies beside the structure as it was designed."""
        assert found.sheet is not None
        assert found.folded is not None
        return beside(found.folded.points, found.sheet.points[:, :2], self._best.axes, self._manner)

    def _show_marks(self, found: Found) -> None:
        if found.seed is not None and self.shown.seed:
            line = np.stack([found.seed[:-1], found.seed[1:]], axis=1).astype(np.float32)
            self._scene.add_line_segments("/seed", line, ink_bytes(SEED), thickness=2.2, thickness_units="screen")
        if found.trouble is not None:
            self._mark("/trouble", found.trouble, 0.02 * self.extent[1], "problem here")

    def _mark(self, name: str, place: np.ndarray, radius: float, words: str) -> None:
        self._scene.add_icosphere(name, radius, ink_bytes(MARK), position=place, cast_shadow=False)
        self._scene.add_label(f"{name}/words", words)

    def _show_reference(self, found: Found) -> None:
        """The reference surface like glass, and in another colour where no structure lies over it."""
        self._remove(name for name, *_ in SURFACES.values())
        reference = found.reference
        if reference is None or not self.shown.reference:
            return
        for is_covered, (name, ink, opacity) in SURFACES.items():
            chosen = reference.is_covered == is_covered
            if chosen.any():
                self._scene.add_mesh_simple(name, reference.points, reference.triangles[chosen], color=ink_bytes(ink),
                                            opacity=opacity, side="double", cast_shadow=False, receive_shadow=False)

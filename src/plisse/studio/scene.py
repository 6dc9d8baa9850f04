"""The scene of one client: paper, creases, rulings, the sheet beside, marks and the reference surface."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from plisse.draw import colours
from plisse.studio.paper import Paper, Shown, ink_bytes
from plisse.studio.requests import Found
from plisse.studio.view import Tint, View

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Scene"]

GLASS, OPEN = "#7f9bb0", "#d99a2b"
SEED, MARK = colours.INK, colours.MOUNTAIN
MARKS, OVERLAP = ("/trouble", "/trouble/words", "/seed"), ("/overlap", "/overlap/words")
SURFACES = {True: ("/reference/covered", GLASS, 0.25), False: ("/reference/open", OPEN, 0.55)}
APART, SMALLEST = 0.12, 0.72
FIELD_OF_VIEW = np.radians(30)
DIRECTION = np.array([-0.5, 0.6, 0.62])  # right, up, towards the viewer
SUNLIGHT, SKYLIGHT, GROUND = (255, 246, 232), (255, 255, 255), (196, 178, 160)
SUN, SKY = 6.5, 2.6


class Scene:
    """Nodes of a client's scene, updated in place; everything here runs in the server's event loop."""

    def __init__(self, client: ClientHandle):
        self.shown = Shown()
        self._client, self._scene = client, client.scene
        self._found: Found | None = None
        self._view: View | None = None
        self._axes = np.eye(3)
        self._tint = None
        self.is_pale = False
        self._folded, self._sheet = Paper(client.scene, "/folded"), Paper(client.scene, "/sheet")

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
        return self._sheet_place(found)[1]

    @property
    def points(self) -> np.ndarray:
        """Points (N, 3) of the paper, or the plates, on screen."""
        return self._folded.points

    @property
    def height_of_paper(self) -> float:
        """Smallest extent of the paper as it is on screen: that of the flat sheet is 0."""
        points = self.points
        return float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1] / np.sqrt(len(points)))

    def show(self, found: Found) -> None:
        """Show a solved design; what it lacks disappears."""
        self._found, self.is_pale = found, False
        if found.axes is not None:
            self._axes = found.axes
        with self._client.atomic():
            self.pose(found.folded)
            self._show_around(found)

    def pose(self, view: View | None) -> None:
        """Show another state, or plates, instead of the structure; marks that belong to it disappear."""
        with self._client.atomic():
            self._drop_tint()
            self._view = view
            self._folded.show(view, self.shown)
            self._remove(MARKS)

    def tint(self, tint: Tint) -> None:
        """Lay colours over the structure."""
        with self._client.atomic():
            self._drop_tint()
            self._folded.hide_paper()
            self._tint = self._scene.add_mesh_trimesh("/colours", _textured(tint), cast_shadow=False, receive_shadow=False)

    def pale(self) -> None:
        """Show that what is on screen is not the structure of the design any more."""
        self.is_pale = True
        with self._client.atomic():
            self._drop_tint()
            self._remove((*MARKS, *OVERLAP))
            for paper in (self._folded, self._sheet):
                paper.pale()

    def redraw(self) -> None:
        """Show the same again, after a switch was turned."""
        if self._found is None or self.is_pale:
            return
        with self._client.atomic():
            self._folded.show(self._view, self.shown)
            if self._tint is not None:
                self._folded.hide_paper()
            self._remove(MARKS)
            self._show_around(self._found)

    def frame(self) -> None:
        """Move the camera to where the whole structure, and the sheet beside it, is well seen."""
        middle, radius = self.extent
        found = self._found
        if found is not None and found.sheet is not None and self.shown.sheet:
            side, towards = self._sheet_place(found)[2], -self._axes[1] if self._is_upright else self._axes[0]
            middle, radius = middle + 0.5 * side * towards, radius + 0.5 * side
        camera = self._client.camera
        half = np.arctan(np.tan(0.5 * FIELD_OF_VIEW) * min(1.0, camera.aspect))
        camera.fov = FIELD_OF_VIEW
        distance = 1.05 * radius / np.sin(half)
        camera.near, camera.far = 0.002 * distance, 50 * distance
        camera.position = middle + self._axes[2] * distance
        camera.look_at = middle
        camera.up_direction = self._axes[1]
        self._light(middle, radius)

    def _light(self, middle: np.ndarray, radius: float) -> None:
        """Light from the upper left, as in the pictures of the command line, and from the sky."""
        self._scene.add_light_directional("/sun", color=SUNLIGHT, intensity=SUN, cast_shadow=False,
                                          position=middle + 20 * radius * (DIRECTION @ self._axes))
        self._scene.add_light_hemisphere("/sky", sky_color=SKYLIGHT, ground_color=GROUND, intensity=SKY,
                                         position=middle + self._axes[1])

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
        place, scale, _ = self._sheet_place(found)
        self._sheet.place(place, scale, _quaternion(self._axes))
        if found.overlap is not None:
            at = place + scale * (found.overlap @ self._axes[:2])
            self._mark("/overlap", at, 0.015 * self.extent[1], "overlaps here")

    @property
    def _is_upright(self) -> bool:
        """Whether the window is higher than wide, so that the sheet lies below."""
        return self._client.camera.aspect < 1

    def _sheet_place(self, found: Found) -> tuple[np.ndarray, float, float]:
        """Origin (3,) of the sheet, its scale, and how far it reaches beyond the structure."""
        assert found.sheet is not None
        assert found.folded is not None
        seen = found.folded.points @ self._axes.T
        low, high = seen.min(axis=0), seen.max(axis=0)
        flat = found.sheet.points[:, :2]
        size, room = np.ptp(flat, axis=0), float(np.linalg.norm(high - low))
        scale = 1 / max(1, np.ceil(SMALLEST * float(np.linalg.norm(size)) / room - 0.1))
        gap, corner = APART * room, 0.5 * (low + high)
        corner[:2] -= 0.5 * scale * size
        if self._is_upright:
            corner[1] = low[1] - gap - scale * size[1]
        else:
            corner[0] = high[0] + gap
        corner[:2] -= scale * flat.min(axis=0)
        return corner @ self._axes, float(scale), float(gap + scale * size[1 if self._is_upright else 0])

    def _show_marks(self, found: Found) -> None:
        if found.seed is not None and self.shown.seed:
            line = np.stack([found.seed[:-1], found.seed[1:]], axis=1).astype(np.float32)
            self._scene.add_line_segments("/seed", line, ink_bytes(SEED), thickness=3.0, thickness_units="screen")
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


def _textured(tint: Tint):
    """A trimesh.Trimesh with the scale as its texture, the last pixel for what is unknown."""
    from PIL import Image
    from trimesh import Trimesh
    from trimesh.visual import TextureVisuals
    from trimesh.visual.material import PBRMaterial

    unknown = np.round(255 * colours.rgb(colours.UNKNOWN)).astype(np.uint8)
    strip = np.concatenate([tint.bar, unknown[None]])[None].repeat(2, axis=0)
    last = len(tint.bar)
    column = np.where(np.isnan(tint.shares), last, np.nan_to_num(tint.shares) * (last - 1))
    places = np.column_stack([(column + 0.5) / (last + 1), np.full(len(column), 0.5)])
    paint = PBRMaterial(baseColorTexture=Image.fromarray(strip), metallicFactor=0.0, roughnessFactor=1.0, doubleSided=True)
    return Trimesh(tint.points, tint.triangles, visual=TextureVisuals(uv=places, material=paint), process=False)


def _quaternion(axes: np.ndarray) -> np.ndarray:
    """The turn (w, x, y, z) that takes the plane's axes to rows of `axes` (3, 3)."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(axes.T).as_quat()[[3, 0, 1, 2]]

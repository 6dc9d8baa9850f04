"""The scene of one client: paper, creases, rulings, the sheet beside, marks and the reference surface."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plisse.draw import colours
from plisse.studio.requests import Found
from plisse.studio.view import Tint, View

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Scene", "Shown"]

INKS = {"mountain": (colours.MOUNTAIN, 1.6), "valley": (colours.VALLEY, 1.6), "flat": (colours.RULING, 1.2),
        "boundary": (colours.EDGE, 1.4), "ruling": (colours.RULING, 0.7)}
GLASS = "#7f9bb0"
SEED, MARK = colours.INK, colours.MOUNTAIN
MARKS = ("/trouble", "/trouble/words", "/seed")
APART, SMALLEST = 0.12, 0.72
FIELD_OF_VIEW = np.radians(30)
DIRECTION = np.array([-0.5, 0.6, 0.62])  # right, up, towards the viewer
SUNLIGHT, SKYLIGHT, GROUND = (255, 246, 232), (255, 255, 255), (196, 178, 160)
SUN, SKY = 6.5, 2.6


@dataclass
class Shown:
    """What is switched on."""

    rulings: bool = False
    creases: bool = True
    sheet: bool = True
    seed: bool = True
    reference: bool = True


class Scene:
    """Nodes of a client's scene, updated in place; everything here runs in the server's event loop."""

    def __init__(self, client: ClientHandle):
        self.shown = Shown()
        self._client, self._scene = client, client.scene
        self._found: Found | None = None
        self._axes = np.eye(3)
        self._tint = None
        self._folded, self._sheet = _Paper(client.scene, "/folded"), _Paper(client.scene, "/sheet")

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
    def height_of_paper(self) -> float:
        """Smallest extent of the paper as it is on screen: that of the flat sheet is 0."""
        points = self._folded.points
        return float(np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1] / np.sqrt(len(points)))

    def show(self, found: Found) -> None:
        """Show a solved design; what it lacks disappears."""
        self._found = found
        if found.axes is not None:
            self._axes = found.axes
        with self._client.atomic():
            self.pose(found.folded)
            self._show_sheet(found)
            self._show_marks(found)
            self._show_reference(found)

    def pose(self, view: View | None) -> None:
        """Show another state, or plates, instead of the structure; marks that belong to it disappear."""
        with self._client.atomic():
            self._drop_tint()
            self._folded.show(view, self.shown)
            for name in MARKS:
                self._scene.remove_by_name(name)

    def tint(self, tint: Tint) -> None:
        """Lay colours over the structure."""
        with self._client.atomic():
            self._drop_tint()
            self._folded.hide_paper()
            self._tint = self._scene.add_mesh_trimesh("/colours", _textured(tint), cast_shadow=False, receive_shadow=False)

    def redraw(self) -> None:
        """Show the last design again, after a switch was turned."""
        if self._found is not None:
            self.show(self._found)

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

    def _drop_tint(self) -> None:
        if self._tint is not None:
            self._tint.remove()
            self._tint = None

    def _show_sheet(self, found: Found) -> None:
        view = found.sheet if self.shown.sheet else None
        self._sheet.show(view, self.shown)
        for name in ("/overlap", "/overlap/words"):
            self._scene.remove_by_name(name)
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
            self._scene.add_line_segments("/seed", line, _bytes(SEED), thickness=3.0, thickness_units="screen")
        if found.trouble is not None:
            self._mark("/trouble", found.trouble, 0.02 * self.extent[1], "problem here")

    def _mark(self, name: str, place: np.ndarray, radius: float, words: str) -> None:
        self._scene.add_icosphere(name, radius, _bytes(MARK), position=place, cast_shadow=False)
        self._scene.add_label(f"{name}/words", words)

    def _show_reference(self, found: Found) -> None:
        self._scene.remove_by_name("/reference")
        if found.reference is not None and self.shown.reference:
            points, triangles = found.reference
            self._scene.add_mesh_simple("/reference", points, triangles, color=_bytes(GLASS), opacity=0.25, side="double",
                                        cast_shadow=False, receive_shadow=False)


class _Paper:
    """A view as nodes: the front and the back of the paper, and its lines."""

    def __init__(self, scene, name: str):
        self._scene, self._name = scene, name
        self._frame = scene.add_frame(name, show_axes=False)
        self._sides: list = []
        self._lines: dict = {}

    @property
    def points(self) -> np.ndarray:
        """Points (N, 3) of the paper on screen."""
        return np.asarray(self._sides[0].vertices, dtype=float)

    def show(self, view: View | None, shown: Shown) -> None:
        """Show a view; None for nothing."""
        self._frame.visible = view is not None
        if view is None:
            return
        if not self._sides:
            self._sides = [self._scene.add_mesh_simple(
                f"{self._name}/{side}", view.points, view.triangles, color=_bytes(ink), side=side, receive_shadow=False,
                cast_shadow=False) for side, ink in (("front", colours.PAPER), ("back", colours.BACK_OF_PAPER))]
        for mesh in self._sides:
            mesh.vertices, mesh.faces = view.points, view.triangles
            mesh.visible = True
        for name, segments in view.lines.items():
            wanted = len(segments) > 0 and (shown.rulings if name == "ruling" else shown.creases)
            self._line(name, segments, wanted)

    def place(self, position: np.ndarray, scale: float, turn: np.ndarray) -> None:
        """Put everything at a position, scaled and turned by a quaternion (w, x, y, z)."""
        self._frame.position, self._frame.wxyz = position, turn
        for node in (*self._sides, *self._lines.values()):
            node.scale = scale

    def hide_paper(self) -> None:
        """Leave the lines only."""
        for mesh in self._sides:
            mesh.visible = False

    def _line(self, name: str, segments: np.ndarray, wanted: bool) -> None:
        node = self._lines.get(name)
        if node is None and wanted:
            ink, thickness = INKS[name]
            node = self._lines[name] = self._scene.add_line_segments(
                f"{self._name}/{name}", segments, _bytes(ink), thickness=thickness, thickness_units="screen")
        elif node is not None and wanted:
            node.points = segments
        if node is not None:
            node.visible = wanted


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


def _bytes(colour: str) -> tuple[int, int, int]:
    red, green, blue = np.round(255 * colours.rgb(colour)).astype(int).tolist()
    return red, green, blue


def _quaternion(axes: np.ndarray) -> np.ndarray:
    """The turn (w, x, y, z) that takes the plane's axes to rows of `axes` (3, 3)."""
    from scipy.spatial.transform import Rotation

    return Rotation.from_matrix(axes.T).as_quat()[[3, 0, 1, 2]]

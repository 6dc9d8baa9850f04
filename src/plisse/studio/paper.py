"""Paper in the scene: its front and back, and its lines by the kind of edge."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plisse.draw import colours
from plisse.studio.view import View

__all__ = ["Paper", "Shown", "ink_bytes"]

INKS = {"mountain": (colours.MOUNTAIN, 1.6), "valley": (colours.VALLEY, 1.6), "flat": (colours.RULING, 1.2),
        "boundary": (colours.EDGE, 1.4), "ruling": (colours.RULING, 0.7),
        "plate": (colours.EDGE, 1.1)}
PALE = 0.3  # opacity of what is not the structure of the design any more


@dataclass
class Shown:
    """What is switched on."""

    rulings: bool = False
    creases: bool = True
    sheet: bool = True
    seed: bool = True
    reference: bool = True


class Paper:
    """A view as nodes: the front and the back of the paper, and its lines."""

    def __init__(self, scene, name: str):
        self._scene, self._name = scene, name
        self._frame = scene.add_frame(name, show_axes=False)
        self._sides: list = []
        self._lines: dict = {}

    @property
    def points(self) -> np.ndarray:
        """Points (N, 3) of the paper on screen; none where nothing is shown."""
        if not self._sides or not self._frame.visible:
            return np.empty((0, 3))
        return np.asarray(self._sides[0].vertices, dtype=float)

    def show(self, view: View | None, shown: Shown) -> None:
        """Show a view; None for nothing."""
        self._frame.visible = view is not None
        if view is None:
            return
        if not self._sides:
            self._sides = [self._scene.add_mesh_simple(
                f"{self._name}/{side}", view.points, view.triangles, color=ink_bytes(ink), side=side, receive_shadow=False,
                cast_shadow=False) for side, ink in (("front", colours.PAPER), ("back", colours.BACK_OF_PAPER))]
        for mesh in self._sides:
            mesh.vertices = view.points
            if not np.array_equal(mesh.faces, view.triangles):
                mesh.faces = view.triangles
            mesh.opacity, mesh.visible = None, True
        for name in INKS:
            segments = view.lines.get(name, np.empty((0, 2, 3), np.float32))
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

    def pale(self) -> None:
        """Make the paper pale, also where something was shown instead of it, and leave its lines out."""
        for mesh in self._sides:
            mesh.opacity, mesh.visible = PALE, True
        for node in self._lines.values():
            node.visible = False

    def _line(self, name: str, segments: np.ndarray, wanted: bool) -> None:
        node = self._lines.get(name)
        if node is None and wanted:
            ink, thickness = INKS[name]
            node = self._lines[name] = self._scene.add_line_segments(
                f"{self._name}/{name}", segments, ink_bytes(ink), thickness=thickness, thickness_units="screen")
        elif node is not None and wanted:
            node.points = segments
        if node is not None:
            node.visible = wanted


def ink_bytes(colour: str) -> tuple[int, int, int]:
    """Red, green and blue in 0…255 of #rrggbb."""
    red, green, blue = np.round(255 * colours.rgb(colour)).astype(int).tolist()
    return red, green, blue

"""Light and colour: lamps around the structure, colours of a map, grooves that are dark once nothing moves."""

from __future__ import annotations

import asyncio

import numpy as np

from plisse.draw import colours
from plisse.draw.shade import BOUNCE
from plisse.io.gltf import TRIANGLES, Buffer, linear, primitive
from plisse.studio.paper import Paper
from plisse.studio.view import Tint, View
from plisse.studio.waiting import Later

__all__ = ["Grooves", "light", "shaded", "textured"]

# name, colour, intensity, and direction: right, up, towards the viewer; none of them is alone, so that no shadow is hard
LAMPS = (("/sun", (255, 243, 222), 5.8, (-0.75, 0.45, 0.5)), ("/day", (255, 250, 245), 1.5, (0.1, 0.9, 0.5)),
         ("/glow", (255, 235, 220), 0.7, (0.9, -0.1, 0.5)))
SKY, SKYLIGHT, GROUND = 1.0, (235, 240, 255), (170, 140, 120)
DARKNESS = 0.9  # of a groove that is closed
STILL, LOADED = 2.0, 1.0  # seconds after which grooves are shaded, and after which a browser shows them
PAPER = {"name": "paper", "doubleSided": False, "pbrMetallicRoughness": {"metallicFactor": 0.0, "roughnessFactor": 1.0}}


def light(scene, axes: np.ndarray, middle: np.ndarray, radius: float) -> None:
    """Put lamps and the sky around what is at `middle` (3,), as seen with `axes` (3, 3)."""
    for name, colour, intensity, direction in LAMPS:
        scene.add_light_directional(name, color=colour, intensity=intensity, cast_shadow=False,
                                    position=middle + 20 * radius * (np.array(direction) @ axes))
    scene.add_light_hemisphere("/sky", sky_color=SKYLIGHT, ground_color=GROUND, intensity=SKY, position=middle + axes[1])


class Grooves:
    """Takes the place of a paper with a shaded model of it when it has not changed for a while.

    Browsers take a moment to load a model, so that it cannot follow what moves.
    """

    def __init__(self, scene, name: str, paper: Paper, loop: asyncio.AbstractEventLoop):
        self._scene, self._name, self._paper = scene, name, paper
        self._still, self._loaded = Later(loop, STILL), Later(loop, LOADED)
        self._model = None

    def wait(self, view: View | None) -> None:
        """Show the paper as it is, and shade it later unless there is none."""
        self.leave()
        if view is not None and view.sky is not None:
            self._still.begin(lambda: self._shade(view))

    def stop(self) -> None:
        """Leave everything as it is."""
        self._still.cancel()
        self._loaded.cancel()

    def leave(self) -> None:
        """Take the model away, for the paper is not as it was."""
        self.stop()
        if self._model is not None:
            self._model.remove()
            self._model = None

    def _shade(self, view: View) -> None:
        self._model = self._scene.add_glb(self._name, shaded(view), cast_shadow=False, receive_shadow=False)
        self._loaded.begin(self._paper.hide_paper)


def shaded(view: View) -> bytes:
    """A .glb of a view: its front and its back, each vertex as bright as the sky that it sees."""
    assert view.sky is not None
    buffer = Buffer()
    position = buffer.vectors(view.points, bounds=True)
    sides = [primitive(TRIANGLES, {"POSITION": position, "COLOR_0": buffer.vectors(linear(colours.rgb(ink)) * _light(sky))},
                       buffer.indices(triangles), 0)
             for ink, sky, triangles in ((colours.PAPER, view.sky[:, :1], view.triangles),
                                         (colours.BACK_OF_PAPER, view.sky[:, 1:], view.triangles[:, ::-1]))]
    return buffer.packed({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                          "meshes": [{"primitives": sides}], "materials": [PAPER]})


def textured(tint: Tint):
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


def _light(sky: np.ndarray) -> np.ndarray:
    """Light (N, 3) of points that see a share (N, 1) in 0…255 of the sky: folds are lit by their own walls too."""
    share = sky / np.float32(255)
    return 1 - DARKNESS * (1 - share / (1 - BOUNCE * (1 - share)))

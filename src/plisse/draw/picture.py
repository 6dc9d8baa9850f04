"""A picture of a folded structure: as photographed paper, or in the colours of a quality, still or turning."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import BinaryIO

import numpy as np

from plisse.draw.animation import paletted
from plisse.draw.camera import Camera, best_view
from plisse.draw.colour_bar import draw_colour_bar
from plisse.draw.colour_maps import ColourMap
from plisse.draw.folded import DOTS_PER_INCH, draw_folded, line_width
from plisse.draw.ground import ground
from plisse.draw.light import Fineness
from plisse.draw.render import render
from plisse.draw.runs import Run, lettered_runs
from plisse.structure.pleated import PleatedStructure

__all__ = ["Style", "picture", "turntable", "write_picture", "write_turntable"]

RIM, MARGIN, BAND = 6, 0.05, 0.13  # pixels, then shares of the shorter side
SECONDS_PER_TURN = 6.0


@dataclass(frozen=True, eq=False)
class Style:
    """What a picture shows: crease lines or none, a colour map instead of paper, a transparent ground, cast light."""

    size: tuple[int, int] = (1600, 1200)
    creases: bool = True
    colour: ColourMap | None = None
    transparent: bool = False
    ambient: bool = True


def write_picture(structure: PleatedStructure, path: str | Path | BinaryIO, *, camera: Camera | None = None,
                  style: Style | None = None, runs: list[Run] | None = None) -> None:
    """Write a PNG of the structure; equal subjects give equal bytes."""
    from PIL import Image

    Image.fromarray(picture(structure, camera=camera, style=style, runs=runs)).save(path, format="PNG", compress_level=6)


def write_turntable(structure: PleatedStructure, path: str | Path, *, elevation: float = 35.0, frames: int = 36,
                    style: Style | None = None) -> None:
    """Write an endless .gif of one turn around the z axis, seen from `elevation` degrees above."""
    from PIL import Image

    style = Style(size=(720, 540)) if style is None else style
    images = paletted([Image.fromarray(frame).convert("RGB") for frame in turntable(structure, elevation, frames, style)])
    images[0].save(path, format="GIF", save_all=True, append_images=images[1:], loop=0,
                   duration=round(1000 * SECONDS_PER_TURN / frames))


def picture(structure: PleatedStructure, *, camera: Camera | None = None, style: Style | None = None,
            runs: list[Run] | None = None) -> np.ndarray:
    """Pixels (H, W, 4) of the structure, as large as fits, seen by the camera or from where it shows most.

    `runs` are the lines to draw, if not its own.
    """
    camera, style = best_view(structure) if camera is None else camera, Style() if style is None else style
    seen = camera.project(structure.vertices)[:, :2]
    low, high = seen.min(axis=0), seen.max(axis=0)
    room = _room(style)
    scale = float((room / np.maximum(high - low, 1e-12 * np.ptp(seen))).min())
    lines = _lines(structure, style) if runs is None else runs
    return _drawn(structure, camera, scale, (low + high) / 2, style, lines)


def turntable(structure: PleatedStructure, elevation: float, frames: int, style: Style) -> Iterator[np.ndarray]:
    """One turn around the z axis in `frames` pictures (H, W, 4), all at one scale; `elevation` in degrees."""
    low, high = structure.vertices.min(axis=0), structure.vertices.max(axis=0)
    centre, tilt = (low + high) / 2, np.radians(elevation)
    away = structure.vertices - centre
    reach, tall = np.hypot(away[:, 0], away[:, 1]).max(), np.abs(away[:, 2]).max()
    extent = 2 * np.array([reach, reach * abs(np.sin(tilt)) + tall * np.cos(tilt)])
    scale, lines = float((_room(style) / extent).min()), _lines(structure, style)
    for azimuth in np.linspace(0, 2 * np.pi, frames, endpoint=False) - np.pi / 2:
        camera = Camera.at(azimuth, tilt)
        yield _drawn(structure, camera, scale, camera.project(centre)[:2], style, lines)


def _room(style: Style) -> np.ndarray:
    """Width and height in pixels that the structure may take."""
    shorter = min(style.size)
    return np.array(style.size) - 2 * MARGIN * shorter - [0, BAND * shorter if style.colour is not None else 0]


def _lines(structure: PleatedStructure, style: Style) -> list[Run]:
    """Lines to draw: none, mountains and valleys, or all in ink where colours say something else."""
    runs = lettered_runs(structure) if style.creases else []
    return runs if style.colour is None else [run._replace(letter="B") for run in runs if run.letter != "R"]


def _drawn(structure: PleatedStructure, camera: Camera, scale: float, middle: np.ndarray, style: Style,
           lines: list[Run]) -> np.ndarray:
    """The page with `middle` (2,), in the camera's plane, in the middle of the room."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = style.size
    fineness = Fineness(cast=style.ambient)
    shown = render(structure, camera, scale, RIM, style.colour, fineness)
    lift = BAND * min(style.size) / 2 if style.colour is not None else 0
    corner = np.round(np.array([width / 2, height / 2 + lift]) - (middle - shown.origin[:2]) * scale)
    figure = Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=DOTS_PER_INCH, facecolor="none")
    axes = figure.add_axes((0, 0, 1, 1), facecolor="none")
    axes.set_axis_off()
    axes.set(xlim=(0, width), ylim=(0, height))
    if not style.transparent:
        below = ground(style.size, shown.image[..., 3], corner, shown.triangles, camera, fineness)
        axes.imshow(below, origin="lower", interpolation="bilinear", aspect="auto", zorder=0, extent=(0, width, 0, height))
    draw_folded(axes, shown, structure, corner, line_width(structure, scale), lines)
    if style.colour is not None:
        draw_colour_bar(figure, style.colour, style.size)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.array(canvas.buffer_rgba())

"""Several structures side by side at one scale, from one side, each with its caption."""

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from plisse.draw import colours
from plisse.draw.camera import Camera
from plisse.draw.folded import DOTS_PER_INCH, draw_folded, line_width
from plisse.draw.render import Rendering, render
from plisse.draw.runs import Run
from plisse.draw.table import table
from plisse.structure.pleated import PleatedStructure

__all__ = ["write_row"]

WIDTH = 2400
LOWEST, HIGHEST = 480, 1200
MARGIN, GAP, TITLE_BAND, CAPTION_BAND, RIM = 70, 55, 110, 70, 6
VEIL = 0.6
SLOT = 230  # that captions need


def write_row(structures: Sequence[PleatedStructure], captions: Sequence[str], path: str | Path, *, camera: Camera,
              title: str = "", facts: Sequence[str] = (), runs: Sequence[Run] | None = None,
              faded: Sequence[bool] = (), arrows: Mapping[int, np.ndarray] | None = None) -> None:
    """Write a PNG of structures in a row, as seen by the camera; `facts` stand small in the corner.

    `runs` are the lines to draw on every one of them, if not each its own. Those that are `faded` are drawn lighter.
    `arrows` (K, 2, 3) run from places on the structures with these numbers, counted from 0, to others.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    scale, height = _fitted([camera.project(structure.vertices)[:, :2] for structure in structures])
    pictures = [render(structure, camera, scale, RIM) for structure in structures]
    corners = _corners(pictures, height)
    figure = Figure(figsize=(WIDTH / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=DOTS_PER_INCH, facecolor=colours.BACKGROUND)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set_xlim(0, WIDTH)
    axes.set_ylim(0, height)
    axes.imshow(table((WIDTH, height), _coverage(pictures, corners, height), np.zeros(2), []), origin="lower", aspect="auto",
                interpolation="bilinear", zorder=0, extent=(0, WIDTH, 0, height))
    for structure, picture, corner, caption in zip(structures, pictures, corners, captions, strict=True):
        draw_folded(axes, picture, structure, corner, line_width(structure, scale), runs)
        axes.text(corner[0] + picture.image.shape[1] / 2, TITLE_BAND + CAPTION_BAND / 2 - 14, caption, fontsize=8,
                  color=colours.INK, ha="center", va="center", parse_math=False)
    for _, picture, corner in filter(lambda entry: entry[0], zip(faded, pictures, corners, strict=False)):
        _veil(axes, picture, corner)
    for number, pairs in (arrows or {}).items():
        _draw_arrows(axes, [pictures[number].pixels(pair)[:, :2] + corners[number] for pair in pairs])
    axes.text(MARGIN, 56, title, fontsize=11, color=colours.INK, va="center", parse_math=False)
    axes.text(WIDTH - MARGIN, 56, "   ·   ".join(facts), fontsize=7, color=colours.CAPTION, va="center", ha="right")
    FigureCanvasAgg(figure).print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 4})


def _veil(axes, picture: Rendering, corner: np.ndarray) -> None:
    """Cover a picture with the colour of the ground, so that it looks lighter."""
    from matplotlib.colors import to_rgb

    height, width = picture.image.shape[:2]
    image = np.empty((height, width, 4))
    image[..., :3], image[..., 3] = to_rgb(colours.BACKGROUND), VEIL * picture.image[..., 3]
    axes.imshow(image, origin="lower", interpolation="nearest", aspect="auto", zorder=4,
                extent=(corner[0], corner[0] + width, corner[1], corner[1] + height))


def _draw_arrows(axes, pairs: Sequence[np.ndarray]) -> None:
    """Draw arrows between pairs (2, 2) of pixels, each from a dot."""
    for start, end in pairs:
        axes.plot(*start, "o", color=colours.INK, markersize=4, zorder=5)
        axes.annotate("", xy=end, xytext=start, zorder=5, annotation_clip=False,
                      arrowprops={"arrowstyle": "-|>", "color": colours.INK, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0})


def _fitted(clouds: list[np.ndarray]) -> tuple[float, int]:
    """Pixels per model unit at which all pictures fit beside each other, and the height of the page."""
    sizes = np.array([np.ptp(cloud, axis=0) for cloud in clouds])
    bands = TITLE_BAND + CAPTION_BAND + MARGIN
    room = WIDTH - 2 * MARGIN - GAP * (len(clouds) - 1)
    scale, narrow = (HIGHEST - bands) / sizes[:, 1].max(), np.zeros(len(sizes), bool)
    for _ in range(len(sizes)):
        wide = sizes[~narrow, 0].sum()
        scale = float(min(scale, (room - SLOT * narrow.sum()) / wide)) if wide > 0 else scale
        narrow = scale * sizes[:, 0] < SLOT
    return scale, int(np.clip(np.ceil(scale * sizes[:, 1].max()) + bands, LOWEST, HIGHEST))


def _corners(pictures: list[Rendering], height: int) -> list[np.ndarray]:
    """Lower left corners (2,) in pixels: centred one by one, the row spread over the page."""
    sizes = np.array([picture.image.shape[1::-1] for picture in pictures])
    slots = np.maximum(sizes[:, 0], SLOT)
    gap = (WIDTH - 2 * MARGIN - slots.sum()) / max(len(pictures), 2)
    left = MARGIN + gap / 2 + np.concatenate([[0], np.cumsum(slots[:-1] + gap)]) + 0.5 * (slots - sizes[:, 0])
    if len(pictures) == 1:
        left = np.array([(WIDTH - sizes[0, 0]) / 2])
    middle = 0.5 * (TITLE_BAND + CAPTION_BAND + height - MARGIN)
    return [np.round([x, middle - tall / 2]) for x, tall in zip(left, sizes[:, 1], strict=True)]


def _coverage(pictures: list[Rendering], corners: list[np.ndarray], height: int) -> np.ndarray:
    """Where the page is covered, in 0…1 (height, WIDTH)."""
    page = np.zeros((height, WIDTH), np.float32)
    for picture, corner in zip(pictures, corners, strict=True):
        column, row = np.maximum(corner.astype(int), 0)
        part = page[row:row + picture.image.shape[0], column:column + picture.image.shape[1]]
        np.maximum(part, picture.image[:part.shape[0], :part.shape[1], 3], out=part)
    return page

"""Many small pictures on one page, each with what it is and what became of it."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

import numpy as np

from plisse.draw import colours
from plisse.draw.thumbnail import THUMBNAIL

__all__ = ["MOST", "Frame", "outcome_colour", "write_contact_sheet"]

MOST = 120
DOTS_PER_INCH = 100
MARGIN, TITLE, CAPTION, GAP = 24, 56, 58, 10  # pixels
LETTERS, LINES = 46, 3  # of a caption
GROUND = "#efebe3"
_COLOURS = {"exact": "#4f7f52", "approximate": "#d8a33c", "infeasible": "#b8432f", "invalid": "#8d8271",
            "timeout": "#6b4a86", "memory": "#2f5f8a", "failed": "#2e2a27"}


class Frame(NamedTuple):
    """One picture: its PNG if there is one, what it shows, what is said of it, and the outcome that colours its bar."""

    png: bytes | None
    design: str
    verdict: str
    outcome: str


def outcome_colour(outcome: str) -> str:
    """One colour (#rrggbb) per outcome in all pictures of studies."""
    return _COLOURS.get(outcome, colours.CAPTION)


def write_contact_sheet(frames: Sequence[Frame], path: str | Path, *, title: str = "") -> None:
    """Write a PNG of up to MOST frames in rows; equal frames give equal bytes."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    frames = frames[:MOST]
    columns = max(3, min(12, int(np.ceil(np.sqrt(1.25 * len(frames))))))
    rows = max(1, -(-len(frames) // columns))
    cell = np.array([THUMBNAIL[0] + GAP, THUMBNAIL[1] + CAPTION + GAP])
    width, height = (int(side) for side in cell * [columns, rows] - GAP + [2 * MARGIN, 2 * MARGIN + TITLE])
    page = np.ones((height, width, 3)) * colours.rgb(colours.BACKGROUND)
    figure = Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=DOTS_PER_INCH)
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set(xlim=(0, width), ylim=(height, 0))
    for k, frame in enumerate(frames):
        left, top = cell * [k % columns, k // columns] + [MARGIN, MARGIN + TITLE]
        across, foot = slice(left, left + THUMBNAIL[0]), top + THUMBNAIL[1]
        page[top:foot, across] = _picture(frame)
        page[foot:foot + 4, across] = colours.rgb(outcome_colour(frame.outcome))
        for number, (line, colour) in enumerate(_lines(frame)):
            axes.text(left + 2, foot + 14 + 15 * number, line, fontsize=6.5, va="center", color=colour, parse_math=False)
        if frame.png is None:
            axes.text(left + THUMBNAIL[0] / 2, top + THUMBNAIL[1] / 2, frame.outcome, fontsize=9, ha="center", va="center",
                      color=colours.CAPTION)
    axes.imshow(page, extent=(0, width, height, 0), interpolation="nearest", aspect="auto", zorder=0)
    axes.text(MARGIN, MARGIN + TITLE / 2 - 8, title, fontsize=11, va="center", color=colours.INK, parse_math=False)
    FigureCanvasAgg(figure).print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 6})


def _lines(frame: Frame) -> list[tuple[str, str]]:
    """Lines of a caption with their colours: what it is in one or two, what became of it in the last."""
    from textwrap import shorten, wrap

    design = wrap(frame.design, LETTERS, max_lines=LINES - 1, placeholder=" …")
    verdict = shorten(frame.verdict, LETTERS, placeholder=" …")
    return [(line, colours.INK) for line in design] + [(verdict, colours.CAPTION)]


def _picture(frame: Frame) -> np.ndarray:
    """Pixels (H, W, 3) of a frame on its ground."""
    ground = np.ones((THUMBNAIL[1], THUMBNAIL[0], 3)) * colours.rgb(GROUND)
    if frame.png is None:
        return ground
    from PIL import Image

    with Image.open(BytesIO(frame.png)) as image:
        pixels = np.asarray(image.convert("RGBA"), float) / 255
    return ground * (1 - pixels[..., 3:]) + pixels[..., :3] * pixels[..., 3:]

"""Many small pictures on one page, each with what it is and what became of it."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from plisse.draw import colours
from plisse.draw.letters import letters_as_boxes
from plisse.draw.thumbnail import THUMBNAIL

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

__all__ = ["MOST", "Frame", "outcome_colour", "write_contact_sheet"]

MOST = 120
DOTS_PER_INCH = 100
MARGIN, TITLE, CAPTION, BAR, GAP = 24, 56, 58, 4, 10  # pixels
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


@letters_as_boxes()
def write_contact_sheet(frames: Sequence[Frame], path: str | Path, *, title: str = "") -> None:
    """Write a PNG of up to MOST frames in rows; equal frames give equal bytes."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure
    from PIL import Image

    frames = frames[:MOST]
    columns = max(3, min(12, int(np.ceil(np.sqrt(1.25 * len(frames))))))
    rows = max(1, -(-len(frames) // columns))
    cell = np.array([THUMBNAIL[0] + GAP, THUMBNAIL[1] + CAPTION + GAP])
    width, height = (int(side) for side in cell * [columns, rows] - GAP + [2 * MARGIN, 2 * MARGIN + TITLE])
    page = Image.new("RGBA", (width, height), colours.BACKGROUND)
    figure = Figure(figsize=(width / DOTS_PER_INCH, height / DOTS_PER_INCH), dpi=DOTS_PER_INCH, facecolor="none")
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    axes.set(xlim=(0, width), ylim=(height, 0))
    for k, frame in enumerate(frames):
        left, top = (int(side) for side in cell * [k % columns, k // columns] + [MARGIN, MARGIN + TITLE])
        foot = top + THUMBNAIL[1]
        page.paste(_picture(frame), (left, top))
        page.paste(outcome_colour(frame.outcome), (left, foot, left + THUMBNAIL[0], foot + BAR))
        for number, (line, colour) in enumerate(_lines(frame)):
            axes.text(left + 2, foot + 14 + 15 * number, line, fontsize=6.5, va="center", color=colour, parse_math=False)
        if frame.png is None:
            axes.text(left + THUMBNAIL[0] / 2, top + THUMBNAIL[1] / 2, frame.outcome, fontsize=9, ha="center", va="center",
                      color=colours.CAPTION)
    axes.text(MARGIN, MARGIN + TITLE / 2 - 8, title, fontsize=11, va="center", color=colours.INK, parse_math=False)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    page.alpha_composite(Image.frombuffer("RGBA", canvas.get_width_height(), canvas.buffer_rgba()))
    page.convert("RGB").save(path, format="PNG")


def _lines(frame: Frame) -> list[tuple[str, str]]:
    """Lines of a caption with their colours: what it is in one or two, what became of it in the last."""
    from textwrap import shorten, wrap

    design = wrap(frame.design, LETTERS, max_lines=LINES - 1, placeholder=" …")
    verdict = shorten(frame.verdict, LETTERS, placeholder=" …")
    return [(line, colours.INK) for line in design] + [(verdict, colours.CAPTION)]


def _picture(frame: Frame) -> "Picture":
    """A frame's picture on its ground."""
    from PIL import Image

    ground = Image.new("RGBA", THUMBNAIL, GROUND)
    if frame.png is not None:
        with Image.open(BytesIO(frame.png)) as image:
            ground.alpha_composite(image.convert("RGBA"))
    return ground

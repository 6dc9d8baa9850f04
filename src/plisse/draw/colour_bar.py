"""The bar below a picture that says what its colours mean."""

import numpy as np

from plisse.draw import colours
from plisse.draw.colour_maps import ColourMap

__all__ = ["draw_colour_bar"]


def draw_colour_bar(figure, colour: ColourMap, size: tuple[int, int]) -> None:
    """Draw title, bar and ticks at the bottom of a figure of `size` in pixels, letters in proportion to it."""
    shorter = min(size)
    width, unit = min(0.9 * size[0], 0.9 * shorter), shorter / 1000
    points = 72 / figure.dpi
    bar = figure.add_axes(((size[0] - width) / 2 / size[0], 58 * unit / size[1], width / size[0], 20 * unit / size[1]))
    shares = np.linspace(0, 1, 256)
    scale = colour.scale
    bar.imshow(colour.colours(scale.values(shares))[None], aspect="auto", extent=(0, 1, 0, 1))
    places, labels = zip(*scale.ticks(), strict=True)
    bar.set(yticks=[], xlim=(0, 1))
    bar.set_xticks(places, labels)
    bar.tick_params(labelsize=20 * unit * points, colors=colours.INK, length=5 * unit * points, width=unit * points,
                    pad=5 * unit * points)
    bar.spines[:].set(linewidth=unit * points, color=colours.CAPTION)
    note = f", largest {colour.largest:.2g}"
    if colour.name == "opening":
        note = f", {colour.smallest:.1f}° to {colour.largest:.1f}°"
    bar.set_title(colour.title + note, fontsize=22 * unit * points, color=colours.INK, pad=8 * unit * points, loc="left",
                  parse_math=False)

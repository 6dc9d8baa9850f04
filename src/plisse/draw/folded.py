"""A folded structure drawn on the page: its rendering, and over it the creases that are seen."""

from collections.abc import Iterable

import numpy as np

from plisse.draw import colours
from plisse.draw.render import Rendering
from plisse.draw.runs import Run, lettered_runs
from plisse.structure.pleated import PleatedStructure

__all__ = ["DOTS_PER_INCH", "draw_folded", "draw_lines", "line_width"]

DOTS_PER_INCH = 200


def line_width(structure: PleatedStructure, scale: float, least: float = 0.16) -> float:
    """Width of crease lines in points at `scale` pixels per model unit: a small part of the strips, never heavy."""
    edges = structure.topology.edges
    a, b = structure.vertices[edges.vertices[~edges.is_crease].T]
    strip = np.median(np.linalg.norm(a - b, axis=1)) * scale * 72 / DOTS_PER_INCH
    return float(np.clip(strip / 20, least, 0.7))


def draw_folded(axes, picture: Rendering, structure: PleatedStructure, corner: np.ndarray,
                width_of_lines: float, runs: Iterable[Run] | None = None) -> None:
    """Put a rendering with its `corner` (2,) at a pixel of the axes, and over it the visible creases and rims.

    `runs` stand for the structure's own where its folds do not tell mountains from valleys.
    """
    height, width = picture.image.shape[:2]
    corner = np.round(corner)
    axes.imshow(picture.image, origin="lower", interpolation="nearest", aspect="auto", zorder=2,
                extent=(corner[0], corner[0] + width, corner[1], corner[1] + height))
    lines: dict[str, list[np.ndarray]] = {letter: [] for letter in "BMVFR"}
    for run in lettered_runs(structure) if runs is None else runs:
        if run.letter != "R":
            path = structure.vertices[run.vertices]
            path = np.concatenate([path, path[:1]]) if run.closed else path
            lines[run.letter] += [part + corner for part in picture.visible(path)]
    draw_lines(axes, lines["B"], colours.EDGE, 0.6 * width_of_lines, 0.75, 3)
    draw_lines(axes, lines["V"], colours.VALLEY, width_of_lines, 0.85, 3)
    draw_lines(axes, lines["M"], colours.MOUNTAIN, width_of_lines, 0.85, 3)


def draw_lines(axes, lines: list[np.ndarray], colour: str, width: float, alpha: float, zorder: int) -> None:
    """Draw polylines (N, 2) in pixels, `width` in points."""
    from matplotlib.collections import LineCollection

    axes.add_collection(LineCollection(lines, colors=colour, linewidths=width, alpha=alpha, zorder=zorder,
                                       capstyle="round", joinstyle="round"))

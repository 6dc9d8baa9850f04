"""candidates.png: layouts side by side, as seen from above in the chart of the surface."""

from collections.abc import Sequence
from io import BytesIO
from pathlib import Path

import numpy as np

from plisse.draw import colours
from plisse.geometry.mesh import ReferenceMesh
from plisse.layout.rows import ChartedSurface
from plisse.solve.whole_surface import Candidate

__all__ = ["candidate_png", "write_candidates"]

DOTS_PER_INCH = 150
ACROSS, LARGEST, ALONE = 5, 10.0, 4.0  # pictures in a row, inches of a row and of a single one
TITLE, CAPTION, GAP = 0.45, 0.2, 0.16  # inches
CHOSEN = colours.MOUNTAIN


def write_candidates(candidates: Sequence[Candidate], chosen: int, mesh: ReferenceMesh, surface: ChartedSurface,
                     path: str | Path, *, title: str = "") -> None:
    """Write a PNG with one picture per candidate: the outline of the mesh, rows of the pleats over it, coverage.

    Creases are coloured in turn as mountains and valleys; what was taken away or left out stays empty. The candidate
    numbered `chosen` is framed.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    outline, low, high = _extent(mesh, surface)
    across = max(1, min(ACROSS, len(candidates)))
    down = -(-len(candidates) // across)
    width = min(LARGEST / across, 4.0)
    height = _height(width, low, high)
    size = (across * (width + GAP) + GAP, down * (height + CAPTION + GAP) + TITLE + GAP)
    figure = Figure(figsize=size, dpi=DOTS_PER_INCH, facecolor=colours.BACKGROUND)
    canvas = FigureCanvasAgg(figure)
    figure.text(GAP / size[0], 1 - 0.55 * TITLE / size[1], title, fontsize=11, color=colours.INK, va="center")
    for k, candidate in enumerate(candidates):
        row, column = divmod(k, across)
        left = GAP + column * (width + GAP)
        bottom = size[1] - TITLE - (row + 1) * (height + CAPTION + GAP)
        axes = figure.add_axes((left / size[0], bottom / size[1], width / size[0], height / size[1]),
                               facecolor=colours.PAPER)
        _draw(axes, candidate, surface, outline, low, high, width * DOTS_PER_INCH)
        axes.spines[:].set(color=CHOSEN if k == chosen else colours.RULING, linewidth=2.0 if k == chosen else 0.4)
        axes.set_title(f"{k + 1}   {_said(candidate)}", fontsize=7, loc="left", pad=4,
                       color=CHOSEN if k == chosen else colours.INK)
    canvas.print_png(str(path), metadata={"Software": None})


def candidate_png(candidate: Candidate, mesh: ReferenceMesh, surface: ChartedSurface) -> bytes:
    """The picture of one candidate alone, as a PNG without words."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    outline, low, high = _extent(mesh, surface)
    height = _height(ALONE, low, high)
    figure = Figure(figsize=(ALONE, height), dpi=DOTS_PER_INCH, facecolor=colours.PAPER)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0), facecolor=colours.PAPER)
    axes.spines[:].set_visible(False)
    _draw(axes, candidate, surface, outline, low, high, ALONE * DOTS_PER_INCH)
    content = BytesIO()
    FigureCanvasAgg(figure).print_png(content, metadata={"Software": None})
    return content.getvalue()


def _extent(mesh: ReferenceMesh, surface: ChartedSurface) -> tuple[list[np.ndarray], np.ndarray, np.ndarray]:
    """The outline in the chart as closed lines (K, 2), and the corners (2,) of what is to be seen around it."""
    outline = [surface.to_plane(mesh.vertices[np.append(loop, loop[0])])[:, :2] for loop in mesh.boundary_loops]
    places = surface.to_plane(mesh.vertices)[:, :2]
    low, high = places.min(axis=0), places.max(axis=0)
    margin = 0.06 * (high - low).max()
    return outline, low - margin, high + margin


def _height(width: float, low: np.ndarray, high: np.ndarray) -> float:
    return float(np.clip(width * (high[1] - low[1]) / (high[0] - low[0]), 0.5 * width, 1.6 * width))


def _said(candidate: Candidate) -> str:
    note = f"{candidate.mean_deviation:.2f} amplitudes"
    if candidate.seams:
        note += f", {len(candidate.seams)} seams"
    if not candidate.solved.is_sound:
        note = "not regular" if candidate.solved.is_exact else "not exact"
    return f"{100 * candidate.coverage:.1f} % covered, {note}"


def _draw(axes, candidate: Candidate, surface: ChartedSurface, outline: list[np.ndarray], low: np.ndarray,
          high: np.ndarray, pixels: float) -> None:
    from matplotlib.collections import LineCollection, PolyCollection

    topology, rows = candidate.solved.grid.topology, candidate.solved.grid.rows
    plane = surface.to_plane(candidate.solved.vertices)[:, :2]
    axes.add_collection(PolyCollection(plane[topology.quads], facecolors=colours.BACK_OF_PAPER, edgecolors="none",
                                       antialiased=False))
    lines, inks = [], []
    for crease in topology.creases:
        line = plane[crease.vertices]
        lines.append(np.concatenate([line, line[:1]]) if crease.closed else line)
        inks.append(colours.MOUNTAIN if rows[crease.vertices[0]] % 2 else colours.VALLEY)
    thickness = float(np.clip(pixels / max(len(np.unique(rows)), 1) / 12, 0.3, 1.0))
    axes.add_collection(LineCollection(lines, colors=inks, linewidths=thickness))
    axes.add_collection(LineCollection(outline, colors=colours.INK, linewidths=1.1))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xticks=[], yticks=[])
    axes.set_aspect("equal", adjustable="datalim")

"""A map over two parameters: where designs succeed, and what becomes of the others."""

from collections import Counter
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np

from plisse.draw import colours
from plisse.draw.contact_sheet import outcome_colour
from plisse.draw.letters import letters_as_boxes

__all__ = ["Place", "places", "write_region"]

DOTS_PER_INCH = 150
PANEL = 3.4  # inches
LARGEST, SMALLEST = 420.0, 14.0  # points²


class Place(NamedTuple):
    """One point of a map with the number of designs there, by outcome."""

    panel: object
    x: object
    y: object
    counts: Counter


def places(designs: Iterable[tuple[object, object, object, str]]) -> list[Place]:
    """Places of designs given as (panel, x, y, outcome): designs that differ in other keys only share one."""
    found: dict[tuple, Place] = {}
    for panel, x, y, outcome in designs:
        key = tuple(map(repr, (panel, x, y)))
        found.setdefault(key, Place(panel, x, y, Counter())).counts[outcome] += 1
    return list(found.values())


@letters_as_boxes()
def write_region(found: Sequence[Place], path: str | Path, *, labels: tuple[str, str], panels: str | None = None,
                 outcomes: Sequence[str] = (), title: str = "") -> None:
    """Write a PNG with a disk per place, whose rings are the shares of outcomes there, the first of them innermost.

    `labels` are the names of x and y, `panels` that of the parameter that divides the map. Values that are no numbers
    stand side by side in their order.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    names = _distinct(place.panel for place in found)
    across = min(len(names), 4) or 1
    down = -(-len(names) // across) or 1
    figure = Figure(figsize=(PANEL * across + 0.5, PANEL * down + 1.1), dpi=DOTS_PER_INCH, facecolor=colours.BACKGROUND,
                    layout="constrained")
    grid = figure.subplots(down, across, squeeze=False, sharex=True, sharey=True)
    x_scale, y_scale = _scale([place.x for place in found]), _scale([place.y for place in found])
    size = float(np.clip((PANEL * 72 * 0.75) ** 2 / max(len(found) / max(len(names), 1), 1) * 0.35, SMALLEST, LARGEST))
    label = {"fontsize": 8, "color": colours.INK, "parse_math": False}
    for number, axes in enumerate(grid.ravel()):
        if number >= max(len(names), 1):
            axes.set_axis_off()
            continue
        here = [place for place in found if not names or repr(place.panel) == repr(names[number])]
        _draw(axes, here, x_scale, y_scale, size, outcomes)
        axes.set_xlabel(labels[0], **label)
        axes.set_ylabel(labels[1], **label)
        if panels is not None:
            axes.set_title(f"{panels} = {_written(names[number])}", **label)
    _legend(figure, found, outcomes)
    figure.suptitle(title, fontsize=10, color=colours.INK, parse_math=False)
    FigureCanvasAgg(figure).print_png(str(path), metadata={"Software": None}, pil_kwargs={"compress_level": 6})


def _draw(axes, found: Sequence[Place], x_scale, y_scale, size: float, outcomes: Sequence[str]) -> None:
    """Disks from the whole one inwards, so that areas are shares."""
    axes.set_facecolor("#f4f0e8")
    x, y = (np.array([scale(value) for value in values], float) for scale, values in
            ((x_scale, [place.x for place in found]), (y_scale, [place.y for place in found])))
    counts = np.array([[place.counts[outcome] for outcome in outcomes] for place in found], float).reshape(len(found), -1)
    share = np.cumsum(counts, axis=1) / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    for k in reversed(range(len(outcomes))):
        some = counts[:, k] > 0
        axes.scatter(x[some], y[some], s=size * share[some, k], c=outcome_colour(outcomes[k]), linewidths=0, zorder=3)
    for axis, scale in ((axes.xaxis, x_scale), (axes.yaxis, y_scale)):
        if scale.words:
            axis.set_ticks(range(len(scale.words)), [text[:16] for text in scale.words], parse_math=False)
    axes.tick_params(labelsize=7, colors=colours.CAPTION)
    axes.spines[:].set(color=colours.CAPTION, linewidth=0.4)
    axes.margins(0.12)


class _scale:
    """Where a value stands on an axis: numbers at their value, others side by side."""

    def __init__(self, values: Sequence[object]):
        numeric = all(isinstance(value, int | float) and not isinstance(value, bool) for value in values)
        self.words = [] if numeric else [_written(value) for value in _distinct(values)]

    def __call__(self, value: object) -> float:
        if self.words:
            return float(self.words.index(_written(value)))
        assert isinstance(value, int | float)
        return float(value)


def _legend(figure, found: Sequence[Place], outcomes: Sequence[str]) -> None:
    from matplotlib.lines import Line2D

    total = sum((place.counts for place in found), Counter())
    entries = [(Line2D([], [], marker="o", linestyle="", color=outcome_colour(outcome)), f"{outcome} {total[outcome]}")
               for outcome in outcomes if total[outcome]]
    if entries:
        figure.legend(*zip(*entries, strict=True), loc="outside lower center", ncols=len(entries), fontsize=8, frameon=False)


def _distinct(values: Iterable[object]) -> list:
    """Each value once, numbers rising, others as they come."""
    once = list({repr(value): value for value in values}.values())
    try:
        return sorted(once)
    except TypeError:
        return once


def _written(value: object) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value).lower() if isinstance(value, bool) else str(value)

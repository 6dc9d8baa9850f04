"""A flat drawing: named layers of lines and words in millimetres, between geometry and file formats."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from plisse.draw.runs import lettered_runs
from plisse.draw.shapes import Arc, Line, Shape, Spline, Text
from plisse.draw.strokes import MACHINE, Stroke
from plisse.recipe import MILLIMETRES
from plisse.structure.front import front_up
from plisse.structure.pleated import PleatedStructure

__all__ = ["Arc", "Drawing", "Layer", "Line", "Spline", "Text", "captioned", "crease_pattern"]

LAYERS = {"R": "ruling", "B": "boundary", "M": "mountain", "V": "valley", "F": "flat"}


@dataclass(frozen=True, eq=False)
class Layer:
    """Lines and texts that one tool or colour draws; without a stroke the machine's for that name, or grey."""

    name: str
    lines: tuple[Shape, ...] = ()
    texts: tuple[Text, ...] = ()
    stroke: Stroke = None  # type: ignore[assignment]

    def __post_init__(self):
        if self.stroke is None:
            object.__setattr__(self, "stroke", MACHINE.get(self.name, Stroke("#808080")))


@dataclass(frozen=True, eq=False)
class Drawing:
    """Layers on a sheet of `size` (width, height) in millimetres; the origin is bottom left, y points up."""

    title: str
    size: tuple[float, float]
    layers: tuple[Layer, ...]

    def layer(self, name: str) -> Layer:
        """The layer of that name, empty if there is none."""
        return next((layer for layer in self.layers if layer.name == name), Layer(name))


def crease_pattern(structure: PleatedStructure, units: str = "mm", *, title: str = "", margin: float = 5.0,
                   strokes: Mapping[str, Stroke] = MACHINE) -> Drawing:
    """The development at 1:1: layers ruling, boundary, mountain, valley, and flat where creases do not fold.

    `margin` millimetres of paper surround it; lines are as wide as their stroke says, and wider on sheets of more
    than half a metre. Raises InvalidStructure when there is no development.
    """
    flat = front_up(structure) * MILLIMETRES[units]
    low, high = flat.min(axis=0), flat.max(axis=0)
    flat = flat - low + margin
    width, height = (high - low + 2 * margin).tolist()
    lines: dict[str, list[Shape]] = {name: [] for name in LAYERS.values()}
    for run in lettered_runs(structure.opened):
        lines[LAYERS[run.letter]].append(Line(flat[run.vertices], run.closed))
    thicker = max(1.0, float(np.hypot(width, height)) / 400)
    layers = tuple(Layer(name, tuple(some), (), replace(strokes[name], width=strokes[name].width * thicker))
                   for name, some in lines.items() if some or name != "flat")
    return Drawing(title, (width, height), layers)


def captioned(drawing: Drawing, strokes: Mapping[str, Stroke] = MACHINE) -> Drawing:
    """The drawing with its title, size and scale in the margin at the bottom, on a layer text; as it is where too narrow."""
    width, height = drawing.size
    words = f"{drawing.title}   {width:.1f} × {height:.1f} mm   1 : 1".strip()
    text = Text(words, (5.0, 1.5), 2.0)
    if len(words) * 0.6 * text.font_size > width - 10:
        return drawing
    return replace(drawing, layers=(*drawing.layers, Layer("text", (), (text,), strokes["text"])))

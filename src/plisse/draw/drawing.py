"""A flat drawing: named layers of polylines in millimetres, between geometry and file formats."""

from dataclasses import dataclass

import numpy as np

from plisse.draw.runs import lettered_runs
from plisse.draw.sheet import front_up
from plisse.recipe import MILLIMETRES
from plisse.structure.pleated import PleatedStructure

__all__ = ["Drawing", "Layer", "Line", "crease_pattern"]

LAYERS = {"R": "ruling", "B": "boundary", "M": "mountain", "V": "valley", "F": "flat"}


@dataclass(frozen=True, eq=False)
class Line:
    """Points (N, 2) in millimetres; closed lines do not repeat the first."""

    points: np.ndarray
    closed: bool = False

    @property
    def stroke(self) -> np.ndarray:
        """The points with the first repeated at the end of closed lines."""
        return np.concatenate([self.points, self.points[:1]]) if self.closed else self.points

    @property
    def length(self) -> float:
        """Length in millimetres."""
        return float(np.hypot(*np.diff(self.stroke, axis=0).T).sum())


@dataclass(frozen=True, eq=False)
class Layer:
    """Lines that one tool or colour draws."""

    name: str
    lines: tuple[Line, ...]


@dataclass(frozen=True, eq=False)
class Drawing:
    """Layers on a sheet of `size` (width, height) in millimetres; the origin is bottom left, y points up."""

    title: str
    size: tuple[float, float]
    layers: tuple[Layer, ...]

    def layer(self, name: str) -> Layer:
        """The layer of that name, empty if there is none."""
        return next((layer for layer in self.layers if layer.name == name), Layer(name, ()))


def crease_pattern(structure: PleatedStructure, units: str = "mm", *, title: str = "",
                   margin: float = 5.0) -> Drawing:
    """The development at 1:1: layers ruling, boundary, mountain, valley, and flat where creases do not fold.

    `margin` millimetres of paper surround it. Raises InvalidStructure when there is no development.
    """
    flat = front_up(structure) * MILLIMETRES[units]
    low, high = flat.min(axis=0), flat.max(axis=0)
    flat = flat - low + margin
    lines: dict[str, list[Line]] = {name: [] for name in LAYERS.values()}
    for run in lettered_runs(structure.opened):
        lines[LAYERS[run.letter]].append(Line(flat[run.vertices], run.closed))
    layers = tuple(Layer(name, tuple(some)) for name, some in lines.items() if some or name != "flat")
    width, height = (high - low + 2 * margin).tolist()
    return Drawing(title, (width, height), layers)

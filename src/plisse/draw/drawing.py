"""A flat drawing: named layers of polylines in millimetres, between geometry and file formats."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from plisse.design import MILLIMETRES
from plisse.draw.sheet import front_up
from plisse.measure.folds import assignments
from plisse.structure.chains import boundary_loops
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline

__all__ = ["Drawing", "Layer", "Line", "crease_pattern"]

LAYERS = {"M": "mountain", "V": "valley"}


@dataclass(frozen=True, eq=False)
class Line:
    """Points (N, 2) in millimetres; closed lines do not repeat the first."""

    points: np.ndarray
    closed: bool = False


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


def crease_pattern(structure: PleatedStructure, units: str = "mm", *, title: str = "", margin: float = 5.0) -> Drawing:
    """The development at 1:1: layers ruling, boundary, mountain, valley, and flat for creases that do not fold.

    `margin` millimetres of paper surround it. Raises InvalidStructure when there is no development.
    """
    flat = front_up(structure) * MILLIMETRES[units]
    low, high = flat.min(axis=0), flat.max(axis=0)
    flat = flat - low + margin
    topology = structure.cut.topology
    letters = _letters_by_edge(structure)
    creases = [run for crease in topology.creases for run in _runs(crease, letters)]
    rulings = [run for ruling in topology.rulings for run in _runs(ruling, letters)]
    by_name = {
        "ruling": [(line, closed) for letter, line, closed in rulings if letter != "B"],
        "boundary": [(loop, True) for loop in boundary_loops(topology)],
        "mountain": [(line, closed) for letter, line, closed in creases if letter == "M"],
        "valley": [(line, closed) for letter, line, closed in creases if letter == "V"],
        "flat": [(line, closed) for letter, line, closed in creases if letter == "F"],
    }
    layers = tuple(Layer(name, tuple(Line(flat[line], closed) for line, closed in lines))
                   for name, lines in by_name.items() if lines or name != "flat")
    width, height = (high - low + 2 * margin).tolist()
    return Drawing(title, (width, height), layers)


def _letters_by_edge(structure: PleatedStructure) -> dict[tuple[int, int], str]:
    """M, V, F or B by sorted vertex pair; rulings are R, however they bend."""
    opened = structure.opened
    edges = opened.topology.edges
    letters = assignments(opened.topology, opened.vertices)
    letters = np.where(edges.is_crease | edges.is_boundary, letters, "R")
    ends = np.sort(edges.vertices, axis=1)
    return {(a, b): letter for (a, b), letter in zip(ends.tolist(), letters.tolist(), strict=True)}


def _runs(chain: Polyline, letters: dict[tuple[int, int], str]) -> list[tuple[str, np.ndarray, bool]]:
    """The chain split where its letter changes: (letter, vertices, closed)."""
    path = chain.vertices.tolist()
    if chain.closed:
        path = [*path, path[0]]
    names = [letters[min(a, b), max(a, b)] for a, b in pairwise(path)]
    cuts = [0, *(k for k in range(1, len(names)) if names[k] != names[k - 1]), len(names)]
    if chain.closed and len(cuts) == 2:
        return [(names[0], chain.vertices, True)]
    return [(names[a], np.array(path[a:b + 1]), False) for a, b in pairwise(cuts)]

"""Grids recognised: the rows and columns of a topology that is a full grid, however its vertices are numbered."""

import numpy as np

from plisse.errors import InvalidStructure
from plisse.structure.topology import Polyline, Topology

__all__ = ["grid_numbers"]


def grid_numbers(topology: Topology) -> np.ndarray:
    """Vertices (m, n) of a grid: row l is crease l, column i is ruling polyline i, both in the order of neighbours.

    Open grids only. Raises InvalidStructure for anything else: closed creases, singular points, missing quads.
    """
    creases, columns = topology.creases, topology.rulings
    count = len(creases) * len(columns)
    whole = len(topology.quads) == (len(creases) - 1) * (len(columns) - 1) and topology.vertex_count == count
    if topology.hubs or not whole or any(line.closed for line in (*creases, *columns)):
        raise InvalidStructure("this needs an open grid of creases and rulings without gaps; cut closed structures open "
                               "along a zigzag of rulings first")
    row, column = _owner(creases, topology.vertex_count), _owner(columns, topology.vertex_count)
    row_order = row[columns[0].vertices]
    column_order = column[creases[row_order[0]].vertices]
    numbers = np.empty((len(creases), len(columns)), np.int64)
    numbers[np.argsort(row_order)[row], np.argsort(column_order)[column]] = np.arange(count)
    return numbers


def _owner(lines: tuple[Polyline, ...], vertex_count: int) -> np.ndarray:
    owner = np.zeros(vertex_count, np.int64)
    for number, line in enumerate(lines):
        owner[line.vertices] = number
    return owner

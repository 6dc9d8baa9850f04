"""Structures that are exact by formula, for every test that needs one."""

from plisse.threads import bind_threads

bind_threads()  # one thread per worker, before numpy is imported

import numpy as np
import pytest

from plisse.structure.cut import cut_along
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline


def alternating_cones(creases: int, columns: int, *, angle: float, step: float = 6.0, height: float = 8.0,
                      closed: bool = False) -> PleatedStructure:
    """Circles of falling radius at alternating heights: cones of equal slope, exact and principal."""
    radius = 100.0 - step * np.arange(creases)
    turn = np.linspace(0, angle, columns, endpoint=not closed)
    level = height * (np.arange(creases) % 2)
    vertices = np.stack([np.outer(radius, np.cos(turn)), np.outer(radius, np.sin(turn)),
                         np.repeat(level[:, None], columns, axis=1)], axis=-1).reshape(-1, 3)
    slant = np.hypot(step, height)
    flat_turn = 2 * np.arcsin(step / slant * np.sin((turn[1] - turn[0]) / 2))
    topology = grid(creases, columns, closed_creases=closed)
    sectors = np.arange(columns + closed) * flat_turn
    flat_radius = radius * slant / step
    flat = np.stack([np.outer(flat_radius, np.cos(sectors)), np.outer(flat_radius, np.sin(sectors))], axis=-1)
    if not closed:
        return PleatedStructure(topology, vertices, development=flat.reshape(-1, 2))
    cut = cut_along(topology, Polyline(np.arange(creases) * columns))
    development = np.concatenate([flat[:, :-1].reshape(-1, 2), flat[:, -1]])
    return PleatedStructure(topology, vertices, cut, development)


@pytest.fixture
def cones() -> PleatedStructure:
    """Half a turn of six alternating cones, a disk."""
    return alternating_cones(7, 25, angle=np.pi)


@pytest.fixture
def closed_cones() -> PleatedStructure:
    """Four alternating cones all the way round, cut open for the development."""
    return alternating_cones(5, 24, angle=2 * np.pi, closed=True)

"""Where on a structure something is, in words a designer can follow."""

import re

import numpy as np

from plisse.structure.topology import Topology

__all__ = ["place_of", "vertex_named"]


def place_of(topology: Topology, vertex: int) -> str:
    """Crease number (from 1) and percent of its length, by counting vertices along the crease."""
    for number, crease in enumerate(topology.creases, 1):
        position = np.flatnonzero(crease.vertices == vertex)
        if len(position):
            percent = 100 * position[0] / max(len(crease.vertices) - (not crease.closed), 1)
            return f"crease {number} near {percent:.0f} % of its length"
    return f"vertex {vertex}"


def vertex_named(topology: Topology, sentence: str) -> int | None:
    """The vertex that the first place in a sentence means, to the percent that `place_of` says; None where it names none."""
    found = re.search(r"crease (\d+) near (\d+) %|vertex (\d+)", sentence)
    if found is None:
        return None
    if found[3] is not None:
        return int(found[3]) if int(found[3]) < topology.vertex_count else None
    number, percent = int(found[1]), int(found[2])
    if not 1 <= number <= len(topology.creases):
        return None
    crease = topology.creases[number - 1]
    last = max(len(crease.vertices) - (not crease.closed), 1)
    return int(crease.vertices[min(round(percent * last / 100), len(crease.vertices) - 1)])

"""The parts of a topology that hang together over edges: a sheet cut apart along its seams."""

from dataclasses import dataclass

import numpy as np

from plisse.structure.topology import Topology

__all__ = ["Part", "parts"]


@dataclass(frozen=True, eq=False)
class Part:
    """A connected topology, and the numbers (V',) and (F',) that its vertices and faces have in the whole."""

    topology: Topology
    vertices: np.ndarray
    faces: np.ndarray


def parts(topology: Topology) -> tuple[Part, ...]:
    """The connected parts, in the order of their first faces; faces and vertices keep their order."""
    if topology.components == 1:
        return (Part(topology, np.arange(topology.vertex_count), np.arange(topology.face_count)),)
    return tuple(_part(topology, topology.piece_of_faces == k) for k in range(topology.components))


def _part(topology: Topology, chosen: np.ndarray) -> Part:
    count = len(topology.quads)
    quads = topology.quads[chosen[:count]]
    hubs = [topology.hubs[k] for k in np.flatnonzero(chosen[count:])]
    used = np.unique(np.concatenate([quads.ravel(), *hubs]))
    number = np.full(topology.vertex_count, -1)
    number[used] = np.arange(len(used))
    ordering = None if topology.ordering is None else topology.ordering[used]
    seams = number[topology.seams]
    return Part(Topology(len(used), number[quads], tuple(number[hub] for hub in hubs), ordering,
                         seams[(seams >= 0).all(axis=1)]), used, np.flatnonzero(chosen))

"""Strips as bands of quads from ruling to ruling: what is ruled between two creases (§2.1)."""

from typing import NamedTuple

import numpy as np

from plisse.structure.lines import joined
from plisse.structure.topology import Topology

__all__ = ["Band", "bands"]


class Band(NamedTuple):
    """Vertices (N,) on the two creases of a strip, joined by a ruling each; closed bands do not repeat the first."""

    left: np.ndarray
    right: np.ndarray
    closed: bool


def bands(topology: Topology) -> list[Band]:
    """Every strip once, in the order of its first face; hubs are no part of any."""
    edges, quads = topology.edges, topology.quads
    inner = ~edges.is_crease & ~edges.is_boundary & (edges.faces < len(quads)).all(axis=1)
    chains = [(line.vertices, line.closed) for line in joined(edges.faces[inner])]
    alone = np.setdiff1d(np.arange(len(quads)), edges.faces[inner])
    chains += [(np.array([face]), False) for face in alone]
    return [_band(quads[faces], closed) for faces, closed in sorted(chains, key=lambda chain: int(chain[0].min()))]


def _band(quads: np.ndarray, closed: bool) -> Band:
    """A band from its faces in turn: [a b c d] has its rulings at da and bc."""
    if len(quads) > 1 and quads[1, 0] != quads[0, 1]:
        quads = quads[::-1]
    left, right = quads[:, 0], quads[:, 3]
    if closed:
        return Band(left, right, True)
    return Band(np.append(left, quads[-1, 1]), np.append(right, quads[-1, 2]), False)

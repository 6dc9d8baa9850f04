"""Creases in dashes, as diagrams of origami draw valleys: all of them at once."""

from functools import lru_cache

import numpy as np

from plisse.geometry.vectors import norm
from plisse.structure.incidence import edge_lookup
from plisse.structure.topology import Topology

__all__ = ["SHARE", "dashed"]

SHARE = 0.6  # of a period that is drawn


def dashed(topology: Topology, chosen: np.ndarray, points: np.ndarray, period: float) -> np.ndarray:
    """Straight pieces (D, 2, k) of dashes along those creases whose edges (E,) are chosen, each crease begun with a dash.

    `points` (V, k) may carry more than coordinates: the first three measure lengths, and everything is interpolated.
    """
    edges, ends, first = _steps(topology)
    lengths = norm(points[ends[:, 1], :3] - points[ends[:, 0], :3])
    reached = np.concatenate([[0.0], np.cumsum(lengths)])
    begun = reached[:-1] - reached[first]
    wanted = np.flatnonzero(chosen[edges] & (lengths > 0))
    begun, lengths, ends = begun[wanted] / period, lengths[wanted] / period, points[ends[wanted]]
    number = np.floor(begun + lengths).astype(np.int64) - np.floor(begun).astype(np.int64) + 1  # of periods that are touched
    step = np.repeat(np.arange(len(wanted)), number)
    dash = np.floor(begun)[step] + np.arange(len(step)) - (np.cumsum(number) - number)[step]
    shares = np.stack([dash, dash + SHARE], axis=1) - begun[step, None]
    shares = np.clip(shares / lengths[step, None], 0, 1)[..., None]
    shown = shares[:, 1, 0] > shares[:, 0, 0]
    start, end = ends[step[shown], :1], ends[step[shown], 1:]
    return start + shares[shown] * (end - start)


@lru_cache(maxsize=8)
def _steps(topology: Topology) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Edges (S,) in the order of the creases that they make, their ends (S, 2), and the first step (S,) of their crease."""
    paths = [crease.path for crease in topology.creases]
    counts = np.array([len(path) - 1 for path in paths], np.int64)
    ends = np.concatenate([np.empty((0, 2), np.int64), *(np.stack([path[:-1], path[1:]], axis=1) for path in paths)])
    return edge_lookup(topology)(*ends.T), ends, np.repeat(np.cumsum(counts) - counts, counts)

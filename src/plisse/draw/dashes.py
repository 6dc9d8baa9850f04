"""Creases as lines for the screen: whole, or in dashes as diagrams of origami draw valleys; all of them at once."""

from functools import lru_cache

import numpy as np

from plisse.geometry.vectors import norm
from plisse.structure.incidence import edge_lookup
from plisse.structure.topology import Topology

__all__ = ["SHARE", "dashed", "longest_stride", "whole"]

SHARE = 0.6  # of a period that is drawn
MOST = 8  # edges that are drawn as one


def longest_stride(topology: Topology, points: np.ndarray, sag: float) -> int:
    """How many edges of creases in a row may be drawn as one piece that leaves points (V, 3) by about `sag` at most."""
    _, ends, first = _steps(topology)
    along = points[ends[:, 1]] - points[ends[:, 0]]
    bends = norm(along[1:] - along[:-1])[first[1:] == first[:-1]]
    return int(np.clip(np.sqrt(8 * sag / max(float(bends.max(initial=0.0)), 1e-300)), 1, MOST))


def whole(topology: Topology, chosen: np.ndarray, points: np.ndarray, stride: int = 1) -> np.ndarray:
    """Straight pieces (S, 2, k) along those creases whose edges (E,) are chosen, of `stride` edges each."""
    edges, ends, _ = _steps(topology, stride)
    return points[ends[chosen[edges]]]


def dashed(topology: Topology, chosen: np.ndarray, points: np.ndarray, period: float, stride: int = 1) -> np.ndarray:
    """Straight pieces (D, 2, k) of dashes along those creases whose edges (E,) are chosen, each crease begun with a dash.

    `points` (V, k) may carry more than coordinates: the first three measure lengths, and everything is interpolated.
    """
    edges, ends, first = _steps(topology, stride)
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


@lru_cache(maxsize=16)
def _steps(topology: Topology, stride: int = 1) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """First edge (S,) of so many in a row, crease by crease, their ends (S, 2), and the first step (S,) of their crease."""
    lookup, nothing = edge_lookup(topology), np.empty(0, np.int64)
    paths = [crease.path for crease in topology.creases]
    kept = [np.append(path[:-1:stride], path[-1]) for path in paths]
    counts = np.array([len(path) - 1 for path in kept], np.int64)
    edges = lookup(*(np.concatenate([nothing, *(path[start:len(path) - 1 + start:stride] for path in paths)])
                     for start in (0, 1)))
    ends = np.stack([np.concatenate([nothing, *(path[side:len(path) - 1 + side] for path in kept)]) for side in (0, 1)],
                    axis=1)
    return edges, ends, np.repeat(np.cumsum(counts) - counts, counts)

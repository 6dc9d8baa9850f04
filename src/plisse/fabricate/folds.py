"""The lines that are drawn on a piece: folds inside it, where flaps begin, and ticks where rulings end."""

from typing import NamedTuple

import numpy as np

from plisse.fabricate.joints import Joint
from plisse.fabricate.paper import Paper
from plisse.fabricate.pieces import Piece
from plisse.structure.lines import joined

__all__ = ["Fold", "flap_lines", "fold_lines", "tick_marks"]

TICK_SPACING, TICK = 8.0, 1.6


class Fold(NamedTuple):
    """Vertices (N,) of the development along a line of one letter: M, V or F on creases, R elsewhere."""

    letter: str
    vertices: np.ndarray
    closed: bool = False


def fold_lines(paper: Paper, piece: Piece) -> list[Fold]:
    """Creases inside a piece, letter by letter."""
    edges = paper.topology.edges
    inner = edges.is_crease & ~edges.is_boundary & piece.faces[edges.faces].all(axis=1)
    return [Fold(letter, line.vertices, line.closed)
            for letter in "MVF" for line in joined(edges.vertices[inner & (paper.letters == letter)])]


def flap_lines(paper: Paper, piece: Piece, joints: tuple[Joint, ...]) -> list[Fold]:
    """Edges at which the flaps of a piece begin, as folds where the structure folds there."""
    edges = paper.topology.edges
    letters = {frozenset(ends): letter for ends, letter in
               zip(edges.vertices[edges.is_crease].tolist(), paper.letters[edges.is_crease].tolist(), strict=True)}
    own = {tab.label for tab in piece.tabs}
    out = []
    for joint in joints:
        for side in (0, 1):
            if joint.pieces[side] != piece.number - 1:
                continue
            for label, path in zip(joint.labels, joint.edges(side), strict=True):
                if label in own:
                    letter = letters.get(frozenset(path[:2].tolist()), "R")
                    out.append(Fold(letter if letter in "MV" else "R", path))
                    own.discard(label)
    return out


def tick_marks(paper: Paper, piece: Piece) -> np.ndarray:
    """Short lines (T, 2, 2) in mm along rulings, from where they end on the rim of a piece: about one every 8 mm.

    The two sides of a joint along a crease have theirs at the same rulings.
    """
    edges, points = paper.topology.edges, paper.points
    inner = np.flatnonzero(~edges.is_crease & ~edges.is_boundary & piece.faces[edges.faces].all(axis=1))
    width = np.median(paper.edge_lengths[edges.is_crease])
    every = max(1, round(TICK_SPACING / float(width)))
    inner = inner[paper.columns[edges.faces[inner]].max(axis=1) % every == 0]
    on_rim = np.zeros(len(points), bool)
    on_rim[paper.rim(piece.faces)[0]] = True
    start = np.concatenate([edges.vertices[inner], edges.vertices[inner, ::-1]])
    start = start[on_rim[start[:, 0]]]
    along = points[start[:, 1]] - points[start[:, 0]]
    length = np.hypot(*along.T)[:, None]
    return np.stack([points[start[:, 0]], points[start[:, 0]] + along / length * np.minimum(TICK, 0.35 * length)], axis=1)

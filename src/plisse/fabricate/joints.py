"""Where pieces meet again: cut edges in pairs, chained to joints with a letter and numbered edge by edge."""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from plisse.fabricate.paper import Paper

__all__ = ["Joint", "joints_between", "letters"]

CREASE_EDGE = 25.0
ALPHABET = "ABCDEFGHJKLMNPQRSTUVWXYZ"  # no I and O, which look like numbers


@dataclass(frozen=True, eq=False)
class Joint:
    """Two congruent polylines of cut edges: vertices `left` (N,) on piece `pieces[0]`, `right` (N,) on `pieces[1]`.

    The first piece lies on the left of its polyline, the second on the right of its own. `breaks` (M+1,) are the
    positions between which one numbered edge runs. `closes` says that the two sides meet only in the folded
    structure, where a closed one was cut open; `on_crease` that the paper folds along the joint.
    """

    name: str
    pieces: tuple[int, int]
    left: np.ndarray
    right: np.ndarray
    breaks: np.ndarray
    on_crease: bool = False
    closes: bool = False

    @property
    def labels(self) -> list[str]:
        """The name of every numbered edge: A1, A2, …"""
        return [f"{self.name}{k + 1}" for k in range(len(self.breaks) - 1)]

    def edges(self, side: int) -> list[np.ndarray]:
        """Vertices of every numbered edge on the left (0) or right (1) side, in the order of `labels`."""
        path = (self.left, self.right)[side]
        return [path[a:b + 1] for a, b in pairwise(self.breaks.tolist())]


def joints_between(paper: Paper, piece: np.ndarray) -> tuple[Joint, ...]:
    """All joints between pieces, given the number of its piece for every face (F,)."""
    cut = np.concatenate([_inner(paper, piece), _closing(paper, piece)])
    order = np.lexsort(cut.T[[5, 4, 3, 2, 1, 0]])
    _, group = np.unique(cut[order, :4], axis=0, return_inverse=True)
    out: list[Joint] = []
    for number in range(group.max(initial=-1) + 1):
        rows = cut[order[group.ravel() == number]]
        first, second, crease, closes = rows[0, :4].tolist()
        for chain in _chains(rows[:, 4:]):
            breaks = _breaks(paper.points[chain[:, 0]]) if crease else np.arange(len(chain))
            out.append(Joint(letters(len(out)), (first, second), chain[:, 0], chain[:, 1], breaks,
                             on_crease=bool(crease), closes=bool(closes)))
    return tuple(out)


def letters(index: int) -> str:
    """A, B, …, Z, AA, AB, … without I and O."""
    size = len(ALPHABET)
    return ALPHABET[index] if index < size else letters(index // size - 1) + ALPHABET[index % size]


def _inner(paper: Paper, piece: np.ndarray) -> np.ndarray:
    """Rows of (first piece, second piece, crease, closes, start and end on the left, start and end on the right)."""
    edges = paper.topology.edges
    numbers = piece[edges.faces]
    found = np.flatnonzero(~edges.is_boundary & (numbers[:, 0] != numbers[:, 1]))
    first, second = numbers[found].T
    ends = np.where((first < second)[:, None], edges.vertices[found], edges.vertices[found, ::-1])
    return np.column_stack([np.sort(numbers[found], axis=1), edges.is_crease[found], np.zeros(len(found), int), ends, ends])


def _closing(paper: Paper, piece: np.ndarray) -> np.ndarray:
    """The same rows for edges that were cut to lay a closed structure flat."""
    edges, source = paper.topology.edges, paper.source
    found = np.flatnonzero(paper.severed)
    place = _place_on_rim(paper)[found]
    ends = np.sort(source[edges.vertices[found]], axis=1)
    order = np.lexsort((place, piece[edges.faces[found, 0]], ends[:, 1], ends[:, 0]))
    one, other = found[order[::2]], found[order[1::2]]
    left, right = edges.vertices[one], edges.vertices[other]
    right = np.where((source[right] == source[left]).all(axis=1)[:, None], right, right[:, ::-1])
    numbers = piece[edges.faces[:, 0]]
    return np.column_stack([numbers[one], numbers[other], edges.is_crease[one], np.ones(len(one), int), left, right])


def _place_on_rim(paper: Paper) -> np.ndarray:
    """Position (E,) of boundary edges along the rim, counted from an end of the severed part."""
    ends, number = paper.rim(np.ones(paper.topology.face_count, bool))
    after = dict(zip(ends[:, 0].tolist(), number.tolist(), strict=True))
    place, count = np.full(len(paper.edge_lengths), -1), 0
    for loop in paper.loops(np.ones(paper.topology.face_count, bool)):
        around = np.array([after[vertex] for vertex in loop.tolist()])
        free = np.flatnonzero(~paper.severed[around])
        around = np.roll(around, -int(free[0])) if len(free) else around
        place[around] = count + np.arange(len(around))
        count += len(around)
    return place


def _chains(rows: np.ndarray) -> list[np.ndarray]:
    """Vertex pairs (N, 2) along chains of rows (start left, end left, start right, end right)."""
    after: dict[tuple[int, int], tuple[int, int]] = {}
    for start, end, other_start, other_end in rows.tolist():
        after[start, other_start] = (end, other_end)
    ends = set(after.values())
    chains = []
    while after:
        at = next((key for key in after if key not in ends), next(iter(after)))
        chain = [at]
        while at in after:
            at = after.pop(at)
            chain.append(at)
        chains.append(np.array(chain))
    return chains


def _breaks(points: np.ndarray) -> np.ndarray:
    """Positions that cut a polyline (N, 2) into edges of about the same length, 25 mm or a little more."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
    count = max(1, int(length[-1] / CREASE_EDGE))
    return np.unique(np.abs(length[:, None] - np.linspace(0, length[-1], count + 1)).argmin(axis=0))

"""Numbers on pieces: at every cut edge on both sides, and one for the piece; they touch neither lines nor each other."""

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from plisse.fabricate.joints import Joint
from plisse.fabricate.paper import Paper
from plisse.fabricate.pieces import Piece, Placement

__all__ = ["CHARACTER", "Label", "labels_on"]

CHARACTER = 0.95
EDGE_HEIGHTS = (2.6, 2.2, 1.8, 1.5, 1.2, 1.0, 0.8, 0.65, 0.5)
PIECE_HEIGHTS = (8.0, 6.5, 5.0, 4.0, 3.2, 2.6, 2.1, 1.7, 1.4, 1.1, 0.9, 0.7, 0.5)
AWAY, SHARES = (0.7, 1.4, 2.4, 4.0), (0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95)
CLEAR = 0.35
CANDIDATES = 600
STEEPEST = np.radians(105)


@dataclass(frozen=True)
class Label:
    """Words with capitals `height` mm high about their `centre`, turned by `angle` radians so that they stand upright.

    `kind` is edge or piece.
    """

    words: str
    centre: tuple[float, float]
    height: float
    angle: float
    kind: str

    @property
    def corners(self) -> np.ndarray:
        """Corners (4, 2) of the box that the words take, with 0.95 heights per character."""
        along = np.array([np.cos(self.angle), np.sin(self.angle)]) * self.height * CHARACTER * len(self.words) / 2
        up = np.array([-np.sin(self.angle), np.cos(self.angle)]) * self.height / 2
        return np.array(self.centre) + np.array([-along - up, along - up, along + up, -along + up])


def labels_on(paper: Paper, piece: Piece, placement: Placement, joints: tuple[Joint, ...],
              lines: list[np.ndarray]) -> list[Label]:
    """Labels of a piece where it lies on its sheet; `lines` (N, 2) are the folds and ticks on it, there too."""
    import shapely

    points = placement.apply(paper.points)
    outline = shapely.transform(paper.polygon(piece.faces), placement.apply)
    obstacles = shapely.union_all([outline.boundary, *(shapely.LineString(line) for line in lines)])
    shapely.prepare(obstacles)
    shapely.prepare(outline)
    board, middles = _Board(outline, obstacles), _middles(paper, piece, points)
    edges = [(words, path, _along if joint.on_crease else _into)
             for joint in joints for side in (0, 1) if joint.pieces[side] == piece.number - 1
             for words, path in zip(joint.labels, joint.edges(side), strict=True)]
    for words, path, beside in sorted(edges, key=lambda edge: _length(points[edge[1]])[-1]):  # short ones have less choice
        board.first(beside(words, points[path], middles[frozenset(path[:2].tolist())]))
    _name(board, paper, piece, points)
    return board.labels


class _Board:
    """Where labels may stand: inside the outline, clear of lines and of each other."""

    def __init__(self, outline, obstacles):
        self.labels: list[Label] = []
        self._outline, self._obstacles, self._boxes = outline, obstacles, []

    def first(self, wishes: list[Label]) -> None:
        """Put down the first wish that is clear, or else the last, which is the smallest, as near as it can be."""
        chosen = self._clear(wishes) or self._clear(_around(wishes[-1])) or wishes[-1]
        self.labels.append(chosen)
        self._boxes.append(_grown([chosen])[0])

    def _clear(self, wishes: list[Label]) -> Label | None:
        """The first of the wishes that touches neither lines nor labels, if there is one."""
        import shapely

        boxes = _grown(wishes)
        clear = shapely.contains_properly(self._outline, boxes) & ~shapely.intersects(self._obstacles, boxes)
        if self._boxes:
            clear &= ~shapely.intersects(boxes[:, None], np.array(self._boxes)).any(axis=1)
        return wishes[int(np.argmax(clear))] if clear.any() else None

    def room(self, centres: np.ndarray) -> np.ndarray:
        """Distance (C,) of places from the nearest line."""
        import shapely

        return shapely.distance(self._obstacles, shapely.points(centres))


def _grown(labels: list[Label]) -> np.ndarray:
    """Boxes of labels as shapely polygons, with a little air around them."""
    import shapely

    boxes = shapely.polygons([label.corners for label in labels])
    return shapely.buffer(boxes, [min(CLEAR, 0.25 * label.height) for label in labels], join_style="mitre")


def _around(label: Label) -> list[Label]:
    """The label in places around its own, the nearest first."""
    away, turn = np.meshgrid(np.arange(1.0, 15.0, 0.7), np.linspace(0, 2 * np.pi, 16, endpoint=False), indexing="ij")
    centres = label.centre + (away * np.array([np.cos(turn), np.sin(turn)])).reshape(2, -1).T
    return [replace(label, centre=(x, y)) for x, y in centres.tolist()]


def _middles(paper: Paper, piece: Piece, points: np.ndarray) -> dict[frozenset[int], np.ndarray]:
    """For every edge on the rim of a piece the middle of the other corners of its face."""
    ends, number = paper.rim(piece.faces)
    faces = paper.topology.edges.faces[number]
    own = np.where(piece.faces[faces[:, 0]], faces[:, 0], faces[:, 1])
    return {frozenset(pair): points[np.setdiff1d(paper.topology.faces[face], pair)].mean(axis=0)
            for pair, face in zip(ends.tolist(), own.tolist(), strict=True)}


def _into(words: str, edge: np.ndarray, opposite: np.ndarray) -> list[Label]:
    """Wishes for a label that runs from an edge (2, 2) into its strip, large ones first."""
    middle = edge.mean(axis=0)
    inwards = (opposite - middle) / np.hypot(*(opposite - middle))
    return [Label(words, tuple((middle + inwards * (away + CHARACTER * height * len(words) / 2)).tolist()), height,
                  _upright(inwards), "edge") for height in EDGE_HEIGHTS for away in AWAY]


def _along(words: str, edge: np.ndarray, opposite: np.ndarray) -> list[Label]:
    """Wishes for a label that runs beside an edge (N, 2) of several vertices, large ones first and near its middle."""
    length, wishes = _length(edge), []
    short = [height for height in EDGE_HEIGHTS if CHARACTER * height * len(words) <= length[-1]] or EDGE_HEIGHTS[-1:]
    for height, share, away in product(short, SHARES, (0.35, *AWAY[:2])):
        place = np.array([np.interp(share * length[-1], length, coordinate) for coordinate in edge.T])
        k = int(np.clip(np.searchsorted(length, share * length[-1]) - 1, 0, len(edge) - 2))
        along = (edge[k + 1] - edge[k]) / (length[k + 1] - length[k])
        inwards = np.array([-along[1], along[0]])
        inwards = inwards * np.sign(inwards @ (opposite - edge[0]))
        centre = place + inwards * (away + height / 2)
        wishes.append(Label(words, tuple(centre.tolist()), height, _upright(along), "edge"))
    return wishes


def _length(line: np.ndarray) -> np.ndarray:
    """Length along a polyline (N, 2) at every vertex."""
    return np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])


def _name(board: _Board, paper: Paper, piece: Piece, points: np.ndarray) -> None:
    """The number of a piece, as large as the widest place between its lines allows, along the strip."""
    quads = paper.topology.quads[piece.faces[: len(paper.topology.quads)]]
    if len(quads) == 0:
        quads = np.array([paper.topology.hubs[0][:4]])
    quads = quads[:: max(1, len(quads) // CANDIDATES)]
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    centres, along = (a + b + c + d) / 4, (b + c - a - d) / 2
    room = board.room(centres)
    wishes = []
    for words in (f"PIECE {piece.number}", str(piece.number)):
        for height in PIECE_HEIGHTS:
            for k in np.argsort(-room, kind="stable")[:40].tolist():
                if room[k] >= 0.5 * height:
                    wishes.append(Label(words, tuple(centres[k].tolist()), height, _upright(along[k]), "piece"))
    smallest = int(np.argmax(room))
    wishes.append(Label(str(piece.number), tuple(centres[smallest].tolist()), 0.5, _upright(along[smallest]), "piece"))
    board.first(wishes)


def _upright(direction: np.ndarray) -> float:
    """Angle in (−75°, 105°] of a line: words do not stand on their heads, and nearly vertical ones all read upwards."""
    angle = float(np.arctan2(direction[1], direction[0]))
    return STEEPEST - float(np.mod(STEEPEST - angle, np.pi))

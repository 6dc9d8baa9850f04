"""Polylines as what machines move along well: splines or arcs, no farther away than a tolerance."""

from dataclasses import dataclass
from itertools import pairwise
from typing import Literal

import numpy as np

from plisse.draw.shapes import Arc, Bulged, Line, Shape, Spline, straight_controls
from plisse.geometry.arcs import arcs_along
from plisse.geometry.bezier import bezier_through, sampled
from plisse.geometry.vectors import cross_flat, dot, norm

__all__ = ["Curves", "Smoother"]

Curves = Literal["polyline", "spline", "arc"]
CORNER, ZIGZAG = np.radians(14), np.radians(1)


@dataclass(eq=False)
class Smoother:
    """Makes shapes of polylines and remembers the largest `deviation` in mm between the two.

    Corners of more than 14 degrees stay corners, and so do zigzags; what is straight within the tolerance becomes a line.
    Stretches that no smooth curve follows within the tolerance stay polylines; `kept` counts them.
    """

    kind: Curves = "polyline"
    tolerance: float = 0.05
    deviation: float = 0.0
    kept: int = 0

    def shapes(self, points: np.ndarray, closed: bool = False) -> list[Shape]:
        """Shapes that follow a polyline (N, 2) from end to end, or all around."""
        if self.kind == "polyline" or len(points) < 3:
            return [Line(points, closed)]
        out: list[Shape] = []
        for run in _runs(points, closed):
            straight = _distance(run, run[[0, -1]]) if len(run) > 2 and norm(run[-1] - run[0]) > 0 else np.inf
            if len(run) == 2:
                out.append(Line(run))
            elif straight <= self.tolerance:
                self.deviation = max(self.deviation, straight)
                out.append(Line(run[[0, -1]]))
            else:
                out += self._spline(run) if self.kind == "spline" else self._arcs(run)
        return _joined(out)

    def outline(self, points: np.ndarray) -> Shape:
        """One closed shape that follows a polyline (N, 2) all around."""
        shapes = self.shapes(points, closed=True)
        lines = [shape for shape in shapes if isinstance(shape, Line)]
        if len(lines) == len(shapes):
            return Line(np.concatenate([line.path[:-1] for line in lines]), closed=True)
        if self.kind == "spline":
            pieces = [shape.controls if isinstance(shape, Spline) else straight_controls(shape.path) for shape in shapes]
            return Spline(np.concatenate([pieces[0][:1], *(piece[1:] for piece in pieces)]), closed=True)
        return _bulged(shapes, _runs(points, True)[0][0])

    def _arcs(self, run: np.ndarray) -> list[Shape]:
        out: list[Shape] = []
        stretches = arcs_along(run, self.tolerance)
        self.kept += len(stretches) == len(run) - 1
        for first, last, centre, radius, deviation in stretches:
            self.deviation = max(self.deviation, deviation)
            ends = run[[first, last]]
            if np.isinf(radius):
                out.append(Line(ends))
                continue
            start, end = np.arctan2(*(ends - centre).T[::-1])[:: 1 if radius > 0 else -1]
            turn = float(np.mod(end - start, 2 * np.pi))
            out.append(Arc((float(centre[0]), float(centre[1])), abs(radius), float(start), float(start) + turn))
        return out

    def _spline(self, run: np.ndarray) -> list[Shape]:
        probes = np.empty((2 * len(run) - 1, 2))
        probes[::2], probes[1::2] = run, (run[1:] + run[:-1]) / 2
        count = 3
        while True:
            knots = np.unique(np.round(np.linspace(0, len(run) - 1, count)).astype(int))
            controls = bezier_through(run[knots])
            deviation = _distance(probes, sampled(controls, 24))
            if deviation <= self.tolerance:
                self.deviation = max(self.deviation, deviation)
                return [Spline(controls)]
            if len(knots) == len(run):
                self.kept += 1
                return [Line(run)]
            count = min(2 * count - 1, len(run))


def _runs(points: np.ndarray, closed: bool) -> list[np.ndarray]:
    """Stretches between corners; a closed line without corners is one stretch that returns to its start."""
    corners = np.flatnonzero(_is_corner(points, closed))
    if closed and len(corners):
        path = np.concatenate([np.roll(points, -corners[0], axis=0), points[corners[0]][None]])
        cuts = [0, *(corners[1:] - corners[0]).tolist(), len(points)]
    else:
        path = np.concatenate([points, points[:1]]) if closed else points
        cuts = [0, *corners.tolist(), len(path) - 1]
    return [path[a:b + 1] for a, b in pairwise(cuts)]


def _is_corner(points: np.ndarray, closed: bool) -> np.ndarray:
    """Mask (N,) of sharp turns and of zigzags along a polyline; the ends of an open one are none."""
    step = np.roll(points, -1, axis=0) - points
    before = np.roll(step, 1, axis=0)
    turn = np.arctan2(cross_flat(before, step), dot(before, step))
    if not closed:
        turn[[0, -1]] = 0.0
    bend = np.where(np.abs(turn) > ZIGZAG, np.sign(turn), 0.0)
    return (np.abs(turn) > CORNER) | (bend * np.roll(bend, 1) < 0) | (bend * np.roll(bend, -1) < 0)


def _distance(probes: np.ndarray, curve: np.ndarray) -> float:
    """Largest distance of the probes from a finely sampled curve near the same share of its length."""
    from shapely import LineString, distance, points

    return float(distance(points(probes), LineString(curve)).max())


def _bulged(shapes: list[Shape], start: np.ndarray) -> Bulged:
    """Lines and arcs end to end as one closed line from `start`; arcs turn right where they are met at their end."""
    points, bulges, at = [], [], start
    for shape in shapes:
        path, bulge = shape.path, 0.0
        if isinstance(shape, Arc):
            bulge = float(np.tan((shape.end - shape.start) / 4))
            path = path[[0, -1]]
            if norm(path[1] - at) < norm(path[0] - at):
                path, bulge = path[::-1], -bulge
        points.append(path[:-1])
        bulges += [bulge] * (len(path) - 1)
        at = path[-1]
    return Bulged(np.concatenate(points), np.array(bulges))


def _joined(shapes: list[Shape]) -> list[Shape]:
    """Successive open lines as one."""
    out: list[Shape] = []
    for shape in shapes:
        before = out[-1] if out else None
        if isinstance(shape, Line) and isinstance(before, Line) and norm(before.points[-1] - shape.points[0]) == 0:
            out[-1] = Line(np.concatenate([before.points, shape.points[1:]]))
        else:
            out.append(shape)
    return out

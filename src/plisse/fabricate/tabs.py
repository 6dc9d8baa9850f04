"""Glue flaps: trapezoids beyond one side of every cut edge, where there is room for them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from plisse.fabricate.joints import Joint
from plisse.fabricate.paper import Paper

__all__ = ["Tab", "tabs_for"]

SMALLER = (1.0, 0.6, 0.35)
SLIT = 0.1
LONGEST = 1.2
OVERLAP = 0.02


@dataclass(frozen=True, eq=False)
class Tab:
    """A flap (N, 2) of piece `piece` at a numbered edge, in the place of the piece within the development.

    It reaches 0.02 mm into the piece, so that their union is one, and `depth` mm beyond the edge.
    """

    label: str
    piece: int
    points: np.ndarray
    depth: float


def tabs_for(paper: Paper, polygons: list, joints: tuple[Joint, ...], depth: float, kerf: float = 0.0) -> tuple[Tab, ...]:
    """Flaps of about `depth` mm on one side of every joint; edges where nothing fits stay without one.

    `polygons` are the pieces as shapely polygons. Flaps touch neither their piece beyond the edge nor each other, and
    are farther apart than the `kerf` in mm, so that a slit stays between their outlines.
    """
    taken: list[list] = [[] for _ in polygons]
    out: list[Tab] = []
    for joint in joints:
        sides = [_side(paper, polygons, taken, joint, side, depth, kerf) for side in (0, 1)]
        best = max(sides, key=lambda tabs: round(sum(polygon.area for _, polygon in tabs), 6))
        for tab, polygon in best:
            taken[tab.piece].append(polygon)
            out.append(tab)
    return tuple(out)


def _side(paper: Paper, polygons: list, taken: list[list], joint: Joint, side: int, depth: float,
          kerf: float) -> list[tuple[Tab, Any]]:
    """Flaps with their polygons on one side of a joint, as large as there is room."""
    import shapely

    number = joint.pieces[side]
    shapely.prepare(polygons[number])
    found: list[tuple[Tab, Any]] = []
    for label, path in zip(joint.labels, joint.edges(side), strict=True):
        for share in SMALLER:
            base = paper.points[path]
            points, reach = _trapezoid(base if side == 0 else base[::-1], share * depth, kerf)
            polygon = shapely.Polygon(points)
            beyond = polygon.buffer(-2 * OVERLAP, join_style="mitre")
            others = [*taken[number], *(other for _, other in found)]
            near = shapely.dwithin(polygon, others, kerf + SLIT) if kerf else shapely.intersects(polygon, others)
            if polygon.is_valid and not near.any() and not beyond.intersects(polygons[number]):
                found.append((Tab(label, number, points, reach), polygon))
                break
    return found


def _trapezoid(base: np.ndarray, depth: float, kerf: float) -> tuple[np.ndarray, float]:
    """Corners of a flap on the right of a polyline (N, 2), and its depth: sides slope by up to 30 degrees inwards.

    They start inside the ends of the line, so far that the cut between two flaps in a row has room.
    """
    chord = base[-1] - base[0]
    length = float(np.hypot(*chord))
    outwards = np.array([chord[1], -chord[0]]) / length
    depth = min(depth, LONGEST * length)
    clear = max(min(0.3, 0.05 * length), 0.5 * kerf + 0.6 * SLIT if kerf else 0.0)
    clear = min(clear, 0.25 * length)
    slope = min(depth * np.tan(np.radians(30)), 0.25 * length, 0.3 * length - clear)
    foot, top = _inside(base, clear), _inside(base, clear + slope)
    return np.concatenate([foot - OVERLAP * outwards, top[::-1] + depth * outwards]), float(depth)


def _inside(line: np.ndarray, margin: float) -> np.ndarray:
    """A polyline (N, 2) without the first and last `margin` of its length."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    low, high = margin, length[-1] - margin
    within = (length > low) & (length < high)
    at = np.concatenate([[low], length[within], [high]])
    return np.stack([np.interp(at, length, coordinate) for coordinate in line.T], axis=1)

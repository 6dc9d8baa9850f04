"""Glue flaps: trapezoids beyond one side of every cut edge, where there is room for them."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from plisse.fabricate.joints import Joint
from plisse.fabricate.paper import Paper

__all__ = ["Tab", "tabs_for"]

SMALLER = (1.0, 0.6, 0.35)
LONGEST = 1.2
OVERLAP = 0.02


@dataclass(frozen=True, eq=False)
class Tab:
    """A flap (N, 2) of piece `piece` at a numbered edge, in the place of the piece within the development.

    It reaches 0.02 mm into the piece, so that their union is one.
    """

    label: str
    piece: int
    points: np.ndarray


def tabs_for(paper: Paper, polygons: list, joints: tuple[Joint, ...], depth: float) -> tuple[Tab, ...]:
    """Flaps of about `depth` mm on one side of every joint; edges where nothing fits stay without one.

    `polygons` are the pieces as shapely polygons. Flaps touch neither their piece beyond the edge nor each other.
    """
    taken: list[list] = [[] for _ in polygons]
    out: list[Tab] = []
    for joint in joints:
        sides = [_side(paper, polygons, taken, joint, side, depth) for side in (0, 1)]
        best = max(sides, key=lambda tabs: round(sum(polygon.area for _, polygon in tabs), 6))
        for tab, polygon in best:
            taken[tab.piece].append(polygon)
            out.append(tab)
    return tuple(out)


def _side(paper: Paper, polygons: list, taken: list[list], joint: Joint, side: int, depth: float) -> list[tuple[Tab, Any]]:
    """Flaps with their polygons on one side of a joint, as large as there is room."""
    import shapely

    number = joint.pieces[side]
    shapely.prepare(polygons[number])
    found: list[tuple[Tab, Any]] = []
    for label, path in zip(joint.labels, joint.edges(side), strict=True):
        for share in SMALLER:
            base = paper.points[path]
            points = _trapezoid(base if side == 0 else base[::-1], share * depth)
            polygon = shapely.Polygon(points)
            beyond = polygon.buffer(-2 * OVERLAP, join_style="mitre")
            others = [*taken[number], *(other for _, other in found)]
            free = not beyond.intersects(polygons[number]) and not shapely.intersects(polygon, others).any()
            if free and polygon.is_valid:
                found.append((Tab(label, number, points), polygon))
                break
    return found


def _trapezoid(base: np.ndarray, depth: float) -> np.ndarray:
    """Corners of a flap on the right of a polyline (N, 2): sides slope by up to 30 degrees and start inside its ends."""
    chord = base[-1] - base[0]
    length = float(np.hypot(*chord))
    outwards = np.array([chord[1], -chord[0]]) / length
    depth = min(depth, LONGEST * length)
    clear = min(0.3, 0.05 * length)
    slope = min(depth * np.tan(np.radians(30)), 0.25 * length)
    foot, top = _inside(base, clear), _inside(base, clear + slope)
    return np.concatenate([foot - OVERLAP * outwards, top[::-1] + depth * outwards])


def _inside(line: np.ndarray, margin: float) -> np.ndarray:
    """A polyline (N, 2) without the first and last `margin` of its length."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(line, axis=0).T))])
    low, high = margin, length[-1] - margin
    within = (length > low) & (length < high)
    at = np.concatenate([[low], length[within], [high]])
    return np.stack([np.interp(at, length, coordinate) for coordinate in line.T], axis=1)

"""Rectifying strips (Fig. 6): developables that contain a curve and unfold it to a straight line.

On a polyline the rectifying planes are carried along by reflections: the mirror that takes one edge to the next takes
plane to plane. Neighbouring planes meet in rulings that make equal angles with both edges, so the strip between two
parallels of the unfolded curve is exactly straight and its faces are exactly planar.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plisse.errors import Infeasible, InvalidStructure
from plisse.geometry.frames import curvature_vectors
from plisse.geometry.vectors import angle_between, dot, norm, unit
from plisse.solve.principal.seed import rectifying_binormals
from plisse.solve.principal.strip import rulings_between
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure

__all__ = ["RectifyingStrip", "rectifying_strip"]

FEWEST = 8
COPLANAR = 1e-9  # radians between planes below which they do not tell a ruling
STRAIGHT = 1e-9  # curvature times size below which a curve is straight
ROOM = 0.9  # share of the room between curve and meeting rulings that a narrowed strip takes
NARROWEST = 0.2  # share of the width asked for under which a strip is cut instead
LONGEST_CUT = 0.85  # share of its length from which on a strip is cut at an end rather than narrowed
TINY = 1e-12  # a strip may always be widened less than by the inverse of this


@dataclass(frozen=True, eq=False)
class RectifyingStrip:
    """A strip of planar quads along `points` (n, 3) with unit `rulings` (n, 3); face i lies between rulings i and i + 1.

    It reaches from `low` to `high` (model units, across the unfolded curve, low ≤ 0 ≤ high). `normals` (n − 1, 3) are
    those of its faces. Closed curves repeat their first point: strips are cut there. `notes` say what was given up, `kept`
    is the share of the curve's length that the strip has.
    """

    points: np.ndarray
    rulings: np.ndarray
    normals: np.ndarray
    low: float
    high: float
    closed: bool = False
    notes: tuple[str, ...] = ()
    kept: float = 1.0

    @property
    def width(self) -> float:
        """Width of the flat strip."""
        return self.high - self.low

    @cached_property
    def lengths(self) -> np.ndarray:
        """Lengths (n − 1,) of the curve's edges."""
        return norm(np.diff(self.points, axis=0))

    @property
    def length(self) -> float:
        """Length of the curve, which is that of the middle line of the flat strip."""
        return float(self.lengths.sum())

    @cached_property
    def cotangents(self) -> np.ndarray:
        """Cotangent (n,) of the angle between every ruling and the unfolded curve."""
        edges = unit(np.diff(self.points, axis=0))
        along = np.concatenate([dot(self.rulings[:-1], edges), [dot(self.rulings[-1], edges[-1])]])
        return along / np.sqrt(np.maximum(1 - along**2, 1e-30))

    @cached_property
    def straightness_defect(self) -> np.ndarray:
        """How much the unfolded curve turns at inner points (n − 2,), in radians; 0 for an exact strip."""
        edges = np.diff(self.points, axis=0)
        inner = self.rulings[1:-1]
        return angle_between(inner, edges[1:]) + angle_between(inner, -edges[:-1]) - np.pi

    def row(self, across: float) -> np.ndarray:
        """Points (n, 3) of the strip at a distance `across` from the unfolded curve."""
        return self.points + across * (self.rulings * np.sqrt(1 + self.cotangents**2)[:, None])

    @cached_property
    def structure(self) -> PleatedStructure:
        """The strip as a mesh of 3 × n vertices, lower edge, curve and upper edge, with its straight development.

        Where the curve is an edge of the strip there are 2 × n.
        """
        across = np.unique([self.low, 0.0, self.high])
        along = np.concatenate([[0.0], np.cumsum(self.lengths)])
        shifted = along + across[:, None] * self.cotangents
        flat = np.stack([shifted, np.broadcast_to(across[:, None], shifted.shape)], axis=-1)
        vertices = np.stack([self.row(value) for value in across])
        return PleatedStructure(grid(*flat.shape[:2]), vertices.reshape(-1, 3), development=flat.reshape(-1, 2))

    def inclination(self, surface_normals: np.ndarray) -> np.ndarray:
        """Angle (n − 1,) in radians between the faces and a surface with unit normals (n − 1, 3) at their middles.

        0 lies on the surface, π/2 stands on it. On a pseudo-geodesic of inclination θ it is π/2 − θ.
        """
        cosine = np.abs(dot(self.normals, surface_normals))
        return np.arctan2(norm(np.cross(self.normals, surface_normals)), cosine)


def rectifying_strip(points: np.ndarray, width: float, *, closed: bool = False, side: str = "both",
                     reference: np.ndarray | None = None) -> RectifyingStrip:
    """The discrete rectifying developable of a polyline (n, 3), `width` wide on both sides of it together.

    `side` is both, above or below: where the strip lies, seen along the curve's binormal (or along `reference` (n, 3),
    unit vectors near the strip's rulings, if given). Where rulings meet within the width the strip is narrowed, or cut to
    its longest part that can be wide, and a note says so. Raises InvalidStructure for curves that are too short,
    Infeasible where they are straight or no strip is possible.
    """
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all() or len(points) < FEWEST:
        raise InvalidStructure(f"a strip needs a curve of at least {FEWEST} points with three coordinates, found an array "
                               f"of shape {points.shape}")
    if not norm(np.diff(points, axis=0)).min() > 0:
        raise InvalidStructure("two successive points of the curve are the same; remove one")
    if not width > 0 or side not in ("both", "above", "below"):
        raise InvalidStructure(f"a strip of width {width:g} on the side {side!r} is none; give a positive width and one of "
                               "both, above, below")
    strip = _carried(points, closed, reference)
    share = {"both": (-0.5, 0.5), "above": (0.0, 1.0), "below": (-1.0, 0.0)}[side]
    return _fitted(replace(strip, low=share[0] * width, high=share[1] * width))


def _carried(points: np.ndarray, closed: bool, reference: np.ndarray | None) -> RectifyingStrip:
    """The strip without width: rectifying planes and rulings."""
    notes: tuple[str, ...] = ()
    if reference is None:
        reference = _steady_binormals(points, closed)
    following = np.roll(reference, -1, axis=0)
    between = unit(reference + following) if closed else unit(reference + following)[:-1]
    first = points.T[:, None]
    try:
        binormals = rectifying_binormals(first, between.T[:, None], closed)
    except Infeasible:
        notes = ("its rectifying planes do not close, so the faces at its seam differ by an angle",)
        points = np.concatenate([points, points[:1]])
        first, closed = points.T[:, None], False
        binormals = rectifying_binormals(first, between.T[:, None], False)
    edges = unit((np.roll(points, -1, axis=0) - points)[:None if closed else -1]).T[:, None]
    normals = np.cross(edges, binormals, axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        rulings = rulings_between(edges, binormals, normals, closed)[:, 0].T
    normals = normals[:, 0].T
    rulings = _continued(rulings, edges[:, 0].T, binormals[:, 0].T, normals, closed)
    if closed:
        points, rulings = (np.concatenate([part, part[:1]]) for part in (points, rulings))
    if not (np.isfinite(rulings).all() and (norm(rulings) > 0.5).all()):
        raise Infeasible("the curve becomes straight, and along a straight line nothing tells the plane of a strip")
    return RectifyingStrip(points, rulings, normals, 0.0, 0.0, bool(notes) or closed, notes)


def _continued(rulings: np.ndarray, edges: np.ndarray, binormals: np.ndarray, normals: np.ndarray,
               closed: bool) -> np.ndarray:
    """Rulings (n, 3), those between parallel planes interpolated from their neighbours: any direction is exact there."""
    turn = norm(normals - np.roll(normals, 1, axis=0))
    if not closed:
        turn = np.concatenate([[1.0], turn[1:], [1.0]])
    lost = (turn < COPLANAR) | ~np.isfinite(rulings).all(axis=1)
    if not lost.any():
        return rulings
    face = np.minimum(np.arange(len(rulings)), len(edges) - 1)
    known = np.flatnonzero(~lost)
    cotangent = dot(rulings[known], edges[face[known]]) / dot(rulings[known], binormals[face[known]])
    filled = np.interp(np.flatnonzero(lost), known, cotangent) if len(known) else np.zeros(int(lost.sum()))
    out = rulings.copy()
    out[lost] = unit(filled[:, None] * edges[face[lost]] + binormals[face[lost]])
    return out


def _steady_binormals(points: np.ndarray, closed: bool) -> np.ndarray:
    """Binormals (n, 3) that do not change sides at inflections, as rectifying planes do not."""
    vectors = curvature_vectors(points, closed)
    if not closed:
        vectors = np.concatenate([vectors[1:2], vectors[1:-1], vectors[-2:-1]])
    bent = norm(vectors) > STRAIGHT / norm(np.ptp(points, axis=0))
    if not bent.any():
        raise Infeasible("the curve is straight, and along a straight line nothing tells the plane of a strip")
    # where the curve is straight for a moment the last bend before it counts
    last = np.maximum.accumulate(np.where(bent, np.arange(len(vectors)), int(np.argmax(bent))))
    vectors = vectors[last]
    same = np.where(dot(vectors[1:], vectors[:-1]) < 0, -1.0, 1.0)
    steady = np.concatenate([[1.0], np.cumprod(same)])[:, None] * vectors
    before, after = np.roll(steady, 1, axis=0), np.roll(steady, -1, axis=0)
    if closed:
        before[0] *= np.where(dot(before[0], steady[0]) < 0, -1.0, 1.0)
        after[-1] *= np.where(dot(after[-1], steady[-1]) < 0, -1.0, 1.0)
    else:
        before[0], after[-1] = steady[0], steady[-1]
    return unit(before + 2 * steady + after)


def _fitted(strip: RectifyingStrip) -> RectifyingStrip:
    """The strip narrowed, or cut to its longest good part, where rulings meet within its width."""
    room = _room(strip)
    least = float(room.min())
    if least > 1:
        return strip
    percent = 100 * (int(np.argmin(room)) + 0.5) / len(room)
    start, stop = _longest_run(room > 1 / ROOM)
    share = strip.lengths[start:stop].sum() / strip.length
    if least >= NARROWEST / ROOM and share < LONGEST_CUT:
        scale = ROOM * least
        return replace(strip, low=scale * strip.low, high=scale * strip.high, notes=(*strip.notes, (
            f"rulings meet near {percent:.0f} % of its length, so it was narrowed from {strip.width:.3g} to "
            f"{scale * strip.width:.3g}")))
    if stop - start < FEWEST - 1:
        raise Infeasible(f"rulings meet within {0.5 * least * strip.width:.2g} of the curve near {percent:.0f} % of its "
                         f"length, and nowhere is it free for a strip of width {strip.width:g}; ask for narrower strips")
    note = f"rulings meet near {percent:.0f} % of its length, so only {100 * share:.2g} % of it was kept"
    return RectifyingStrip(strip.points[start:stop + 1], strip.rulings[start:stop + 1], strip.normals[start:stop],
                           strip.low, strip.high, False, (*strip.notes, note), float(share))


def _room(strip: RectifyingStrip) -> np.ndarray:
    """Per face (n − 1,) the factor by which the strip may be widened before its rulings meet."""
    turn = np.diff(strip.cotangents)
    closing = np.maximum(-strip.low * turn, -strip.high * turn)
    return np.divide(strip.lengths, closing, out=np.full(len(turn), np.inf), where=closing > TINY * strip.lengths)


def _longest_run(good: np.ndarray) -> tuple[int, int]:
    """First and last + 1 of the longest run of true entries."""
    padded = np.concatenate([[False], good, [False]])
    changes = np.flatnonzero(np.diff(padded.astype(int)))
    if not len(changes):
        return 0, 0
    starts, stops = changes[::2], changes[1::2]
    best = int(np.argmax(stops - starts))
    return int(starts[best]), int(stops[best])

"""What a fit aims at: guiding creases at one resolution, a smooth seed, and guesses read off the guides."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy.interpolate import make_interp_spline

from plisse.geometry.components import cross, dot, norm, unit
from plisse.solve.principal.guide import Guide
from plisse.solve.principal.seed import rectifying_binormals, seed_strip
from plisse.solve.principal.series import SmoothCurve, basis, places
from plisse.solve.principal.strip import Strip, edge_directions, successor

__all__ = ["Target", "aim", "resample"]


@dataclass(frozen=True)
class Target:
    """Guides (m, 3, n) to follow from crease `seed` outwards, within the creases [first, last] and a window.

    `widths` (m,) are typical distances to the neighbour nearer to the seed, `folds` (m,) the signed fold
    angles of the guides, `side` the sign of the strip towards crease seed + 1.
    """

    guides: np.ndarray
    amplitude: float
    closed: bool
    seed: int
    curve: SmoothCurve
    side: float
    half_opening: float
    widths: np.ndarray
    folds: np.ndarray
    first: int
    last: int
    window: float = 1.0

    @property
    def samples(self) -> int:
        """Vertices per crease."""
        return self.guides.shape[2]

    def sides(self) -> tuple[Sequence[int], Sequence[int]]:
        """Creases after and before the seed, in the order of the march; the last of each is a free rim."""
        return range(self.seed + 1, self.last + 1), range(self.seed - 1, self.first - 1, -1)

    @cached_property
    def weights(self) -> np.ndarray:
        """1 (n,) inside the window, the middle part of the creases that is fitted, 0 outside."""
        from_middle = np.abs(2 * places(self.samples, self.closed) - 1)
        return np.where(self.closed | (from_middle <= self.window + 1e-9), 1.0, 0.0)

    @cached_property
    def polylines(self) -> list[Guide]:
        """The guides as polylines with closest points."""
        return [Guide(guide, self.closed) for guide in self.guides]

    @cached_property
    def edge_lengths(self) -> np.ndarray:
        """Mean edge length (m,) of each guide."""
        return norm(np.moveaxis(np.diff(self.guides, axis=2), 1, 0)).mean(axis=1)

    def seed_points(self, displacement: np.ndarray) -> np.ndarray:
        """Seed polylines (3, B, n), displaced by coefficients (B, 2, K) in amplitudes along both normals."""
        points = self._seed[0]
        if displacement.shape[-1] == 0:
            return np.repeat(points, len(displacement), axis=1)
        shapes = basis(displacement.shape[-1], places(self.samples, self.closed), self.closed)
        shift = self.amplitude * (displacement @ shapes)
        return points + shift[:, 0] * self._seed[2] + shift[:, 1] * self._seed[3]

    def seed_strips(self, displacement: np.ndarray, half_opening: np.ndarray) -> tuple[Strip, Strip]:
        """The strips after and before the seed for a batch of displacements (B, 2, K) and angles (B,)."""
        points = self.seed_points(displacement)
        binormals = rectifying_binormals(points, self._seed[1], self.closed)
        after, before = (seed_strip(points, binormals, half_opening, sign * self.side, self.closed)
                         for sign in (1, -1))
        return after, before

    @cached_property
    def _seed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        curve, count = self.curve, self.samples
        return curve.points(count), curve.midpoint_reference(count), *curve.normals(count)

    def within(self, first: int, last: int, window: float = 1.0) -> "Target":
        """The same aim for fewer creases and a part of their length."""
        return replace(self, first=first, last=last, window=window)

    def at(self, samples: int) -> "Target":
        """The same aim at another resolution."""
        if samples == self.samples:
            return self
        return replace(self, guides=resample(self.guides, samples, self.closed))


def aim(guides: np.ndarray, amplitude: float, seed: int, closed: bool) -> Target:
    """Read seed curve, opening, widths and folds off guides (m, 3, n)."""
    count = len(guides)
    edges = [edge_directions(guide[:, None], closed)[:, 0] for guide in guides]
    outward = [_across(guides, edges, seed, seed + step, closed) for step in (1, -1)]
    bisector = unit(outward[0] + outward[1])
    normal = cross(edges[seed], bisector)
    side = 1.0 if np.median(dot(outward[0], normal)) >= 0 else -1.0
    half = np.arctan2(side * dot(outward[0] - outward[1], normal), dot(outward[0] + outward[1], bisector))
    widths, folds = np.ones(count), np.zeros(count)
    for crease in range(count):
        inner = crease - int(np.sign(crease - seed))
        widths[crease] = np.median(norm(guides[crease] - guides[inner])) if crease != seed else 1.0
        if crease != seed and 0 < crease < count - 1:
            folds[crease] = _fold(guides, edges, crease, inner, closed)
    curve = SmoothCurve.fitted(guides[seed], bisector, closed, 0.01 * amplitude)
    half_opening = float(np.median(half))
    return Target(guides, amplitude, closed, seed, curve, side, half_opening, widths, folds, 0, count - 1)


def resample(guides: np.ndarray, samples: int, closed: bool) -> np.ndarray:
    """Guides (m, 3, samples) by cubic splines in the parameter along the curves."""
    count = guides.shape[2]
    if closed:
        around = np.concatenate([guides, guides[..., :1]], axis=2)
        spline = make_interp_spline(np.arange(count + 1) / count, around, k=3, axis=2, bc_type="periodic")
    else:
        spline = make_interp_spline(places(count, closed), guides, k=3, axis=2)
    return spline(places(samples, closed))


def _across(guides: np.ndarray, edges: list, crease: int, neighbour: int, closed: bool) -> np.ndarray:
    """Unit directions (3, faces) from edge midpoints of a crease to a neighbour's, across the edges."""
    towards = _midpoints(guides[neighbour], closed) - _midpoints(guides[crease], closed)
    return unit(towards - dot(towards, edges[crease]) * edges[crease])


def _midpoints(points: np.ndarray, closed: bool) -> np.ndarray:
    return 0.5 * (points + successor(points)) if closed else 0.5 * (points[..., 1:] + points[..., :-1])


def _fold(guides: np.ndarray, edges: list, crease: int, inner: int, closed: bool) -> float:
    """Median signed fold angle of a guide between the strip from `inner` and the strip beyond."""
    back = _across(guides, edges, crease, inner, closed)
    beyond = _across(guides, edges, crease, 2 * crease - inner, closed)
    normal, turned = cross(edges[crease], -back), cross(edges[crease], beyond)
    fold = np.arctan2(dot(turned, -back), dot(turned, normal))
    return float(np.arctan2(np.median(np.sin(fold)), np.median(np.cos(fold))))

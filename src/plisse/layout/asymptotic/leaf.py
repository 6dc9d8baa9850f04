"""A traced curve: cubics in the plane from step to step, which its vertices lie on exactly (§2.6)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import shapely

from plisse.geometry.polyline import arc_length
from plisse.layout.stops import Stop

__all__ = ["BETWEEN", "Leaf", "Steps", "hermite"]

BETWEEN = 8  # chords of the cubic in every step


@dataclass(frozen=True, eq=False)
class Steps:
    """Hermite's cubics through `nodes` (K,) with unit `tangents` (K,), one for each of the step lengths `sizes` (K − 1,)."""

    nodes: np.ndarray
    tangents: np.ndarray
    sizes: np.ndarray

    @cached_property
    def sums(self) -> np.ndarray:
        """Lengths (K,) in the plane up to the nodes."""
        return np.concatenate([[0.0], np.cumsum(self.sizes)])

    @cached_property
    def ends(self) -> np.ndarray:
        """Start, end, and the derivatives there (4, K − 1) of the cubics, whose parameter runs from 0 to 1."""
        a, b = self.nodes[:-1], self.nodes[1:]
        return np.stack([a, b, self.tangents[:-1] * self.sizes, self.tangents[1:] * self.sizes])

    @cached_property
    def samples(self) -> np.ndarray:
        """Places (S,) at the nodes and between them, `BETWEEN` to a step."""
        share = np.arange(BETWEEN) / BETWEEN
        return np.append(hermite(self.ends[:, :, None], share)[0].ravel(), self.nodes[-1:])

    def turned(self) -> "Steps":
        """The same from the other end."""
        return Steps(self.nodes[::-1], -self.tangents[::-1], self.sizes[::-1])

    def followed_by(self, other: "Steps") -> "Steps":
        """These, and then others that begin where they end."""
        return Steps(np.concatenate([self.nodes, other.nodes[1:]]), np.concatenate([self.tangents, other.tangents[1:]]),
                     np.concatenate([self.sizes, other.sizes]))


@dataclass(frozen=True, eq=False)
class Leaf:
    """A curve on a surface: its `steps` in the plane, `points` (S, 3) over their samples, why it ends, and why it ends
    at its first point."""

    steps: Steps
    points: np.ndarray
    stop: Stop
    first_stop: Stop | None = None

    @property
    def places(self) -> np.ndarray:
        """Samples (S,) in the plane."""
        return self.steps.samples

    @cached_property
    def chords(self) -> np.ndarray:
        """The S − 1 chords between samples, as lines of the plane."""
        ends = np.stack([self.places[:-1], self.places[1:]], axis=1)
        return shapely.linestrings(np.stack([ends.real, ends.imag], axis=-1))

    @cached_property
    def plane(self) -> np.ndarray:
        """Length (S,) in the plane up to the samples."""
        return np.interp(np.arange(len(self.points)) / BETWEEN, np.arange(len(self.steps.nodes)), self.steps.sums)

    @cached_property
    def arc(self) -> np.ndarray:
        """Length (S,) in space up to the samples."""
        return arc_length(self.points)

    @property
    def length(self) -> float:
        """Length in space."""
        return float(self.arc[-1])

    def place_at(self, arc: np.ndarray) -> np.ndarray:
        """Places (N,) at lengths (N,) in space."""
        steps, plane = self.steps, np.interp(arc, self.arc, self.plane)
        if not len(steps.sizes):
            return np.repeat(steps.nodes, len(plane))
        step = np.clip(np.searchsorted(steps.sums, plane, side="right") - 1, 0, len(steps.sizes) - 1)
        return hermite(steps.ends[:, step], (plane - steps.sums[step]) / steps.sizes[step])[0]


def hermite(ends: np.ndarray, share: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Places and derivatives (N,) of cubics, given by start, end and the derivatives there (4, N), at shares (N,)."""
    (a, b, u, v), t = ends, share
    back = 1 - t
    place = a * (1 + 2 * t) * back**2 + b * t**2 * (1 + 2 * back) + u * t * back**2 - v * t**2 * back
    return place, 6 * t * back * (b - a) + u * back * (1 - 3 * t) - v * t * (2 - 3 * t)

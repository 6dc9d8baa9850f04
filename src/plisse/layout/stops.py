"""Why a traced curve ends, and the traced curve itself."""

from dataclasses import dataclass
from enum import Enum

import numpy as np

__all__ = ["Stop", "Trace"]


class Stop(Enum):
    """The end of a curve; the member's value says it in words."""

    BOUNDARY = "reached the boundary of the surface"
    LENGTH = "reached the length asked for"
    CURLED_UP = "curled up"
    CLOSED = "closed on itself"
    PARABOLIC = "reached a parabolic curve, beyond which the surface has no asymptotic directions"
    LEFT_CHART = "left the chart: no surface could be found near the next point"

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True, eq=False)
class Trace:
    """A curve on a surface: `points` (K, 3), why it ended there, and why it ended at its first point.

    `first_stop` is None for curves traced in one direction only, which begin at their starting point. Closed curves do
    not repeat their first point. The starting point has index `start`.
    """

    points: np.ndarray
    stop: Stop
    first_stop: Stop | None = None
    start: int = 0

    @classmethod
    def both_ways(cls, backward: "Trace", forward: "Trace") -> "Trace":
        """One curve from two that begin at the same point; if the backward one is closed, that one turned round."""
        if backward.closed:
            return cls(np.concatenate([backward.points[:1], backward.points[:0:-1]]), Stop.CLOSED)
        points = np.concatenate([backward.points[:0:-1], forward.points])
        return cls(points, forward.stop, backward.stop, len(backward.points) - 1)

    @property
    def closed(self) -> bool:
        """Whether the curve returned to where it began."""
        return self.stop is Stop.CLOSED

    @property
    def length(self) -> float:
        """Arc length of the polyline, the closing edge included."""
        points = np.concatenate([self.points, self.points[:1]]) if self.closed else self.points
        return float(np.linalg.norm(np.diff(points, axis=0), axis=1).sum())

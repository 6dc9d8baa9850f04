"""Where a strip lives: the faces between two creases that are sound, out from the middle (§2.4).

What happens to a marched strip at one place does not reach back towards the middle, so a strip that dies at its ends is
exact between them.
"""

from typing import NamedTuple

import numpy as np

from plisse.geometry.components import cross, dot, norm
from plisse.measure.regularity import MIN_SECTOR
from plisse.solve.principal.strip import Strip, successor

__all__ = ["Extent", "living_part"]

MARGIN = 1e-6
CAUSES = ("the crease leaves its strip", "the rulings meet before the crease", "the crease runs along the rulings")


class Extent(NamedTuple):
    """Faces from `first` up to, not including, `end`, and why the strip ends on either side ("" where it does not)."""

    first: int
    end: int
    before: str
    beyond: str

    @property
    def faces(self) -> int:
        """How many there are."""
        return max(0, self.end - self.first)


def living_part(strip: Strip, distances: np.ndarray, within: Extent, closed: bool) -> Extent:
    """The part of a strip (batch of one) up to a crease at distances (1, n) that is sound, inside that of the last strip.

    Faces of closed strips are all sound or none are.
    """
    sound, cause = _soundness(strip, distances, closed)
    sound[:within.first], sound[within.end:] = False, False
    count = len(sound)
    if closed:
        return Extent(0, count, "", "") if sound.all() else Extent(0, 0, cause[int(np.argmin(sound))], "")
    middle = (count + 1) // 2
    bad_before, bad_beyond = np.flatnonzero(~sound[:middle]), np.flatnonzero(~sound[middle:])
    first = int(bad_before[-1]) + 1 if len(bad_before) else 0
    end = middle + int(bad_beyond[0]) if len(bad_beyond) else count
    return Extent(first, end, cause[first - 1] if first > within.first else "", cause[end] if end < within.end else "")


def _soundness(strip: Strip, distances: np.ndarray, closed: bool) -> tuple[np.ndarray, list[str]]:
    """Mask (faces,) of convex faces with angles above the limit of 5°, and what is wrong with the others."""
    beyond = strip.points + distances * strip.rulings
    a, d = strip.points[:, 0], beyond[:, 0]
    following = successor if closed else (lambda row: row[..., 1:])
    b, c = following(a), following(d)
    a, d = (a, d) if closed else (a[:, :-1], d[:, :-1])
    corners, normal = (a, b, c, d), strip.normals[:, 0]
    with np.errstate(all="ignore"):
        angles = []
        for k in range(4):
            out, back = corners[(k + 1) % 4] - corners[k], corners[k - 1] - corners[k]
            angles.append(np.arctan2(dot(cross(out, back), normal), dot(out, back)))
        least = np.min(angles, axis=0)
        ahead = dot(c - d, b - a) > 0
        length = norm(b - a)
        inside = np.minimum(distances[0] if closed else distances[0, :-1], following(distances)[0]) > 0
        sound = (least >= MIN_SECTOR + MARGIN) & inside & ahead & (length > 0)
    kind = np.where(~inside, 0, np.where(~ahead, 1, 2))
    return sound, [CAUSES[k] for k in kind.tolist()]

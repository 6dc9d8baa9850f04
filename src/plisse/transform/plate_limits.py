"""How plates are cut from faces, and how thick they can be: closed formulas, edge by edge."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plisse.errors import InvalidDesign
from plisse.structure.place import place_of
from plisse.transform.outlines import Outlines

__all__ = ["SIDES", "PlateCut", "rounded_down"]

SIDES = {"inner": (-1.0, 0.0), "outer": (0.0, 1.0), "both": (-0.5, 0.5)}
NEGLIGIBLE = 1e-12


@dataclass(frozen=True, eq=False)
class PlateCut:
    """Faces with a thickness and a gap; heights above a face run from `shares[0]` to `shares[1]` thicknesses.

    Edges that are `joined` (C,) to another plate step back by half the gap. Mitred walls lean by half the fold angle φ,
    so at height h an edge lies h tan(φ/2) further inside; hinged ones are square. Boundary edges stay where they are.
    """

    outlines: Outlines
    joined: np.ndarray
    thickness: float
    gap: float
    side: str
    hinged: bool

    @classmethod
    def checked(cls, outlines: Outlines, thickness: float, gap: float, side: str, hinged: bool) -> "PlateCut":
        """The cut, its thickness not yet held against the largest; raises InvalidDesign with the largest possible gap."""
        if side not in SIDES:
            raise InvalidDesign(f"side is {side!r}; give inner, outer or both")
        if not (np.isfinite(thickness) and thickness > 0):
            raise InvalidDesign(f"the thickness is {thickness:g}; give a positive number in model units")
        if not (np.isfinite(gap) and gap >= 0):
            raise InvalidDesign(f"the gap is {gap:g}; give a number in model units that is not negative")
        if hinged and gap == 0:
            raise InvalidDesign("hinged plates need a gap to fold in, and the gap is 0; give one, for example 1")
        cut = cls(outlines, outlines.neighbour >= 0, thickness, gap, side, hinged)
        if not gap < cut.largest_gap:
            raise InvalidDesign(f"a gap of {gap:g} leaves nothing of plate {cut._at(cut._gap_limits)}; "
                                f"the largest possible gap is {rounded_down(cut.largest_gap)}")
        return cut

    @property
    def shares(self) -> tuple[float, float]:
        """Heights of the lower and upper outline over the face, in thicknesses."""
        return SIDES[self.side]

    @property
    def largest_gap(self) -> float:
        """The gap in model units at which some edge of an outline vanishes."""
        return float(self._gap_limits.min())

    @property
    def largest_thickness(self) -> float:
        """The thickness in model units that no edge allows to be exceeded in this state; may be infinite."""
        return float(self._thickness_limits.min())

    @property
    def thickest_place(self) -> str:
        """What happens at the largest thickness, and at which plate."""
        what = "plates would run into each other as they fold" if self.hinged else "an edge would shrink to nothing"
        return f"{what} at plate {self._at(self._thickness_limits)}"

    def with_thickness(self, thickness: float) -> "PlateCut":
        """The same cut with another thickness, unchecked."""
        return replace(self, thickness=thickness)

    def on(self, outlines: Outlines) -> "PlateCut":
        """The same cut on the same faces in another state, perhaps cut open; unchecked."""
        return replace(self, outlines=outlines)

    def solids(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper outlines (C, 3) in space."""
        low, high = (self.outlines.shifted(self.setback + self._lean(share), share * self.thickness)
                     for share in self.shares)
        return low, high

    @cached_property
    def steepness(self) -> np.ndarray:
        """tan(φ/2) (C,) at every edge, counted positive where plates come nearer as the edge folds, times their share."""
        tangent = np.tan(0.5 * self.outlines.fold)
        return np.maximum(self.shares[0] * tangent, self.shares[1] * tangent)

    @property
    def setback(self) -> np.ndarray:
        """How far (C,) edges step back in the plane of the face, in model units."""
        return 0.5 * self.gap * self.joined

    def _lean(self, share: float) -> np.ndarray:
        """How much further inside (C,) walls are at a height of `share` thicknesses than at the face."""
        tangent = np.tan(0.5 * self.outlines.fold)
        return np.zeros_like(tangent) if self.hinged else share * self.thickness * tangent

    @cached_property
    def _gap_limits(self) -> np.ndarray:
        """Per edge (C,) the gap at which it vanishes."""
        loss = self.outlines.loss(0.5 * self.joined)
        return _ratio(self.outlines.lengths, loss)

    @cached_property
    def _thickness_limits(self) -> np.ndarray:
        """Per edge (C,): a mitred edge vanishes; square plates with gap g over a fold φ meet at (g/2) cot(φ/2)."""
        if self.hinged:
            return _ratio(np.full(len(self.steepness), 0.5 * self.gap), self.steepness)
        room = self.outlines.lengths - self.outlines.loss(self.setback)
        tangent = np.tan(0.5 * self.outlines.fold)
        return np.min([_ratio(room, self.outlines.loss(share * tangent)) for share in self.shares], axis=0)

    def _at(self, limits: np.ndarray) -> str:
        """The plate and the place where a limit is reached."""
        corner, corners = int(np.argmin(limits)), self.outlines.topology.corners
        return f"{corners.face[corner] + 1} ({place_of(self.outlines.topology, int(corners.vertex[corner]))})"


def rounded_down(limit: float) -> str:
    """Five digits of a positive limit, rounded so that the number itself still works."""
    if not 0 < limit < np.inf:
        return f"{limit:g}"
    digits = 10.0 ** (np.floor(np.log10(limit)) - 4)
    return f"{np.floor(limit / digits * (1 - 1e-9)) * digits:.10g}"


def _ratio(room: np.ndarray, rate: np.ndarray) -> np.ndarray:
    """room / rate where the rate is positive beyond round-off, else infinite."""
    return np.divide(room, rate, where=rate > NEGLIGIBLE, out=np.full_like(room, np.inf))

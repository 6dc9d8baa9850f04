"""Plates of constant thickness on the faces of a principal structure: mitred, or square on a film (§2.4, Figs 9 and 26)."""

from dataclasses import dataclass
from functools import cached_property
from typing import Literal

import numpy as np

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.vectors import cross_flat, dot, norm, unit
from plisse.measure.convex_overlap import ConvexSolids
from plisse.measure.regularity import inverted_faces
from plisse.structure.pleated import PleatedStructure
from plisse.transform.offset import offset_axes
from plisse.transform.outlines import Outlines
from plisse.transform.plate_limits import PlateCut, rounded_down
from plisse.transform.principal import require_principal

__all__ = ["Plates", "plates"]

TOUCHING = 1e-9


@dataclass(frozen=True, eq=False)
class Plates:
    """One convex solid per face, in the order of the faces: `lower` and `upper` (C, 3) are its outlines in space.

    Both follow `structure.topology.corners`; the upper one lies on the side that faces are oriented to. `cut` says how
    they were cut; lengths are in model units, angles in radians. Numbers shown to people start at 1.
    """

    structure: PleatedStructure
    cut: PlateCut
    lower: np.ndarray
    upper: np.ndarray

    @property
    def count(self) -> int:
        """Number of plates."""
        return self.structure.topology.face_count

    @cached_property
    def corners(self) -> np.ndarray:
        """Corners (F, k) of every plate, shorter outlines padded by repeating their first corner."""
        return padded_corners(self.structure)

    @property
    def neighbours(self) -> np.ndarray:
        """Plate (C,) across each edge, −1 on the boundary."""
        return self.cut.outlines.neighbour

    @cached_property
    def bevels(self) -> np.ndarray:
        """Tilt (C,) of each wall against a square cut: half the fold angle, positive where the upper outline is smaller."""
        return np.zeros(len(self.lower)) if self.cut.hinged else 0.5 * self.cut.outlines.fold

    @cached_property
    def flat(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper outlines (C, 2) in each plate's plane, counterclockwise seen from above.

        The first corner of the lower outline is the origin, its first edge the x axis.
        """
        face = self.structure.topology.corners.face
        first = np.flatnonzero(np.append(True, face[1:] != face[:-1]))
        x = unit(self.lower[self.cut.outlines.following[first]] - self.lower[first])
        y = np.cross(self.cut.outlines.normals[first], x)
        origin = self.lower[first]
        lower, upper = (np.stack([dot(points - origin[face], axis[face]) for axis in (x, y)], axis=-1)
                        for points in (self.lower, self.upper))
        return lower, upper

    @cached_property
    def areas(self) -> np.ndarray:
        """Area (F,) of the larger outline of each plate: what it is cut from."""
        lower, upper = (self._areas(outline) for outline in self.flat)
        return np.maximum(lower, upper)

    @cached_property
    def volumes(self) -> np.ndarray:
        """Volume (F,) of each plate; exact, because cross sections grow quadratically."""
        lower, upper = self.flat
        ends = self._areas(lower) + self._areas(upper)
        return self.cut.thickness / 6 * (ends + 4 * self._areas(0.5 * (lower + upper)))

    @cached_property
    def widths(self) -> np.ndarray:
        """Smallest width (F,) of each plate's outlines: the least distance of two parallels around it."""
        return np.minimum(*(self._widths(outline) for outline in self.flat))

    @cached_property
    def largest_thickness(self) -> float:
        """The thickness in model units up to which no edge vanishes and no two plates collide; may be infinite."""
        limit = self.cut.largest_thickness
        if not np.isfinite(limit):
            return limit
        most = limit * (1 - 1e-9)
        struck = _struck(self, most)
        return _collision_limit(self, struck, self.cut.thickness, most) if len(struck) else limit

    @cached_property
    def strips(self) -> np.ndarray:
        """Number (F,) of the strip between two creases that each plate belongs to, from 0."""
        label = self.structure.topology.strip_of_faces
        _, first = np.unique(label, return_index=True)
        return np.argsort(np.argsort(first))[label]

    @cached_property
    def warnings(self) -> tuple[str, ...]:
        """A sentence about plates that are narrower than they are thick."""
        slim = np.flatnonzero(self.widths < self.cut.thickness)
        if len(slim) == 0:
            return ()
        worst = int(np.argmin(self.widths))
        others = f" and {len(slim) - 1} more" if len(slim) > 1 else ""
        return (f"plate {worst + 1}{others} would be slim: {self.widths[worst]:.3g} wide, less than the thickness "
                f"{self.cut.thickness:g}; a smaller gap, thinner plates or fewer samples help",)

    def _areas(self, outline: np.ndarray) -> np.ndarray:
        following = outline[self.cut.outlines.following]
        return 0.5 * np.bincount(self.structure.topology.corners.face, cross_flat(outline, following), self.count)

    def _widths(self, outline: np.ndarray) -> np.ndarray:
        points = outline[self.corners]
        along = np.roll(points, -1, axis=1) - points
        heights = cross_flat(along[:, :, None], points[:, None] - points[:, :, None]).max(axis=2)
        length = norm(along)
        return np.divide(heights, length, where=length > 0, out=np.full_like(length, np.inf)).min(axis=1)


def plates(structure: PleatedStructure, thickness: float, *, gap: float = 0.0,
           side: Literal["inner", "outer", "both"] = "outer", hinged: bool = False) -> Plates:
    """Solid plates on all faces of a principal structure, none of which intersect in the state given.

    `thickness` and `gap` are in model units. Plates lie on the `outer` side, to which faces are oriented, on the
    `inner` one, or half on `both`. Mitred plates meet in the planes through the cone axes, four of them in each node;
    `hinged` ones are cut square and stand `gap` apart on a film, so that the structure still moves. Boundary edges are
    cut square. Raises InvalidStructure for structures that are not principal, InvalidDesign with the largest possible
    value for a thickness or gap that is too large, Infeasible where the structure cuts through itself.
    """
    if hinged:
        require_principal(structure, "plates on it would not move")
    else:
        offset_axes(structure)
    wrong = np.flatnonzero(inverted_faces(structure.topology, structure.vertices))
    if len(wrong):
        raise Infeasible(f"plate {wrong[0] + 1} cannot be cut: its face is folded over or not convex")
    cut = PlateCut.checked(Outlines(structure.topology, structure.vertices), thickness, gap, side, hinged)
    made = Plates(structure, cut, *cut.solids())
    _refuse_thickness(made)
    return made


def padded_corners(structure: PleatedStructure) -> np.ndarray:
    """Corner indices (F, k) of every face, shorter ones padded by repeating the first."""
    topology = structure.topology
    size = max([4] + [len(hub) for hub in topology.hubs])
    rows = [np.arange(topology.quads.size).reshape(-1, 4)]
    rows[0] = np.concatenate([rows[0], np.repeat(rows[0][:, :1], size - 4, axis=1)], axis=1)
    start = topology.quads.size
    for hub in topology.hubs:
        row = start + np.arange(size)
        rows.append(np.where(np.arange(size) < len(hub), row, start)[None])
        start += len(hub)
    return np.concatenate(rows)


def _refuse_thickness(made: Plates) -> None:
    """Raises InvalidDesign with the largest thickness where edges vanish or plates run into each other."""
    cut = made.cut
    edges = cut.largest_thickness
    most = min(cut.thickness, edges * (1 - 1e-9))
    struck = _struck(made, most)
    if len(struck) == 0 and cut.thickness < edges:
        return
    low = _collision_limit(made, struck, 0.0, most) if len(struck) else edges
    if low == 0:
        one, other = struck[0] + 1
        raise Infeasible(f"the structure cuts through itself at plates {one} and {other}; make one that does not first")
    if cut.thickness < edges:
        one, other = struck[0] + 1
        raise InvalidDesign(f"plates {one} and {other} would run into each other at thickness {cut.thickness:g}; "
                            f"the largest possible thickness is {rounded_down(low)}")
    raise InvalidDesign(f"plates of thickness {cut.thickness:g} are not possible: {cut.thickest_place}; "
                        f"the largest possible thickness is {rounded_down(low)}")


def _struck(made: Plates, thickness: float, pairs: np.ndarray | None = None) -> np.ndarray:
    """Pairs (P, 2) of plates that collide at a thickness, of those given or of all."""
    lower, upper = made.cut.with_thickness(thickness).solids()
    solids = ConvexSolids(lower[made.corners], upper[made.corners])
    return solids.overlapping(solids.near() if pairs is None else pairs, TOUCHING * made.structure.diagonal)


def _collision_limit(made: Plates, struck: np.ndarray, low: float, high: float) -> float:
    """The thickness from which some of the pairs (P, 2) collide that do at `high`, to 1e-6; `low` where they all do."""
    while high - low > 1e-6 * high and high > 1e-9 * made.cut.thickness:
        middle = 0.5 * (low + high)
        found = _struck(made, middle, struck)
        low, high, struck = (low, middle, found) if len(found) else (middle, high, struck)
    return low

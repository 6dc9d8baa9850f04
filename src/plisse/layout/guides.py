"""Guides on a surface: geodesics, curves through points, boundary loops and plane sections (§3.1, Fig. 2)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import CubicSpline

from plisse.errors import Infeasible, InvalidDesign
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.polyline import arc_length, sample_evenly
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import norm, unit
from plisse.layout.geodesic import geodesic

__all__ = ["Guide", "boundary_guide", "guide_through", "section_guide"]

NODES = 400


@dataclass(frozen=True, eq=False)
class Guide:
    """A curve on a surface as a dense polyline (K, 3); closed ones do not repeat their first point.

    `one_sided` guides are crossed to the left only (along n × m): boundary loops.
    """

    points: np.ndarray
    closed: bool = False
    one_sided: bool = False

    @property
    def length(self) -> float:
        """Arc length."""
        return float(self._spline.x[-1])

    def at(self, positions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points and unit tangents (N, 3) at arc lengths (N,)."""
        return self._spline(positions), unit(self._spline(positions, 1))

    def reversed(self) -> "Guide":
        """The same curve run through backwards: pleats lean the other way."""
        return Guide(self.points[::-1], self.closed, self.one_sided)

    @cached_property
    def _spline(self) -> CubicSpline:
        points = np.concatenate([self.points, self.points[:1]]) if self.closed else self.points
        return CubicSpline(arc_length(self.points, self.closed), points,
                           bc_type="periodic" if self.closed else "not-a-knot")


def guide_through(surface: Surface, points, closed: bool = False) -> Guide:
    """The geodesic between two points, or the smooth curve through more of them, taken onto the surface."""
    points = np.asarray(points, dtype=float)
    if points.ndim != 2 or points.shape[1] != 3 or not np.isfinite(points).all() or len(points) < (3 if closed else 2):
        raise InvalidDesign(f"a guide needs {'three' if closed else 'two'} points [x, y, z] or more")
    if closed and len(points) > 3 and norm(points[-1] - points[0]) <= 1e-9 * surface.diagonal:
        points = points[:-1]
    if not norm(np.diff(points, axis=0)).min() > 1e-9 * surface.diagonal:
        raise InvalidDesign("two successive points of the guide are the same")
    if len(points) == 2:
        return Guide(geodesic(surface, points[0], points[1], NODES))
    return _onto(surface, points, closed)


def boundary_guide(surface: Surface, mesh: ReferenceMesh, loop: int = 0) -> Guide:
    """A boundary loop of the mesh (0: the longest), the surface on its left."""
    loops = mesh.boundary_loops
    if loop >= len(loops):
        raise InvalidDesign(f"the surface has {len(loops)} boundary loops, so there is no loop {loop + 1} to guide creases")
    return Guide(_onto(surface, mesh.vertices[loops[loop]], True).points, True, one_sided=True)


def section_guide(surface: Surface, mesh: ReferenceMesh, point, normal) -> Guide:
    """The curve in which a plane cuts the mesh; of several the one nearest to `point`. It runs along n × normal."""
    point, normal = np.asarray(point, dtype=float), unit(np.asarray(normal, dtype=float))
    lines = _sections(mesh, (mesh.vertices - point) @ normal)
    if not lines:
        raise InvalidDesign("the plane of the guide does not meet the surface")
    line, closed = min(lines, key=lambda candidate: norm(candidate[0] - point).min())
    guide = _onto(surface, line, closed)
    middle = len(guide.points) // 2
    tangent = guide.points[middle + 1] - guide.points[middle - 1]
    wanted = np.cross(surface.project(guide.points[middle:middle + 1]).normals[0], normal)
    return guide if tangent @ wanted > 0 else guide.reversed()


def _sections(mesh: ReferenceMesh, height: np.ndarray) -> list[tuple[np.ndarray, bool]]:
    """Polylines (K, 3) on which heights (V,) over the mesh vanish, and whether they are closed."""
    above = height >= 0
    start, end = mesh.half_edges.T
    fraction = height[start] / np.where(above[start] == above[end], np.nan, height[start] - height[end])
    points = mesh.vertices[start] + fraction[:, None] * (mesh.vertices[end] - mesh.vertices[start])
    crossed = np.flatnonzero(np.isfinite(fraction)).reshape(-1, 2)  # half-edges 3f + k: two in every face that is cut
    rising = ~above[start[crossed[:, 0]]]
    enter = np.where(rising, crossed[:, 1], crossed[:, 0])
    leave = np.where(rising, crossed[:, 0], crossed[:, 1])
    following = dict(zip(enter.tolist(), leave.tolist(), strict=True))
    entered = {int(mesh.twins[edge]) for edge in leave}
    lines = []
    for first in sorted(following, key=lambda edge: edge in entered):  # open lines begin where nothing leads
        if first not in following:
            continue
        edge, chain = first, [first]
        while edge in following:
            exit_ = following.pop(edge)
            chain.append(exit_)
            edge = int(mesh.twins[exit_])
        closed = edge == first
        line = points[chain[:-1] if closed else chain]
        apart = np.concatenate([[True], norm(np.diff(line, axis=0)) > 1e-9 * mesh.diagonal])
        if apart.sum() > 3:
            lines.append((line[apart], closed))
    return lines


def _onto(surface: Surface, points: np.ndarray, closed: bool) -> Guide:
    """Evenly sampled points of the curve through the points, on the surface."""
    even = sample_evenly(points, NODES, closed)
    found = surface.project(even).positions
    if not np.isfinite(found).all():
        raise Infeasible("the guide leaves the surface; give points that lie on it")
    return Guide(found, closed)

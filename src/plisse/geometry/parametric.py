"""Smooth surfaces X(u, v) over a flattened mesh, for sheets and tubes that are no graphs; continued beyond the rim."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.interpolate import NdBSpline
from scipy.spatial import cKDTree

from plisse.errors import Infeasible
from plisse.geometry.bending import bending, symmetric
from plisse.geometry.conformal import flattened_sheet, flattened_tube, stretches
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.outline import Outline
from plisse.geometry.surface import SurfacePoints
from plisse.geometry.thin_plate import smoothing_spline
from plisse.geometry.vectors import dot, norm, unit

__all__ = ["ParametricSurface"]

MAX_CELLS = 220
DERIVATIVES = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
SEEDS = 160  # points along the longer side from which projections start
MOST_STRETCHED = 12.0  # times a length may be longer in one place of the plane than in another


@dataclass(frozen=True, eq=False)
class ParametricSurface:
    """Quintic spline X(u, v) in space over the conformally flattened mesh, close to the vertices and with little energy.

    The energy is that of GraphSurface, for each coordinate. A tube is rolled out: X has a `period` in u. Beyond the
    rim curvature dies away over `decay` diagonals; the continuation is `margin` diagonals wide, after that the
    surface runs on straight. Raises Infeasible for surfaces without boundary, with handles, and for those that cannot
    be laid flat.
    """

    mesh: ReferenceMesh
    margin: float = 0.15
    smoothing: float = 0.4
    decay: float = 0.2

    def __post_init__(self):
        characteristic = len(self.mesh.vertices) - len(self.mesh.edges) + len(self.mesh.triangles)
        loops = len(self.mesh.boundary_loops)
        if loops == 0:
            raise Infeasible("the surface has no boundary, so rows cannot be laid over the whole of it; cut it open, or "
                             "give surface.guide or surface.point")
        if characteristic != 2 - loops:
            raise Infeasible("the surface has handles, so it cannot be flattened for rows; cut it open, or give "
                             "surface.guide or surface.point")
        _ = self.places

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box."""
        return self.mesh.diagonal

    @property
    def places(self) -> np.ndarray:
        """Chart coordinates (V, 2) of the vertices."""
        return self._flattened[0]

    @property
    def period(self) -> float | None:
        """After how much u a tube closes; None for sheets."""
        return self._flattened[1]

    def at(self, places: np.ndarray) -> SurfacePoints:
        """The surface at chart coordinates (N, 2)."""
        position, *partials = self._derivatives(places)
        normals = unit(np.cross(partials[0], partials[1]))
        second = [dot(part, normals) for part in partials[2:]]
        return SurfacePoints(position, normals, bending(partials[:2], second), self._is_known(places))

    def project(self, points: np.ndarray) -> SurfacePoints:
        """Closest points to points (N, 3), on the continuation too."""
        return self.at(self._feet(np.asarray(points, float)))

    def to_plane(self, points: np.ndarray) -> np.ndarray:
        """Chart coordinates of the closest points and signed distances from them (N, 3)."""
        places = self._feet(np.asarray(points, float))
        found = self.at(places)
        return np.concatenate([places, dot(points - found.positions, found.normals)[:, None]], axis=1)

    def to_space(self, coordinates: np.ndarray) -> np.ndarray:
        """Points (N, 3) at given chart coordinates and distances (N, 3)."""
        found = self.at(coordinates[:, :2])
        return found.positions + coordinates[:, 2:] * found.normals

    @cached_property
    def domain(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper corner (2,) of the rectangle on which the spline lives; one period of tubes."""
        margin = self.margin * np.linalg.norm(np.ptp(self.places, axis=0))
        low, high = self.places.min(axis=0) - margin, self.places.max(axis=0) + margin
        if self.period is not None:
            low[0], high[0] = 0.0, self.period
        return low, high

    @cached_property
    def deviation(self) -> float:
        """Largest distance of a vertex from the surface at its own place, in the direction of the normal."""
        found = self.at(self.places)
        return float(np.abs(dot(found.positions - self.mesh.vertices, found.normals)).max())

    @cached_property
    def _flattened(self) -> tuple[np.ndarray, float | None]:
        """Places and period: a sheet, or a tube where there are two rims and that stretches less."""
        ways: list[tuple[np.ndarray, float | None]] = []
        if _is_simple(self.mesh, sheet := flattened_sheet(self.mesh)):
            ways.append((sheet, None))
        if len(self.mesh.boundary_loops) == 2:
            ways.append(flattened_tube(self.mesh))
        spreads = [_spread(self.mesh, *way) for way in ways]
        if min(spreads, default=np.inf) > MOST_STRETCHED:
            raise Infeasible("the surface cannot be laid flat without folding over or stretching more than "
                             f"{MOST_STRETCHED:g} times; cut it into simpler parts, or give surface.guide or surface.point")
        return ways[int(np.argmin(spreads))]

    def _derivatives(self, places: np.ndarray) -> list[np.ndarray]:
        """X, its two first and three second derivatives (N, 3); straight beyond the domain."""
        places = self._in_period(places)
        low, high = self.domain
        held = np.clip(places, low, high)
        found = [self._spline(held, nu=nu) for nu in DERIVATIVES]
        beyond = places - held
        found[0] = found[0] + beyond[:, :1] * found[1] + beyond[:, 1:] * found[2]
        return found

    def _feet(self, points: np.ndarray) -> np.ndarray:
        """Chart coordinates (N, 2) of closest points: Newton's method from the nearest of many samples."""
        tree, starts = self._seeds
        places = starts[tree.query(points)[1]]
        longest = 2 * float((self.domain[1] - self.domain[0]).max()) / SEEDS
        for _ in range(20):
            position, xu, xv, xuu, xuv, xvv = self._derivatives(places)
            gap = points - position
            first = np.stack([dot(gap, xu), dot(gap, xv)], axis=-1)
            metric = symmetric(dot(xu, xu), dot(xu, xv), dot(xv, xv))
            matrix = metric - symmetric(dot(gap, xuu), dot(gap, xuv), dot(gap, xvv))
            safe = (np.linalg.det(matrix) > 0.1 * np.linalg.det(metric)) & (np.trace(matrix, axis1=1, axis2=2) > 0)
            step = np.linalg.solve(np.where(safe[:, None, None], matrix, metric), first[..., None])[..., 0]
            step *= np.minimum(1, np.where(safe, 10, 1) * longest / np.maximum(norm(step), 1e-300))[:, None]
            places = places + step
            if not np.abs(step).max(initial=0) > 1e-11 * self.diagonal:
                break
        return self._in_period(places)

    def _in_period(self, places: np.ndarray) -> np.ndarray:
        return places if self.period is None else np.stack([places[:, 0] % self.period, places[:, 1]], axis=-1)

    def _is_known(self, places: np.ndarray) -> np.ndarray:
        if self.period is not None:
            low, high = self.places[:, 1].min(), self.places[:, 1].max()
            slack = 1e-9 * self.diagonal
            return np.asarray((places[:, 1] >= low - slack) & (places[:, 1] <= high + slack))
        return self._outline.inside(np.concatenate([places, np.zeros((len(places), 1))], axis=1))

    @cached_property
    def _outline(self) -> Outline:
        return Outline(ReferenceMesh(np.concatenate([self.places, np.zeros((len(self.places), 1))], axis=1),
                                     self.mesh.triangles))

    @cached_property
    def _seeds(self) -> tuple[cKDTree, np.ndarray]:
        low, high = self.domain
        counts = np.maximum(np.ceil((high - low) / (high - low).max() * SEEDS).astype(int), 8)
        places = np.stack(np.meshgrid(*(np.linspace(a, b, count) for a, b, count in zip(low, high, counts, strict=True)),
                                      indexing="ij"), axis=-1).reshape(-1, 2)
        return cKDTree(self._derivatives(places)[0]), places

    @cached_property
    def _spline(self) -> NdBSpline:
        low, high = self.domain
        spacing = max(self.mesh.edge_length, float((high - low).max()) / MAX_CELLS)
        strength = len(self.places) / self.mesh.area * (self.smoothing * self.mesh.edge_length) ** 6
        extent = float(np.linalg.norm(np.ptp(self.places, axis=0)))
        return smoothing_spline(self.places, self.mesh.vertices, low, high, spacing, strength,
                                (self.decay * extent) ** -2, periodic=self.period is not None)


def _spread(mesh: ReferenceMesh, places: np.ndarray, period: float | None) -> float:
    """How many times more a flattened mesh stretches in one place than in another, infinite if it folds over."""
    stretch = stretches(mesh, places, period)
    return float(stretch.max() / stretch.min()) if (stretch > 0).all() else np.inf


def _is_simple(mesh: ReferenceMesh, places: np.ndarray) -> bool:
    """Whether the boundary of a flattened mesh does not cross itself."""
    from shapely import Polygon

    loops = sorted((places[loop] for loop in mesh.boundary_loops), key=lambda loop: -float(np.prod(np.ptp(loop, axis=0))))
    return bool(Polygon(loops[0], loops[1:]).is_valid)

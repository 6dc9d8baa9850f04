"""Layouts of fitted inclination that may cover a whole surface: sizes, centres, and nets with their masks."""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.mesh import ReferenceMesh
from plisse.geometry.vectors import norm
from plisse.layout.columns import Net, woven
from plisse.layout.coverage import AreaSamples, located
from plisse.layout.rows import ChartedSurface, Rows, circles, following, preceding, rows_between
from plisse.layout.rows_relax import Relaxation, relaxed
from plisse.structure.masks import grown

__all__ = ["Layout", "Sizes", "centres", "lay_out", "sensible_width", "starting_rows"]

STRIPS = 32  # a surface about as wide as long gets this many
SHARPEST = 0.5  # width times the curvature that 95 % of the surface stay below
GAPS = (0.35, 2.9)
LEAST_AREA = 0.02
UPRIGHT_LIMIT, OVERHANG_LIMIT = np.radians(45.0), np.radians(58.0)


@dataclass(frozen=True)
class Sizes:
    """Width s and amplitude d in model units, θ preferred and its limit in radians, weight of the curvature residual.

    `column` is the distance of columns in widths. The first crease lies `above` the surface or below; with `inside` no
    row reaches beyond its boundary.
    """

    width: float
    amplitude: float
    theta: float = 0.0
    limit: float = UPRIGHT_LIMIT
    curvature: float = 1.0
    column: float = 0.8
    above: bool = False
    inside: bool = False


@dataclass(frozen=True, eq=False)
class Layout:
    """A net over a surface, its zigzag (n, m, 3), and the mask (n−1, m or m−1) of quads that meet the surface.

    Rows run around `centre` (2,) in the chart where there is one.
    """

    sizes: Sizes
    net: Net
    zigzag: np.ndarray
    mask: np.ndarray
    label: str = ""
    centre: np.ndarray | None = None


def sensible_width(mesh: ReferenceMesh, surface: ChartedSurface) -> float:
    """Width from the size of a surface, smaller where it is strongly curved."""
    bending = surface.project(mesh.vertices).bending
    sharp = float(np.quantile(np.sqrt((bending**2).sum(axis=(1, 2))), 0.95))
    by_size = np.sqrt(mesh.area) / STRIPS
    return float(min(by_size, SHARPEST / sharp)) if sharp * by_size > SHARPEST else float(by_size)


def centres(mesh: ReferenceMesh, surface: ChartedSurface, count: int = 20) -> Iterator[np.ndarray]:
    """Centres (2,) of circles around a surface in its chart: near and far ones in turn, well spread from the start."""
    places = surface.to_plane(mesh.vertices)[:, :2]
    low, high = places.min(axis=0), places.max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * float(norm(high - low))
    # the golden angle spreads any number of directions evenly
    for k in range(count):
        angle = 0.2 + k * np.pi * (3 - np.sqrt(5))
        distance = half * (1.35, 2.2, 4.0)[k % 3]
        yield middle + distance * np.array([np.cos(angle), np.sin(angle)])


def starting_rows(mesh: ReferenceMesh, surface: ChartedSurface, centre: np.ndarray | None, width: float, *,
                  parallel: bool = True) -> Rows:
    """Rows about a centre (2,) in the chart, or between the two boundary loops of an annulus when there is none.

    Raises Infeasible where there are no such loops, or where they are not star-shaped.
    """
    places = surface.to_plane(mesh.vertices)[:, :2]
    if centre is not None:
        return circles(surface, places, np.asarray(centre, float), width)
    if len(mesh.boundary_loops) != 2:
        raise Infeasible(f"rows between boundaries need two boundary loops, and this surface has "
                         f"{len(mesh.boundary_loops)}; give a centre")
    one, other = (places[loop] for loop in mesh.boundary_loops)
    inner, outer = sorted((one, other), key=lambda loop: float(np.prod(np.ptp(loop, axis=0))))
    middle = 0.5 * (inner.min(axis=0) + inner.max(axis=0))
    if not (_goes_round_once(inner - middle) and _goes_round_once(outer - middle)):
        raise Infeasible("the two boundary loops are not seen once around from the middle of the inner one, so rows "
                         "cannot be interpolated between them; give a centre")
    return rows_between(surface, inner, outer, middle, width, parallel=parallel)


def lay_out(rows: Rows, samples: AreaSamples, surface: ChartedSurface, sizes: Sizes, label: str = "",
            grow: int = 1) -> Layout:
    """Relax rows, weave columns across them, and keep the quads that meet the surface and `grow` around them."""
    between = rows.closed and rows.spacing is not None
    options = Relaxation(curvature=sizes.curvature, limit=sizes.limit, preferred=sizes.theta,
                         held=sizes.inside and between)
    rows, theta = relaxed(rows, surface, sizes.width, options)
    net = replace(woven(rows, theta, surface, sizes.column * sizes.width), above=sizes.above)
    mask = meeting(net, samples, sizes, grow)
    if sizes.inside and not between:
        mask &= _within(net, surface)
    net = net.shifted(surface, sizes.amplitude)
    return Layout(sizes, net, net.zigzag(sizes.amplitude), mask, label)


def meeting(net: Net, samples: AreaSamples, sizes: Sizes, grow: int) -> np.ndarray:
    """Quads (n−1, m or m−1) of a net that meet the sampled surface, with neighbours, where gaps are sensible."""
    columns = net.shape[1]
    width = columns if net.closed else columns - 1
    strips = len(net.gaps)
    one, other = preceding(net.points, net.is_ring), following(net.points, net.is_ring)
    quads = np.stack([one, np.roll(one, -1, axis=1), np.roll(other, -1, axis=1), other], axis=2)[:, :width]
    where = located(samples, quads.reshape(-1, 4, 3), sizes.width)
    found = where >= 0
    area = np.bincount(where[found], samples.areas[found], strips * width).reshape(strips, width)
    meets = grown(area > LEAST_AREA * sizes.column * sizes.width**2, net.closed, grow, net.is_ring)
    gaps = net.gaps / sizes.width
    sensible = (gaps > GAPS[0]) & (gaps < GAPS[1])
    return meets & (sensible & np.roll(sensible, -1, axis=1))[:, :width]


def _within(net: Net, surface: ChartedSurface) -> np.ndarray:
    """Quads (n − 1, m or m − 1) of a net all of whose corners lie inside the boundary of the surface."""
    known = surface.project(net.points.reshape(-1, 3)).known.reshape(net.shape)
    pairs = following(known, net.is_ring) & preceding(known, net.is_ring)
    return (pairs & np.roll(pairs, -1, axis=1))[:, :net.shape[1] - (not net.closed)]


def _goes_round_once(loop: np.ndarray) -> bool:
    """Whether the angle of a loop (N, 2) around the origin goes once around, nearly monotonically."""
    angle = np.arctan2(loop[:, 1], loop[:, 0])
    turn = np.diff(np.append(angle, angle[0]))
    turn = (turn + np.pi) % (2 * np.pi) - np.pi
    return bool(abs(abs(turn.sum()) - 2 * np.pi) < 1e-6 and np.abs(turn).sum() < 1.1 * 2 * np.pi)

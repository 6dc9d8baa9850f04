"""Curves of constant inclination on a surface, as lanes for strips (Fig. 6)."""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.polyline import sample_evenly, tangents
from plisse.geometry.surface import Surface
from plisse.geometry.vectors import norm
from plisse.layout.guides import Guide
from plisse.layout.trace import trace
from plisse.transform.arrangement import Lane

__all__ = ["lanes_on_surface"]

STEPS = 300  # per diagonal of the surface
SHORTEST = 0.1  # of the median length: shorter curves are corners of the surface


def lanes_on_surface(surface: Surface, guide: Guide, *, theta: float, spacing: float, side: float = 1.0, samples: int = 120,
                     reach: float | None = None) -> list[Lane]:
    """Pseudo-geodesics of inclination `theta` (radians), shot across a guide every `spacing` of its length (§3.1).

    `side` ±1 says to which side their osculating planes lean. All curves have `samples` points at equal distances; those
    of less than a tenth of the median length are left out. Raises Infeasible where none is left.
    """
    count = max(1, round(guide.length / spacing))
    places = guide.length * (np.arange(count) / count if guide.closed else (np.arange(count) + 0.5) / count)
    starts, along = guide.at(places)
    across = np.cross(surface.project(starts).normals, along)
    traces = [curve for curve in trace(surface, starts, across, theta, side, length=reach, step=surface.diagonal / STEPS)
              if len(curve.points) > 4]
    if not traces:
        raise Infeasible("no curve could be traced across the guide; move the guide, or take another theta")
    typical = float(np.median([curve.length for curve in traces]))
    return [_lane(surface, curve.points, curve.closed, theta, side, samples) for curve in traces
            if curve.length > SHORTEST * typical]


def _lane(surface: Surface, points: np.ndarray, closed: bool, theta: float, side: float, samples: int) -> Lane:
    """Even points with the surface's normals and the binormals of a pseudo-geodesic: cos θ n − σ sin θ n × t."""
    if closed and norm(points[-1] - points[0]) < 0.05 * norm(points[1] - points[0]):
        points = points[:-1]
    even = sample_evenly(points, samples + (closed and samples % 2 == 0), closed)
    normals = surface.project(even).normals
    sideways = np.cross(normals, tangents(even, closed))
    return Lane(even, normals, np.cos(theta) * normals - side * np.sin(theta) * sideways, closed)

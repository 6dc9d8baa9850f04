"""The evolution of §3.2 as printed: binormals by optimisation, one step of Fig. 14 per strip."""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.frames import Frame, curvature_vectors
from plisse.geometry.polyline import arc_length, tangents
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.binormal import binormal_fit
from plisse.layout.evolve import refuse_collapse
from plisse.leastsquares.levenberg import Status, levenberg_marquardt
from plisse.leastsquares.problem import Problem
from plisse.structure.pattern import Pattern

__all__ = ["evolve_literally", "optimised_frame"]

DOSE = 0.1  # 0.01 still oscillates with 240 points per curve, 0.001 with 120


def evolve_literally(seed: np.ndarray, theta: np.ndarray, widths: np.ndarray, *, closed: bool = False,
                     dose: float = DOSE) -> Pattern:
    """Pattern of m pseudo-geodesics that starts with the seed (n, 3), inclined by θ (m,) in radians.

    One step v[n+1] = v[n] + s (cosθ e2 + sinθ e3) per strip of `widths` (m−1, n). `dose` weighs the
    regulariser of the binormals; its effect depends on the resolution, as in the paper. Circles become cones
    exactly; in general the error is proportional to the width of a strip, and finely sampled curves need
    larger doses to stay smooth. Raises Infeasible with crease, place and remedy where the pattern collapses.
    """
    frame = optimised_frame(seed, closed, dose)
    curves, binormals = [seed], [frame.binormal]
    for strip, width in enumerate(widths):
        direction = np.cos(theta[strip]) * frame.principal_normal + np.sin(theta[strip]) * frame.binormal
        before = curves[-1]
        points = before + width[:, None] * direction
        refuse_collapse(points.T, before.T, seed.T, strip + 1, closed)
        frame = optimised_frame(points, closed, dose)
        curves.append(points)
        binormals.append(frame.binormal)
    return Pattern(np.array(curves), np.array(binormals), np.asarray(theta, float), widths, closed)


def optimised_frame(points: np.ndarray, closed: bool, dose: float = DOSE) -> Frame:
    """Frame of a polyline (n, 3) whose binormals minimise the functional of §3.2, for unit mean edges."""
    tangent = tangents(points, closed)
    scaled = points * ((len(points) - (not closed)) / arc_length(points, closed)[-1])
    count = len(points)
    place = np.arange(count)
    key = np.where(2 * place < count, 2 * place, 2 * (count - place) - 1) if closed else place
    problem = Problem(binormal_fit(scaled, closed, dose), {"binormals": (3, key)})
    start = {"binormals": _osculating(scaled, closed).T}
    found = levenberg_marquardt(problem, start, iterations=60)
    if found.status is Status.NOT_FINITE:
        raise Infeasible("a guiding curve has coinciding points; "
                         "lower pattern.width or the number of creases")
    smooth = found.blocks["binormals"].T
    binormal = unit(smooth - dot(smooth, tangent)[:, None] * tangent)
    return Frame(tangent, np.cross(binormal, tangent), binormal)


def _osculating(points: np.ndarray, closed: bool) -> np.ndarray:
    """Unit normals (n, 3) of the planes through three successive points, copied to straight places."""
    vectors = curvature_vectors(points, closed)
    bent = norm(vectors) > 1e-9
    if not bent.any():
        raise Infeasible("a guiding curve is straight and has no side to evolve to; start from a bent curve")
    place, where = np.arange(len(points)), np.flatnonzero(bent)
    nearest = where[np.argmin(np.abs(place[:, None] - where), axis=1)]
    return unit(vectors[nearest])

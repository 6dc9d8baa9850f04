"""Rows relaxed towards even gaps and pseudo-geodesics whose inclination is fitted on the way."""

from dataclasses import dataclass

import numpy as np

from plisse.layout.grid_fit import GridFit, across_pairs, along_triples, nodes
from plisse.layout.inclination import CURVATURE_SCALE, InclinationFit
from plisse.layout.rows import ChartedSurface, RowGeometry, Rows, following, preceding

__all__ = ["Relaxation", "relaxed"]

WAVINESS = 0.02
DAMPING = 0.02
FIRST_STEPS = 8


@dataclass(frozen=True)
class Relaxation:
    """How rows are relaxed: `steps`, weight of the `curvature` residual against the gaps, `limit` of |θ| in radians.

    θ is drawn towards `preferred` where the rows do not decide. The first and the last row may be `held` in place.
    """

    steps: int = 8
    curvature: float = 1.0
    limit: float = np.radians(58.0)
    preferred: float = 0.0
    held: bool = False


def relaxed(rows: Rows, surface: ChartedSurface, width: float,
            options: Relaxation = Relaxation()) -> tuple[Rows, np.ndarray]:
    """Rows after Gauss–Newton steps, and the inclinations θ (n, m) in radians that suit them.

    The energy is Σ ((gap − s)/s)² + w (6.5 s (κ_g sin θ − κ_n cos θ))² + the variation of κ_g along rows.
    """
    shape = rows.radii.shape
    inclination = InclinationFit(shape, rows.closed, width, options.limit, options.preferred, rows.is_ring)
    across, triples = across_pairs(shape, rows.is_ring), along_triples(shape, rows.closed)
    fit = GridFit(shape, rows.closed, [across, triples, triples, nodes(shape)], rows.is_ring)
    theta = np.full(shape, options.preferred)
    for step in range(options.steps + 1):
        geometry = RowGeometry.of(rows, surface)
        theta = inclination.improved(theta, geometry, FIRST_STEPS if step == 0 else 2)
        if step == options.steps:
            break
        wanted = width if rows.spacing is None else rows.spacing
        move = _move(fit, geometry, theta, width, geometry.gaps - wanted, options.curvature, across, triples)
        if options.held:
            move[[0, -1]] = 0.0
        move *= min(1.0, width / max(float(np.abs(move).max()), 1e-300))
        rows = rows.moved(move, 0.2 * width)
    return rows, theta


def _move(fit: GridFit, geometry: RowGeometry, theta: np.ndarray, width: float, excess: np.ndarray,
          curvature: float, across: np.ndarray, triples: np.ndarray) -> np.ndarray:
    """Change of the radii (n, m) in one Gauss–Newton step; `excess` (n−1, m) is how much gaps are too wide.

    Normals and directions are kept as they are.
    """
    scale = CURVATURE_SCALE * width
    share = np.sqrt(geometry.steps / width)
    stretch = np.maximum(geometry.stretch, 0.2)
    of_gap = 0.5 * (following(share, geometry.is_ring) + preceding(share, geometry.is_ring)).ravel()
    gap = (of_gap / width)[:, None] * stretch.ravel()[across] * [-1.0, 1.0]
    bend = -stretch.ravel()[triples] * [1.0, -2.0, 1.0] / geometry.steps.ravel()[:, None] ** 2 * scale
    sine = (np.sqrt(curvature) * share * np.sin(theta)).ravel()
    wavy = np.sqrt(WAVINESS) * share
    mean = geometry.geodesic.mean(axis=1, keepdims=True)
    residual = scale * (geometry.geodesic * np.sin(theta) - geometry.normal * np.cos(theta))
    return fit.solve(
        [gap, sine[:, None] * bend, wavy.ravel()[:, None] * bend, np.sqrt(DAMPING) / width * share],
        [of_gap * excess.ravel() / width, np.sqrt(curvature) * share * residual,
         scale * wavy * (geometry.geodesic - mean), np.zeros_like(theta)])

"""What can be known before anything is solved: no asymptotic curves, too much twist, singularities too crowded (§2.6)."""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.chart import Chart
from plisse.layout.asymptotic.pattern import AsymptoticLayout, room_in_the_middle

__all__ = ["refuse_crowded_hubs", "refuse_domes", "refuse_positive_curvature", "refuse_twist"]

SAMPLES = 60  # along each side of the domain
MOST_POSITIVE = 0.05  # of the vertices of a pattern
RULING_ANGLE = 3.7  # τ/(κ sin β) at which rulings are 15° from the crease, β the slope of the strips
STRAIGHT = 1e4
MOST_TWIST = 2.0  # times as much in the median
SMALLEST_HUB = 0.75  # of the room that is taken where none is asked for
FLAT = 1e-9  # of the inverse square of the diagonal


def refuse_positive_curvature(chart: Chart) -> None:
    """Raises Infeasible where most of the surface is curved like a dome, and has no asymptotic curves."""
    low, high = chart.domain
    u, v = np.meshgrid(np.linspace(low.real, high.real, SAMPLES), np.linspace(low.imag, high.imag, SAMPLES))
    places = (u + 1j * v).ravel()
    places = places[chart.inside(places)]
    _refuse(places, chart, 0.5, "the surface")


def refuse_domes(layout: AsymptoticLayout) -> None:
    """Raises Infeasible where a notable part of a pattern lies over positive curvature."""
    _refuse(layout.net.places, layout.chart, MOST_POSITIVE, "the pattern")


def refuse_crowded_hubs(layout: AsymptoticLayout) -> None:
    """Raises Infeasible where columns begin too near to a singularity, or where two singularities share one polygon."""
    if not layout.hubs:
        return
    least = SMALLEST_HUB * room_in_the_middle(layout.hubs) * layout.width
    if layout.hub < least:
        raise Infeasible(f"the first columns are {layout.hub:.3g} from the singularity, too near for creases "
                         f"{layout.width:.3g} apart: faces around it would be slivers; give pattern.hub_size of at least "
                         f"{least:.3g}, or a smaller pattern.width")
    found = len(layout.net.topology.hubs)
    if found < len(layout.hubs):
        raise Infeasible(f"the surface has {len(layout.hubs)} singularities, but only {found} of them got a polygon of "
                         "their own between creases and columns; give a smaller pattern.width, more columns, or a smaller "
                         "part of the surface")


def refuse_twist(layout: AsymptoticLayout, amplitude: float) -> None:
    """Raises Infeasible where the surface twists so much that rulings would be nearly tangent to the creases."""
    slope = 2 * amplitude / layout.width
    limit = RULING_ANGLE * slope / np.hypot(1, slope)
    twist = float(np.median(layout.bends.twist))
    if twist > MOST_TWIST * limit:
        size = f"{twist:.2g} in the middle of all values" if twist < STRAIGHT else "beyond all bounds, for they are straight"
        raise Infeasible("the surface twists too much along its creases for such pleats: torsion over curvature is "
                         f"{size}, and from {limit:.2g} on rulings are within 15° of the "
                         "creases; give a flatter surface, a larger pattern.amplitude, or the other surface.family")


def _refuse(places: np.ndarray, chart: Chart, most: float, what: str) -> None:
    curvature, points = chart.at(places).curvature, chart.positions(places)
    share = float(np.mean(curvature > -FLAT / (np.ptp(points, axis=0) ** 2).sum()))
    if share > most:
        kind = "positive curvature" if curvature.max() > 0 else "no curvature"
        where = ", ".join(f"{x:.4g}" for x in points[np.argmax(curvature)])
        raise Infeasible(f"{what} has {kind} over {100 * share:.0f} % of its area, most of all at ({where}); asymptotic "
                         "curves exist only where it is negative, so choose another part of the surface, or creases along a "
                         "guide")

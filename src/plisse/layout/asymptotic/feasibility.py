"""What can be known before anything is solved: no asymptotic curves, too much twist, singularities too crowded (§2.6)."""

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.chart import Chart
from plisse.layout.asymptotic.beginning import samples
from plisse.layout.asymptotic.pattern import AsymptoticLayout
from plisse.layout.asymptotic.sizing import room_in_the_middle

__all__ = ["refuse_crowded_hubs", "refuse_domes", "refuse_few_columns", "refuse_positive_curvature", "refuse_twist",
           "refuse_uneven_charts", "refuse_unlike_amplitude", "share_without_curves"]

MOST_POSITIVE = 0.05  # of the vertices of a pattern
RULING_ANGLE = 3.7  # τ/(κ sin β) at which rulings are 15° from the crease, β the slope of the strips
STRAIGHT = 1e4
MOST_TWIST = 2.0  # times as much in the median
SMALLEST_HUB = 0.75  # of the room that is taken where none is asked for
FLAT = 1e-9  # of the inverse square of the diagonal
MOST_UNEVEN = 1e5
AMPLITUDES = 0.02, 10.0  # widths
FEWEST_COLUMNS = 0.2  # of those laid out


def refuse_uneven_charts(chart: Chart) -> None:
    """Raises Infeasible where lengths in the plane say nothing about lengths on the surface, which may shrink to a point."""
    places, inside = samples(chart)
    e, _, g = chart.at(places[inside]).metric
    low, high = np.quantile(np.sqrt(e + g), [0.02, 0.98])
    if not (np.isfinite(high) and high > 0 and low > high / MOST_UNEVEN):
        what = "shrinks to a point" if not high > 0 else \
            f"stretches its plane {high / max(low, high * 1e-300):.0e} times more in one place than in another (limit " \
            f"{MOST_UNEVEN:.0e})"
        raise Infeasible(f"the surface {what}; give other data, or a smaller range of surface.x and surface.y")


def refuse_positive_curvature(chart: Chart) -> None:
    """Raises Infeasible where most of the surface is curved like a dome, and has no asymptotic curves."""
    places, inside = samples(chart)
    _refuse(places[inside], chart, 0.5, "the surface")


def share_without_curves(chart: Chart) -> float:
    """Share of the samples of a chart that are curved like a dome."""
    places, inside = samples(chart)
    return float(np.mean(chart.at(places[inside]).curvature > 0))


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
    if found < layout.closed_hubs:
        several = layout.closed_hubs > 1
        raise Infeasible((f"{layout.closed_hubs} singularities have room, but only {found} of them got a polygon of their"
                          " own"
                          if several else "the singularity of the surface got no polygon of its own")
                         + " between creases and columns; give a smaller pattern.width, more columns, or a smaller part of "
                         "the surface")


def refuse_unlike_amplitude(layout: AsymptoticLayout, amplitude: float) -> None:
    """Raises Infeasible for amplitudes that are no match for the width of the strips."""
    low, high = AMPLITUDES
    if not low < amplitude / layout.width < high:
        raise Infeasible(f"pattern.amplitude is {amplitude:.4g}, but creases are {layout.width:.3g} apart; give an "
                         "amplitude of about half of that, or another pattern.width")


def refuse_few_columns(layout: AsymptoticLayout, before: int) -> None:
    """Raises Infeasible where hardly anything that folds is left of the `before` columns of a pattern."""
    left = len(layout.net.columns)
    if layout.topology.is_boundary.all() or left < FEWEST_COLUMNS * before:
        lost = f"{before - left} of {before} columns are cut off, where creases beside the legs hardly bend; what is left " \
            if left < before else "what is left "
        raise Infeasible(lost + "is no pattern: no pleat runs on from there; give fewer creases, a larger pattern.width or "
                         "a smaller pattern.reach")


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
    whole = chart.positions(np.array(chart.domain))
    share = float(np.mean(curvature > -FLAT / (np.ptp(whole, axis=0) ** 2).sum()))
    if share > most:
        kind = "positive curvature" if curvature.max() > 0 else "no curvature"
        where = ", ".join(f"{x:.4g}" for x in points[np.argmax(curvature)])
        raise Infeasible(f"{what} has {kind} over {100 * share:.0f} % of its area, most of all at ({where}); asymptotic "
                         "curves exist only where it is negative, so choose another part of the surface, or creases along a "
                         "guide")

"""Where a pattern without singularities begins: a place with asymptotic curves, well inside (§2.6)."""

import numpy as np
from scipy.spatial import cKDTree

from plisse.errors import Infeasible
from plisse.geometry.chart import Chart

__all__ = ["beginning", "samples"]

SAMPLES = 60  # along each side of the domain


def samples(chart: Chart) -> tuple[np.ndarray, np.ndarray]:
    """Places (N,) on a grid over the domain, and the mask (N,) of those that belong to the surface."""
    low, high = chart.domain
    u, v = np.meshgrid(np.linspace(low.real, high.real, SAMPLES), np.linspace(low.imag, high.imag, SAMPLES))
    places = (u + 1j * v).ravel()
    return places, chart.inside(places)


def beginning(chart: Chart) -> complex:
    """The middle of the domain if the surface is curved negatively there, else the place with most such room around it.

    Raises Infeasible where there is none.
    """
    low, high = chart.domain
    middle = np.array([0.5 * (low + high)])
    if chart.inside(middle)[0] and chart.at(middle).curvature[0] < 0:
        return complex(middle[0])
    places, inside = samples(chart)
    good = inside.copy()
    good[inside] = chart.at(places[inside]).curvature < 0
    if not good.any():
        raise Infeasible("no part of the surface has negative curvature, so it has no asymptotic curves; choose another one")
    plane = np.column_stack([places.real, places.imag])
    room = np.minimum.reduce([places.real - low.real, high.real - places.real, places.imag - low.imag,
                              high.imag - places.imag])
    if not good.all():
        room = np.minimum(room, cKDTree(plane[~good]).query(plane)[0])
    return complex(places[np.argmax(np.where(good, room, -1))])

"""Singularities: where they are, their index, and the curves that end in them."""

import numpy as np
import pytest

from plisse.geometry.chart import FormulaChart
from plisse.geometry.height_field import HeightField
from plisse.geometry.weierstrass import MinimalSurface
from plisse.layout.asymptotic.directions import Directions
from plisse.layout.asymptotic.singularities import radial_directions, singularities


@pytest.mark.parametrize("order", [1, 2, 3, 4])
def test_a_zero_of_order_m_of_the_derivative_of_g_has_index_minus_m_halves(order):
    found = singularities(MinimalSurface(f"z**{order + 1}", "1", (-0.9, 1.0), (-1.0, 0.8)))
    assert len(found) == 1
    assert found[0].index == -order / 2
    assert found[0].sectors == order + 2
    # zeros of order m are found to the m-th root of round-off
    assert abs(found[0].place) < 10 * np.finfo(float).eps ** (1 / order)


def test_several_singularities_are_found_with_their_places_and_indices():
    chart = MinimalSurface("z**4/4 - 0.1*z**3", "1")  # g′ = z² (z − 0.3)
    found = sorted(singularities(chart), key=lambda single: single.place.real)
    assert [single.index for single in found] == [-1, -0.5]
    assert abs(found[1].place - 0.3) < 1e-9
    assert abs(found[0].place) < 1e-6  # a double zero


def test_a_saddle_has_no_singularity_and_an_umbilic_of_a_dome_has_one():
    assert singularities(FormulaChart(HeightField("x*y"))) == ()
    umbilic, = singularities(FormulaChart(HeightField("x**2 + y**2 + x**3 - 3*x*y**2")))
    assert umbilic.index == -0.5


def test_a_skewed_monkey_saddle_keeps_its_index():
    chart = FormulaChart(HeightField("x**3 - 3*x*y**2 + 0.2*x**4 + 0.1*x*y + 0.05*sin(2*x)*cos(y)"))
    found = singularities(chart)
    assert [single.index for single in found] == [-0.5]
    one, mixed, two = chart.at(np.array([found[0].place])).second
    assert np.abs([one - two, mixed]).max() < 1e-10


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("family", [1, 2])
def test_separatrices_leave_at_equal_angles_with_bisectors_between(order, family):
    chart = MinimalSurface(f"z**{order + 1}", "1", (-0.9, 1.0), (-1.0, 0.8))
    hub = singularities(chart)[0]
    directions = Directions(chart, family)
    legs, bisectors = (np.sort(np.angle(radial_directions(directions, hub, 0.05, field)) % (2 * np.pi))
                       for field in ("creases", "columns"))
    assert len(legs) == len(bisectors) == hub.sectors
    np.testing.assert_allclose(np.diff(legs), 2 * np.pi / hub.sectors, atol=1e-4)  # interpolated between samples
    gap = (bisectors[:, None] - legs) % (2 * np.pi / hub.sectors)
    np.testing.assert_allclose(gap, np.pi / hub.sectors, atol=1e-4)


@pytest.mark.parametrize("scale", [1e-6, 1.0, 1e6])
def test_places_are_found_to_the_same_share_of_the_domain_in_every_unit(scale):
    chart = MinimalSurface(f"(z/{scale} - 0.3)**2", "1", (-0.9 * scale, scale), (-scale, 0.8 * scale))
    found, = singularities(chart)
    assert abs(found.place / scale - 0.3) < 1e-11


def test_singularities_within_two_cells_are_taken_together_in_their_middle():
    found, = singularities(MinimalSurface("z**3/3 - 1e-6*z", "1", (-0.5, 0.5), (-0.5, 0.5)))
    assert found.index == -1
    assert abs(found.place) < 1e-9
    np.testing.assert_allclose(sorted(other.real for other in found.others), [-1e-3, 1e-3], rtol=1e-6)

"""Crossings of creases and columns against curves that are known in closed form."""

import numpy as np
import pytest

from plisse.geometry.chart import FormulaChart, GraphChart
from plisse.geometry.graph import GraphSurface
from plisse.geometry.height_field import HeightField
from plisse.geometry.weierstrass import MinimalSurface
from plisse.layout.asymptotic.crossings import Crossings, met
from plisse.layout.asymptotic.curves import Limits, trace_both_ways
from plisse.layout.asymptotic.directions import Directions

MONKEY = MinimalSurface("z**2", "1")
SADDLE = HeightField("exp(x) - exp(y)", (-1, 1), (-1, 1))
STEPS = 0.2 / 2 ** np.arange(4)


def laid_over(chart, starts, crossed, step, length=3):
    """Crossings of creases through some places with columns through others."""
    directions, limits = Directions(chart, 1), Limits(length, step)
    return Crossings.of(trace_both_ways(directions, starts, "creases", limits),
                        trace_both_ways(directions, crossed, "columns", limits))


def straightened(places):
    """∫ √(2iz) dz: on g = z² creases keep its real or its imaginary part, columns the other one."""
    return np.sqrt(2j) * 2 / 3 * places**1.5


def order(errors):
    return np.polyfit(np.log(STEPS), np.log(errors), 1)[0]


def test_crossings_on_a_minimal_surface_converge_with_fourth_order():
    starts, crossed = 0.45 + 0.1j * np.arange(-2, 3), 0.62 + 0.07j * np.arange(-2, 3)
    errors = []
    for step in STEPS:
        found = laid_over(MONKEY, starts, crossed, step)
        crease, column = straightened(starts[found.crease]), straightened(crossed[found.column])
        off = straightened(found.places)
        either = (np.abs((off - crease).real) + np.abs((off - column).imag),
                  np.abs((off - crease).imag) + np.abs((off - column).real))
        errors.append(min(error.max() for error in either))
        assert len(found.places) >= 15
    assert order(errors) > 3.7
    assert errors[-1] < 1e-6


def test_creases_of_a_sum_of_exponentials_converge_with_fourth_order():
    """z = eˣ − eʸ is flat along curves on which e^(x/2) + e^(y/2) or their difference stays the same."""
    starts, crossed = 0.1 * np.arange(-4, 5) + 0j, 0.3j * np.arange(-2, 3) + 0.05
    errors = []
    for step in STEPS:
        found = laid_over(FormulaChart(SADDLE), starts, crossed, step)
        errors.append(min(np.abs(kept(found.places, sign) - kept(starts[found.crease], sign)).max() for sign in (1, -1)))
    assert order(errors) > 3.7
    assert errors[-1] < 1e-7


def test_creases_of_a_sampled_mesh_are_those_of_the_surface():
    starts, crossed = 0.1 * np.arange(-4, 5) + 0j, 0.3j * np.arange(-2, 3) + 0.05
    surface = GraphSurface(SADDLE.mesh(40))
    chart = GraphChart(surface)
    moved = laid_over(chart, in_chart(surface, starts), in_chart(surface, crossed), 0.05)
    places = chart.positions(moved.places)[:, :2] @ [1, 1j]
    errors = [np.abs(kept(places, sign) - kept(starts[moved.crease], sign)).max() for sign in (1, -1)]
    assert min(errors) < 2e-3  # second derivatives of a spline through samples 0.05 apart


def kept(places, sign):
    return np.exp(0.5 * places.real) + sign * np.exp(0.5 * places.imag)


def in_chart(surface, places):
    height = SADDLE.derivatives(places.real, places.imag)[0]
    return surface.to_plane(np.column_stack([places.real, places.imag, height]))[:, :2] @ [1, 1j]


def test_crossings_lie_on_both_curves_to_round_off():
    found = laid_over(MONKEY, np.array([0.4, 0.5 + 0.1j]), 0.6 + 0.05j * np.arange(3), 0.1)
    for number, leaf in enumerate(found.creases):
        on = found.crease == number
        arc = np.interp(found.along[on], leaf.plane, leaf.arc)
        np.testing.assert_allclose(leaf.place_at(arc), found.places[on], atol=1e-14)
    for number, leaf in enumerate(found.columns):
        on = found.column == number
        arc = np.interp(found.across[on], leaf.plane, leaf.arc)
        np.testing.assert_allclose(leaf.place_at(arc), found.places[on], atol=1e-14)


def test_creases_with_many_vertices_turn_to_one_side():
    """Curves on which Re or Im z^(3/2) is constant are convex; chords would show as corners."""
    found = laid_over(MONKEY, np.array([0.3, 0.4, 0.5]), 0.6 + 0.5j * np.linspace(-1, 1, 601), 0.06, 0.7)
    for number in range(3):
        on = np.flatnonzero(found.crease == number)
        sides = np.diff(found.places[on[np.argsort(found.along[on])]])
        turns = np.angle(sides[1:] * np.conj(sides[:-1]))
        assert len(turns) > 250
        assert (np.sign(turns) == np.sign(turns[0])).all()


def test_columns_that_are_added_and_left_out_again_change_nothing():
    starts, crossed = np.array([0.4, 0.5 + 0.1j]), 0.6 + 0.05j * np.arange(4)
    whole = laid_over(MONKEY, starts, crossed, 0.1)
    some = whole.only(np.array([True, False, True, False]))
    assert some.columns == (whole.columns[0], whole.columns[2])
    again = some.with_columns([whole.columns[1], whole.columns[3]])
    for name in ("places", "along", "across"):
        np.testing.assert_allclose(np.sort(getattr(again, name)), np.sort(getattr(whole, name)), rtol=1e-13)


@pytest.mark.parametrize("ones", [(), "curves"])
def test_curves_that_meet_nothing_have_no_crossings(ones):
    curves = trace_both_ways(Directions(MONKEY), np.array([0.5 + 0j]), "creases", Limits(0.5, 0.1))
    found = met(curves if ones else (), ())
    assert [len(values) for values in found] == [0] * 5

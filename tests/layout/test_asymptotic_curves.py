"""Asymptotic curves against those that theory gives, and why they end."""

import numpy as np
import pytest

from plisse.geometry.chart import FormulaChart
from plisse.geometry.height_field import HeightField
from plisse.geometry.vectors import dot
from plisse.geometry.weierstrass import MinimalSurface
from plisse.layout.asymptotic.curves import Limits, trace_both_ways, trace_leaves
from plisse.layout.asymptotic.directions import Directions
from plisse.layout.stops import Stop

MONKEY = MinimalSurface("z**2", "1")
SADDLE = FormulaChart(HeightField("x**3 - 3*x*y**2"))


def straightened(places):
    """w = ∫ √(2iz) dz along a curve: asymptotic curves of g = z² have constant Re w or Im w."""
    angle = np.unwrap(np.angle(places))
    return np.sqrt(2j) * 2 / 3 * np.abs(places) ** 1.5 * np.exp(1.5j * angle)


@pytest.mark.parametrize("family", [1, 2])
def test_traced_curves_converge_to_exact_ones_with_fourth_order(family):
    errors, steps = [], 0.1 / 2 ** np.arange(4)
    for step in steps:
        leaf = trace_both_ways(Directions(MONKEY, family), np.array([0.5 + 0.3j]), "creases", Limits(0.8, step))[0]
        ends = straightened(leaf.steps.nodes)
        errors.append(min(np.ptp(ends.real), np.ptp(ends.imag)))
    assert np.polyfit(np.log(steps), np.log(errors), 1)[0] > 3.7
    assert errors[-1] < 1e-7


def test_families_are_orthogonal_on_minimal_surfaces_and_never_mix():
    one, two = (trace_both_ways(Directions(MONKEY, family), np.array([0.3 + 0.1j]), "creases", Limits(3, 0.02))[0]
                for family in (1, 2))
    first, second = straightened(one.places), straightened(two.places)
    assert min(np.ptp(first.real), np.ptp(first.imag)) < 1e-6
    assert min(np.ptp(second.real), np.ptp(second.imag)) < 1e-6
    assert (np.ptp(first.real) < 1e-6) != (np.ptp(second.real) < 1e-6)


def test_columns_cross_creases_at_right_angles_in_space():
    places = np.array([0.3 + 0.1j, -0.2 + 0.5j, 0.6 - 0.4j])
    directions, points = Directions(SADDLE, 1), SADDLE.at(places)
    crease, column = (directions.at(places, np.ones(3, complex), field) for field in ("creases", "columns"))
    one, two = (d.real[:, None] * points.partials[0] + d.imag[:, None] * points.partials[1] for d in (crease, column))
    np.testing.assert_allclose(dot(one, two), 0, atol=1e-14)


def test_asymptotic_directions_have_no_normal_curvature():
    places = np.array([0.3 + 0.1j, -0.2 + 0.5j, 0.6 - 0.4j])
    for family in (1, 2):
        t = Directions(SADDLE, family).at(places, np.ones(3, complex))
        one, mixed, two = SADDLE.at(places).second
        np.testing.assert_allclose(one * t.real**2 + 2 * mixed * t.real * t.imag + two * t.imag**2, 0, atol=1e-13)


def test_asymptotic_curves_of_a_helicoid_are_helices_and_lines():
    helicoid = MinimalSurface("exp(z)", "i*exp(-z)", (0.2, 1.8), (-2, 2))
    spans = []
    for family in (1, 2):
        leaf = trace_both_ways(Directions(helicoid, family), np.array([1 + 0j]), "creases", Limits(9, 0.05))[0]
        from_axis = leaf.points - helicoid.positions(np.array([0j]))
        spans.append(np.ptp(np.hypot(from_axis[:, 0], from_axis[:, 1])))
        assert leaf.stop is leaf.first_stop is Stop.BOUNDARY
    assert min(spans) < 1e-12
    assert max(spans) > 1


def test_curves_reach_a_boundary_up_to_a_fraction_of_a_step():
    leaf = trace_leaves(Directions(SADDLE, 1), [0.5 + 0.3j], [1 + 0j], "creases", Limits(9, 0.1))[0]
    end = leaf.places[-1]
    assert leaf.stop is Stop.BOUNDARY
    assert min(1 - abs(end.real), 1 - abs(end.imag)) < 0.02


def test_curves_end_where_they_are_long_enough():
    leaf = trace_leaves(Directions(SADDLE, 1), [0.5 + 0.3j], [1 + 0j], "creases", Limits(0.25, 0.1))[0]
    assert leaf.stop is Stop.LENGTH
    assert np.abs(np.diff(leaf.places)).sum() == pytest.approx(0.25, rel=1e-3)  # the chord of a short arc


def test_curves_end_at_parabolic_curves_unless_a_patch_is_allowed():
    chart = FormulaChart(HeightField("x**3 - y**2"))  # K < 0 for x > 0
    directions = Directions(chart, 1)
    stopped, through = (trace_leaves(directions, [0.5 + 0j], [-1 + 0j], "creases", Limits(2, 0.02, patch))[0]
                        for patch in (0.0, 9.0))
    assert stopped.stop is Stop.PARABOLIC
    assert 0 < stopped.places[-1].real < 0.03
    assert through.places.real.min() < -0.05

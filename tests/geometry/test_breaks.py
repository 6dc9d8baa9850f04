"""Poles between samples, jumps at branch cuts: found; steep but smooth functions: left alone."""

import numpy as np
import pytest

from plisse.geometry.breaks import broken_place
from plisse.geometry.chart_surface import ChartSurface
from plisse.geometry.holomorphic import holomorphic
from plisse.geometry.weierstrass import MinimalSurface


def place(text):
    function = holomorphic(text, "f")

    def at(z):
        value, derivative = function(z)
        return value, derivative, 1j * derivative

    return broken_place(at, -1 - 1j, 1 + 1j)


@pytest.mark.parametrize("text", ["0", "2", "z", "z**5", "1e-9*z**2", "exp(50*z)", "sin(20*z)", "1/(z - 1.05)",
                                  "log(z + 3)"])
def test_smooth_functions_have_no_broken_place(text):
    assert place(text) is None


@pytest.mark.parametrize(("text", "where"), [("1/(z - 0.0137)", 0.0137), ("1/(z - 0.313 - 0.217*i)", 0.313 + 0.217j),
                                             ("1/(z - 0.3)**4", 0.3)])
def test_poles_between_samples_are_found_in_their_place(text, where):
    assert abs(place(text) - where) < 1e-4


def test_a_branch_cut_is_found_along_it():
    found = place("log(z + 0.0011)")
    assert found.real < 0
    assert abs(found.imag) < 1e-4


def test_projections_on_a_minimal_surface_go_along_its_normals():
    chart = MinimalSurface("z**2", "1", (-0.8, 0.8), (-0.8, 0.8))
    places = np.array([0.1 + 0.2j, -0.5 + 0.3j, 0.4 - 0.6j])
    normals = chart.at(places).normals
    found = ChartSurface(chart).project(chart.positions(places) + 0.05 * normals)
    np.testing.assert_allclose(found.positions, chart.positions(places), atol=1e-12)
    assert found.known.all()
    assert np.abs(np.trace(found.bending, axis1=1, axis2=2)).max() < 1e-12  # minimal

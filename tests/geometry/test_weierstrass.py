"""Minimal surfaces from Weierstrass data are what theory says they are."""

import numpy as np
import pytest

from plisse.errors import InvalidDesign
from plisse.geometry.vectors import dot, norm
from plisse.geometry.weierstrass import MinimalSurface

PLACES = np.array([0.3 + 0.2j, -0.4 + 0.7j, 0.05 - 0.6j, 0.9])
SURFACES = {"enneper": MinimalSurface("z", "1"), "monkey": MinimalSurface("z**2", "1"),
            "helicoid": MinimalSurface("exp(z)", "i*exp(-z)"), "bent": MinimalSurface("sin(z) + z**3/2", "exp(i*z)")}


@pytest.mark.parametrize("surface", SURFACES.values(), ids=SURFACES)
def test_partial_derivatives_are_those_of_the_positions(surface):
    found, step = surface.at(PLACES), 1e-4
    for partial, shift in zip(found.partials, (step, 1j * step), strict=True):
        difference = (surface.positions(PLACES + shift) - surface.positions(PLACES - shift)) / (2 * step)
        np.testing.assert_allclose(partial, difference, atol=1e-7)  # second-order differences


@pytest.mark.parametrize("surface", SURFACES.values(), ids=SURFACES)
def test_charts_are_conformal_and_mean_curvature_vanishes(surface):
    found = surface.at(PLACES)
    e, f, g = found.metric
    np.testing.assert_allclose(e, g, rtol=1e-12)
    np.testing.assert_allclose(f / e, 0, atol=1e-12)
    one, _, two = found.second
    np.testing.assert_allclose(one + two, 0, atol=1e-12 * np.abs(one).max())
    assert (found.curvature <= 0).all()


@pytest.mark.parametrize("surface", SURFACES.values(), ids=SURFACES)
def test_second_derivatives_along_normals_are_the_second_form(surface):
    found, step = surface.at(PLACES), 1e-3
    for number, shift in ((0, step), (2, 1j * step)):
        around = surface.positions(PLACES + shift) - 2 * surface.positions(PLACES) + surface.positions(PLACES - shift)
        np.testing.assert_allclose(found.second[number], dot(around / step**2, found.normals), atol=1e-5)
    np.testing.assert_allclose(norm(found.normals), 1, rtol=1e-14)


def test_positions_of_ennepers_surface_are_those_of_its_formula():
    u, v = PLACES.real, PLACES.imag
    wanted = 0.5 * np.stack([u - u**3 / 3 + u * v**2, -v + v**3 / 3 - v * u**2, u**2 - v**2], axis=1)
    np.testing.assert_allclose(MinimalSurface("z", "1").positions(PLACES), wanted, atol=1e-14)


def test_the_helicoid_is_ruled_by_straight_horizontal_lines():
    along = np.linspace(-1, 1, 9) + 0.4j
    points = SURFACES["helicoid"].positions(along)
    np.testing.assert_allclose(points[:, 2], points[0, 2], atol=1e-13)
    np.testing.assert_allclose(np.cross(points[1:-1] - points[0], points[-1] - points[0]), 0, atol=1e-13)


@pytest.mark.parametrize(("g", "f", "sentence"), [
    ("1/z", "1", "surface.weierstrass.g has a pole, a jump or no value near z = 0"),
    ("z", "log(z)", "surface.weierstrass.f has a pole, a jump"),
    ("abs(z)", "1", "contains 'abs.z.'; allowed are numbers, z, i, pi"),
    ("x", "1", "contains 'x'"),
    ("z^2", "1", r"powers are written \*\*"),
    ("", "1", "is empty"),
])
def test_data_that_cannot_be_used_are_refused_in_a_sentence(g, f, sentence):
    with pytest.raises(InvalidDesign, match=sentence):
        MinimalSurface(g, f)

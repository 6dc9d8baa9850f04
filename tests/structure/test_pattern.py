"""Patterns at other numbers of samples."""

import numpy as np
import pytest
from scipy.interpolate import make_interp_spline

from plisse.geometry.vectors import norm
from plisse.structure.pattern import Pattern, interpolate_along


@pytest.mark.parametrize("degree", [3, 5])
@pytest.mark.parametrize("count", [8, 9, 60])
def test_periodic_splines_are_those_of_scipy(count, degree):
    fields = np.random.default_rng(count).normal(size=(2, count, 3))
    around = np.concatenate([fields, fields[:, :1]], axis=1).swapaxes(0, 1)
    expected = make_interp_spline(np.linspace(0, 1, count + 1), around, k=degree, bc_type="periodic")
    at = np.linspace(-0.2, 1.4, 77)
    np.testing.assert_allclose(interpolate_along(fields, True, degree)(at), expected(at), atol=1e-12)


def test_a_resampled_circle_is_a_circle_and_asked_for_twice_the_same_pattern():
    angle = np.linspace(0, 2 * np.pi, 60, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    upright = np.broadcast_to([0.0, 0.0, 1.0], (2, 60, 3))
    pattern = Pattern(np.stack([circle, 2 * circle]), upright, np.zeros(2), np.full((1, 60), 1.0), closed=True)
    fine = pattern.resampled(137)
    np.testing.assert_allclose(norm(fine.curves), np.outer([1, 2], np.ones(137)), atol=1e-9)
    np.testing.assert_allclose(fine.widths, 1.0, atol=1e-12)
    assert pattern.resampled(137) is fine
    assert pattern.resampled(60) is pattern

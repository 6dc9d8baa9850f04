"""What is foretold from a pattern agrees with what is found."""

import numpy as np
import pytest

from plisse.geometry.curves import seed_curve
from plisse.layout.evolve import evolve
from plisse.recipe import Helix
from plisse.solve.forecast import forecast


def pattern(pitch, width=4.0, creases=6, theta=0.0):
    seed = seed_curve(Helix(radius=100, pitch=pitch, turns=0.4), 60)
    return evolve(seed, np.full(creases, theta), np.full((creases - 1, 60), width))


def test_upright_folds_open_by_the_arc_tangent_of_width_over_twice_the_amplitude():
    halves = forecast(pattern(pitch=1e-6), 3.0).half_openings
    assert np.allclose(halves, np.arctan(4 / 6), atol=1e-3)  # discrete tangents


def test_rulings_of_a_circle_are_orthogonal_and_of_a_helix_follow_the_formula():
    assert np.allclose(forecast(pattern(pitch=1e-6), 3.0).ruling_angles, np.pi / 2, atol=1e-3)
    rise = 300 / (2 * np.pi)
    found = forecast(pattern(pitch=300, width=0.5, creases=3), 0.4)
    opening = np.median(found.half_openings)
    expected = np.arctan2(100 * np.cos(opening), rise)  # cot = τ / (κ cos u), τ : κ = rise : radius
    assert np.degrees(abs(np.median(found.ruling_angles) - expected)) < 2  # creases leave the helix by 0.4


def test_flat_folds_are_warned_of_with_a_remedy():
    warnings = forecast(pattern(pitch=1e-6), 0.1).warnings()
    assert any("almost flat" in text and "raise pattern.amplitude" in text for text in warnings)


def test_nearly_closed_pleats_are_warned_of_with_a_remedy():
    warnings = forecast(pattern(pitch=1e-6, theta=np.radians(85)), 4.0).warnings()
    assert any("almost closed" in text and "lower" in text for text in warnings)


def test_good_patterns_earn_no_warning():
    assert forecast(pattern(pitch=40), 3.0).warnings() == []
    assert forecast(pattern(pitch=40), 3.0).is_hopeful


@pytest.mark.parametrize("pitch", [900.0, 2000.0])
def test_strong_torsion_is_warned_of_with_the_place(pitch):
    found = forecast(pattern(pitch=pitch, width=1.0), 0.15)
    assert any("rulings fall to" in text and "crease" in text and "%" in text for text in found.warnings())

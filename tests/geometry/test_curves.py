"""Seed curves against their formulas."""

import numpy as np
import pytest

from plisse.errors import InvalidDesign
from plisse.geometry.curves import seed_curve
from plisse.geometry.frames import curvature, regularised_frame, torsion
from plisse.geometry.polyline import arc_length, distance_to_polyline, sample_evenly
from plisse.geometry.smooth import smoothed_polyline
from plisse.geometry.vectors import norm
from plisse.recipe import Arc, Ellipse, Helix, Points, Spline, TorusKnot


def order_of_convergence(error, counts=(40, 80, 160)):
    values = np.log([error(count) for count in counts])
    return -np.polyfit(np.log(counts), values, 1)[0]


@pytest.mark.parametrize("curve", [
    Arc(radius=3, angle=200), Helix(radius=2, pitch=5, turns=1.3), Ellipse(a=3, b=2), TorusKnot(p=2, q=3, R=3, r=1),
    Spline(points=[[0, 0, 0], [4, 1, 0], [8, 0, 2], [11, -3, 3]]),
])
def test_every_seed_is_sampled_at_equal_arc_lengths(curve):
    points = seed_curve(curve, 400)
    steps = np.diff(arc_length(points, curve.closed))
    assert len(points) == 400
    assert np.ptp(steps) < 1e-3 * steps.mean()  # chords of curved pieces differ in second order


def test_a_closed_ellipse_has_the_circumference_of_its_formula():
    from scipy.special import ellipe

    length = arc_length(seed_curve(Ellipse(a=3, b=2), 2000), closed=True)[-1]
    assert length == pytest.approx(4 * 3 * ellipe(1 - 4 / 9), rel=1e-5)  # inscribed polygon: second order


def test_curvature_and_torsion_of_a_helix_converge_with_second_order():
    radius, pitch = 2.0, 3.0
    rise = pitch / (2 * np.pi)
    square = radius**2 + rise**2

    def curvature_error(count):
        return np.abs(curvature(seed_curve(Helix(radius=radius, pitch=pitch, turns=1.2), count)) - radius / square).max()

    def torsion_error(count):
        return np.abs(torsion(seed_curve(Helix(radius=radius, pitch=pitch, turns=1.2), count)) - rise / square).max()

    assert order_of_convergence(curvature_error) == pytest.approx(2, abs=0.15)
    assert order_of_convergence(torsion_error) == pytest.approx(2, abs=0.15)


def test_torsion_changes_sign_under_reflection_and_curvature_does_not():
    points = seed_curve(Helix(radius=2, pitch=3), 80)
    mirrored = points * [1, 1, -1]
    assert np.allclose(torsion(mirrored), -torsion(points), atol=1e-12)
    assert np.allclose(curvature(mirrored), curvature(points), atol=1e-12)


def test_regularised_binormals_of_a_plane_curve_stand_upright_at_any_resolution():
    for count in (30, 300):
        frame = regularised_frame(seed_curve(Ellipse(a=3, b=2), count), True, 1.0)
        assert np.allclose(np.abs(frame.binormal[:, 2]), 1, atol=1e-12)


def test_regularised_binormals_pass_through_a_weak_inflection_without_flipping():
    x = np.linspace(-1, 1, 101)
    frame = regularised_frame(np.stack([x, x**2 + 0.45 * x**3 - 0.1 * x**5, 0.2 * x**2], axis=1), False, 0.3)
    assert (np.sum(frame.binormal[1:] * frame.binormal[:-1], axis=1) > 0.95).all()


def test_splines_through_samples_of_a_helix_converge_with_high_order():
    truth = seed_curve(Helix(radius=2, pitch=3, turns=0.8), 4000)

    def error(count):
        angle = np.linspace(0, 1.6 * np.pi, count)
        knots = np.stack([2 * np.cos(angle), 2 * np.sin(angle), 3 * angle / (2 * np.pi)], axis=1)
        return distance_to_polyline(sample_evenly(knots, 50), truth).max()

    assert order_of_convergence(error, (6, 9, 13)) > 4


def test_smoothing_keeps_long_waves_and_removes_short_ones():
    angle = np.linspace(0, 2 * np.pi, 300, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    noisy = circle * (1 + 0.01 * np.cos(60 * angle))[:, None]
    smooth = smoothed_polyline(noisy, 0.08, closed=True)
    assert np.abs(norm(smooth) - 1).max() < 1.2e-3  # ten times below the noise
    assert smoothed_polyline(noisy, 0.0) is noisy


def test_measured_points_with_noise_give_the_curvature_of_their_circle():
    rng = np.random.default_rng(1)
    angle = np.linspace(0, 2, 120)
    points = np.stack([10 * np.cos(angle), 10 * np.sin(angle), 0 * angle], axis=1) + rng.normal(size=(120, 3)) * 2e-3
    inner = curvature(seed_curve(Points(points=points.tolist(), smooth=1.5), 60))[10:-10]
    assert np.abs(inner - 0.1).max() < 0.02


def test_distances_extend_open_ends_by_their_tangents_but_not_closed_ones():
    line = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [2, 3, 0], [0, 3, 0]])
    assert distance_to_polyline(np.array([[-5.0, 1, 0]]), line[:3])[0] == pytest.approx(1)
    assert distance_to_polyline(np.array([[-1.0, 1.5, 0]]), line, closed=True)[0] == pytest.approx(1)


def test_a_straight_seed_is_refused_with_a_remedy():
    with pytest.raises(InvalidDesign, match=r"straight.*bends"):
        seed_curve(Spline(points=[[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0]]), 60)

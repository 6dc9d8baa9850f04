"""Evolution of pseudo-geodesics: closed forms, orders of convergence, independence of the sampling."""

import numpy as np
import pytest

from plisse.errors import Infeasible
from plisse.geometry.polyline import distance_to_polyline
from plisse.geometry.vectors import angle_between, norm, unit
from plisse.layout.evolve import evolve
from plisse.layout.paper_evolution import evolve_literally, optimised_frame

WAYS = pytest.mark.parametrize("way", [evolve, evolve_literally])


def circle(samples, closed=True, turn=2.0):
    angle = np.linspace(0, 2 * np.pi if closed else turn, samples, endpoint=not closed)
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)


def helix(radius, samples=81, pitch=0.5):
    angle = np.linspace(-1.5, 1.5, samples)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), pitch * angle], axis=1)


def loop(samples):
    """A closed curve that is neither flat nor round."""
    angle = np.linspace(0, 2 * np.pi, samples, endpoint=False)
    return np.stack([np.cos(angle), 1.1 * np.sin(angle), 0.05 * np.sin(2 * angle)], axis=1)


def evolved(way, seed, strips, total, theta, *, closed=True, **options):
    """Pattern of strips of equal width at one inclination."""
    widths = np.full((strips, len(seed)), total / strips)
    return way(seed, np.full(strips + 1, theta), widths, closed=closed, **options)


@WAYS
@pytest.mark.parametrize("degrees", [0, 40, 80])
def test_circle_becomes_a_cone(way, degrees):
    theta = np.radians(degrees)
    pattern = evolved(way, circle(80), 9, 0.3, theta)
    travelled = 0.3 / 9 * np.arange(10)[:, None, None]
    up = np.array([0.0, 0.0, 1.0])
    expected = circle(80) * (1 - travelled * np.cos(theta)) + up * travelled * np.sin(theta)
    np.testing.assert_allclose(pattern.curves, expected, atol=1e-13)
    np.testing.assert_allclose(pattern.binormals, np.broadcast_to(up, expected.shape), atol=1e-13)


@WAYS
def test_arc_becomes_part_of_a_cone_up_to_its_end_tangents(way):
    pattern = evolved(way, circle(80, closed=False), 9, 0.3, 0.7, closed=False)
    radius = norm(pattern.curves[-1, :, :2])
    np.testing.assert_allclose(radius, 1 - 0.3 * np.cos(0.7), atol=1e-5)  # end tangents are extrapolated
    np.testing.assert_allclose(radius[8:-8], 1 - 0.3 * np.cos(0.7), atol=1e-12)


def test_helix_becomes_a_helicoid():
    errors = []
    for smoothing in (0.1, 0.05, 0.025):
        last = evolved(evolve, helix(1.0), 5, 0.15, 0.0, closed=False, smoothing=smoothing).curves[-1]
        errors.append(np.abs(last - helix(0.85))[15:-15].max())
    # smoothed binormals lag behind turning ones: the error falls with the square of the length at least
    assert errors[2] < 0.45 * errors[1] < 0.2 * errors[0]
    assert errors[2] < 3e-4


def test_literal_helix_becomes_a_helicoid():
    last = evolved(evolve_literally, helix(1.0), 5, 0.15, 0.0, closed=False, dose=1e-6).curves[-1]
    # all steps point to the axis; what remains is the resolution
    np.testing.assert_allclose(last[10:-10], helix(0.85)[10:-10], atol=2e-6)


def test_accurate_evolution_has_order_four():
    reference = evolved(evolve, loop(64), 4, 0.4, 0.5, steps=64).curves[-1]
    errors = [np.abs(evolved(evolve, loop(64), 4, 0.4, 0.5, steps=steps).curves[-1] - reference).max()
              for steps in (1, 2, 4, 8)]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 4, atol=0.2)


def test_literal_evolution_approaches_the_accurate_one_with_order_one():
    reference = evolved(evolve, loop(48), 4, 0.15, 0.5, smoothing=0.01, steps=32).curves[-1]
    literal = [evolved(evolve_literally, loop(48), strips, 0.15, 0.5, dose=1e-4).curves[-1]
               for strips in (4, 8, 16)]
    errors = [np.abs(curve - reference).max() for curve in literal]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    np.testing.assert_allclose(orders, 1, atol=0.15)
    limit = 2 * literal[2] - literal[1]
    assert np.abs(limit - reference).max() < 0.02 * errors[2]


@WAYS
def test_curves_keep_their_distance_and_inclination(way):
    theta = 0.6
    pattern = evolved(way, loop(120), 6, 0.12, theta)
    steps = np.diff(pattern.curves, axis=0)
    np.testing.assert_allclose(norm(steps), 0.02, rtol=1e-3)  # curved paths are longer than chords
    tangent = np.roll(pattern.curves, -1, axis=1) - np.roll(pattern.curves, 1, axis=1)
    normal = unit(np.cross(tangent[:-1], steps))
    # half a strip of turning and the smoothing of binormals separate both planes
    np.testing.assert_allclose(angle_between(normal, pattern.binormals[:-1]), theta, atol=0.05)


def test_pattern_does_not_depend_on_the_resolution():
    # smoothing acts over a length, so that coarse and fine patterns are samples of the same curves
    coarse, fine = (evolved(evolve, loop(count), 5, 0.2, 0.5).curves[-1] for count in (60, 240))
    assert distance_to_polyline(coarse, fine, closed=True).max() < 1e-3


def test_pattern_does_not_depend_on_the_direction_of_the_seed():
    forward = evolved(evolve, helix(1.0), 4, 0.1, 0.0, closed=False).curves
    backward = evolved(evolve, helix(1.0)[::-1], 4, 0.1, 0.0, closed=False).curves
    np.testing.assert_allclose(forward, backward[:, ::-1], atol=1e-10)


def test_pattern_scales_with_its_seed():
    small = evolved(evolve, loop(60), 4, 0.1, 0.5).curves
    large = evolved(evolve, 1000 * loop(60), 4, 100, 0.5).curves
    np.testing.assert_allclose(large, 1000 * small, atol=1e-8)


def test_inclination_and_width_may_vary():
    seed = loop(60)
    theta = np.radians([10, 20, 30, 20])
    profile = 1.5 + np.sin(np.linspace(0, 2 * np.pi, 60, endpoint=False))
    widths = 0.02 * profile * np.array([[1.0], [0.5], [2.0]])
    pattern = evolve(seed, theta, widths, closed=True)
    assert pattern.creases == 4
    # chords of curved paths
    np.testing.assert_allclose(norm(np.diff(pattern.curves, axis=0)), widths, rtol=2e-3)


def test_smoothing_of_binormals_bridges_a_weak_inflection():
    place = np.linspace(-1, 1, 61)
    points = np.stack([place, 0.3 * place**3 + 0.02 * place**2, 0.1 * place**2], axis=1)
    frame = optimised_frame(points, closed=False, dose=1.0)
    assert angle_between(frame.binormal[1:], frame.binormal[:-1]).max() < 0.2
    np.testing.assert_allclose(norm(frame.binormal), 1, atol=1e-12)


@WAYS
def test_collapse_onto_the_focal_set_is_diagnosed(way):
    with pytest.raises(Infeasible, match=r"crease 5 collapses near .* lower pattern\.width"):
        evolved(way, circle(60, closed=False), 6, 1.5, 0.0, closed=False)


def test_straight_seeds_have_no_side_to_evolve_to():
    straight = np.stack([np.linspace(0, 1, 20), np.zeros(20), np.zeros(20)], axis=1)
    with pytest.raises(Infeasible, match="straight"):
        evolved(evolve_literally, straight, 3, 0.1, 0.0, closed=False)

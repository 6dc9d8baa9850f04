import numpy as np
import pytest

from plisse.geometry.bezier import bezier_through, sampled


def circle(count):
    angle = np.linspace(0, 2 * np.pi, count, endpoint=False)
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def distance_from_circle(count):
    return np.abs(np.linalg.norm(sampled(bezier_through(circle(count), closed=True), 20), axis=1) - 1).max()


def test_every_third_control_point_is_a_given_point():
    rng = np.random.default_rng(1)
    for closed in (False, True):
        points = rng.normal(size=(9, 3))
        controls = bezier_through(points, closed)
        assert len(controls) == 3 * (9 - 1 + closed) + 1
        assert np.array_equal(controls[::3][:9], points)
        if closed:
            assert np.array_equal(controls[-1], points[0])


def test_a_cubic_is_its_own_spline():
    t = np.linspace(-1, 2, 400)
    points = np.stack([t, t**3 - t], axis=1)
    curve = sampled(bezier_through(points), 7)
    assert np.abs(curve[:, 1] - (curve[:, 0] ** 3 - curve[:, 0])).max() < 1e-6  # chord lengths are no cubic parameter


def test_two_points_give_a_straight_piece():
    controls = bezier_through(np.array([[0.0, 0.0], [3.0, 6.0]]))
    assert np.allclose(controls, [[0, 0], [1, 2], [2, 4], [3, 6]], atol=1e-12)


def test_splines_approach_a_circle_with_order_four():
    errors = np.array([distance_from_circle(count) for count in (12, 24, 48)])
    orders = np.log2(errors[:-1] / errors[1:])
    assert (orders > 3.7).all()


@pytest.mark.parametrize("closed", [False, True])
def test_tangents_and_curvature_are_continuous_at_joints(closed):
    points = circle(12) * [3.0, 1.0]
    controls = bezier_through(points, closed)
    chord = np.linalg.norm(np.diff(np.concatenate([points, points[:1]]) if closed else points, axis=0), axis=1)[:, None]
    a, b, c, d = (controls[k::3][:len(chord)] for k in range(4))
    leaving, arriving = 3 * (b - a) / chord, 3 * (d - c) / chord
    bend_leaving, bend_arriving = 6 * (c - 2 * b + a) / chord**2, 6 * (b - 2 * c + d) / chord**2
    assert np.allclose(arriving[:-1], leaving[1:], atol=1e-12)
    assert np.allclose(bend_arriving[:-1], bend_leaving[1:], atol=1e-11)
    if closed:
        assert np.allclose(arriving[-1], leaving[0], atol=1e-12)

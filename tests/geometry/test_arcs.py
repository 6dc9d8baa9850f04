"""Arcs that follow polylines."""

import numpy as np
import pytest

from plisse.geometry.arcs import arcs_along, circle_through


def on_circle(angles, radius=40.0, centre=(3.0, -2.0)):
    return np.array(centre) + radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)


def test_the_circle_through_three_points_is_theirs_and_turns_left_for_positive_radii():
    angles = np.array([[0.1, 0.9, 2.0], [2.0, 0.9, 0.1]])
    centre, radius = circle_through(*(on_circle(angles[:, k]) for k in range(3)))
    assert np.allclose(centre, [3.0, -2.0], atol=1e-12) and np.allclose(radius, [40.0, -40.0], rtol=1e-13)


def test_points_in_line_have_no_circle():
    _, radius = circle_through(*np.array([[0.0, 0.0], [1.0, 1.0], [3.0, 3.0]]))
    assert np.isinf(radius)


def test_one_arc_follows_a_circle_and_lines_stay_straight():
    arc, = arcs_along(on_circle(np.linspace(0, 2.5, 200)), 0.01)
    assert (arc.first, arc.last) == (0, 199) and arc.radius == pytest.approx(40.0)
    line, = arcs_along(np.stack([np.linspace(0, 9, 30), np.zeros(30)], axis=1), 0.01)
    assert np.isinf(line.radius) and line.deviation < 1e-12


@pytest.mark.parametrize("tolerance", [0.5, 0.1, 0.02])
def test_arcs_are_connected_within_the_tolerance_and_the_fewer_the_larger_it_is(tolerance):
    t = np.linspace(0, 12, 2000)
    points = np.stack([t * 10, 15 * np.sin(t)], axis=1)
    arcs = arcs_along(points, tolerance)
    assert [arc.first for arc in arcs[1:]] == [arc.last for arc in arcs[:-1]] and arcs[-1].last == 1999
    for arc in arcs:
        part = points[arc.first:arc.last + 1]
        if np.isfinite(arc.radius):
            assert np.abs(np.hypot(*(part - arc.centre).T) - abs(arc.radius)).max() <= tolerance
    assert len(arcs) < len(arcs_along(points, tolerance / 5))

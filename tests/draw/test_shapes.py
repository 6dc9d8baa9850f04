import numpy as np
import pytest

from plisse.draw.shapes import Arc, Line, Spline
from plisse.geometry.bezier import bezier_through


def test_a_closed_line_returns_to_its_first_point():
    square = Line(np.array([[0.0, 0], [2, 0], [2, 2], [0, 2]]), closed=True)
    assert square.length == 8
    assert np.array_equal(square.path[0], square.path[-1])


@pytest.mark.parametrize("end", [0.4, 2.0, 2 * np.pi])
def test_the_controls_of_an_arc_stay_on_it(end):
    arc = Arc((5.0, -2.0), 30.0, 0.1, 0.1 + end)
    assert np.abs(np.hypot(*(arc.path - [5, -2]).T) - 30).max() < 3e-8  # cubic pieces of 10 degrees: 1e-9 radii
    assert arc.length == pytest.approx(30 * end)
    assert Spline(arc.controls).length == pytest.approx(arc.length, rel=1e-5)
    assert arc.is_circle == (end == 2 * np.pi)


def test_a_spline_is_as_long_as_the_curve_it_follows():
    angle = np.linspace(0, 2 * np.pi, 200, endpoint=False)
    ring = Spline(bezier_through(10 * np.stack([np.cos(angle), np.sin(angle)], axis=1), closed=True), closed=True)
    assert ring.length == pytest.approx(20 * np.pi, rel=1e-6)

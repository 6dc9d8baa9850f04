"""The view that shows most: rings are seen as rings in space, and what is above is above."""

import numpy as np
import pytest

import plisse
from plisse.draw.camera import best_view
from plisse.structure.pleated import PleatedStructure

RING = {"curve": {"kind": "helix", "radius": 100, "pitch": 110, "turns": 1.1},
        "pattern": {"theta": 30, "creases": 8, "width": 6, "amplitude": 4.5, "samples": 61}}


@pytest.fixture(scope="module")
def helix():
    return plisse.design(RING).structure


def test_a_helix_is_not_seen_along_its_axis_nor_edge_on(helix):
    camera = best_view(helix)
    assert 25 < camera.elevation_degrees < 66
    assert camera.upright.tolist() == [0, 0, 1]


def test_every_main_extent_is_seen(helix):
    """None of them is shortened to less than half."""
    _, axes = np.linalg.eigh(np.cov(helix.vertices.T))
    assert np.hypot(*best_view(helix).project(axes.T)[:, :2].T).min() > 0.5


def test_a_turn_about_the_vertical_and_a_change_of_size_turn_the_view_alike(helix):
    """The same picture: distances in its plane only grow."""
    turn = np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1.0]])
    other = PleatedStructure(helix.topology, 3 * helix.vertices @ turn.T)
    one, two = best_view(helix).project(helix.vertices), best_view(other).project(other.vertices)
    assert np.ptp(two, axis=0) == pytest.approx(3 * np.ptp(one, axis=0), rel=1e-6)

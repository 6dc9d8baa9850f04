"""What is shown fills the window, and the sheet lies beside the structure."""

from types import SimpleNamespace

import numpy as np
import pytest

from plisse.draw.camera import Camera
from plisse.studio.framing import BAR, FIELD_OF_VIEW, FILLED, Manner, Window, beside

RANDOM = np.random.default_rng(3)
CLOUD = RANDOM.normal(size=(300, 3)) * [60, 20, 8] + [5, -70, 30]
VIEW = Camera.looking_from(np.array([1.0, -2.0, 1.5]), np.array([0.0, 0, 1]))


def projected(window, stand, points, axes):
    """Places (N, 2) in the window, −1 to 1, by a pinhole."""
    away = (points - stand.position) @ axes.T
    return away[:, :2] / -away[:, 2:] / np.tan(FIELD_OF_VIEW / 2) / [window.aspect, 1]


def camera_at(stand, view, window):
    return SimpleNamespace(position=stand.position, look_at=stand.middle, up_direction=view.upright, aspect=window.aspect)


@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.4])
def test_all_points_are_inside_and_some_touch_the_margin_on_both_sides(aspect):
    window = Window(aspect)
    places = projected(window, window.stand(CLOUD, VIEW.axes), CLOUD, VIEW.axes)
    low, high = places.min(axis=0), places.max(axis=0)
    assert high.max() <= FILLED + 1e-9 and low.min() >= -FILLED - 1e-9
    assert np.ptp(places, axis=0).max() == pytest.approx(2 * FILLED)


def test_nothing_lies_under_the_bar_of_a_phone():
    window = Window.of(SimpleNamespace(aspect=0.5, image_width=390, image_height=780))
    tall = CLOUD @ VIEW.axes[[1, 0, 2]]
    places = projected(window, window.stand(tall, VIEW.axes), tall, VIEW.axes)
    assert places[:, 1].min() > -1 + 2 * BAR / 780
    assert Window.of(SimpleNamespace(aspect=1.0, image_width=900, image_height=900)).covered == 0


def test_what_is_looked_at_is_straight_ahead_in_the_middle_of_the_depth():
    stand = Window(1.3).stand(CLOUD, VIEW.axes)
    assert (stand.position - stand.middle) / stand.distance == pytest.approx(VIEW.axes[2])
    depth = CLOUD @ VIEW.axes[2]
    assert stand.middle @ VIEW.axes[2] == pytest.approx((depth.min() + depth.max()) / 2)


def test_reach_is_how_far_points_are_from_the_middle_of_the_window():
    window = Window(1.3)
    stand = window.stand(CLOUD, VIEW.axes)
    camera = camera_at(stand, VIEW, window)
    assert window.reach(CLOUD, camera) == pytest.approx(np.abs(projected(window, stand, CLOUD, VIEW.axes)).max())
    assert window.reach(2 * stand.position[None] - stand.middle, camera) == np.inf


@pytest.mark.parametrize("below", [False, True])
@pytest.mark.parametrize("turned", [False, True])
def test_the_sheet_lies_beside_the_structure_parallel_to_the_picture_and_not_mirrored(below, turned):
    flat = RANDOM.uniform(size=(50, 2)) * [300, 90] + [7, -4]
    place = beside(CLOUD, flat, VIEW.axes, Manner(below, turned))
    sheet, structure = place.placed(flat) @ VIEW.axes.T, CLOUD @ VIEW.axes.T
    assert np.ptp(sheet[:, 2]) < 1e-9
    if below:
        assert sheet[:, 1].max() < structure[:, 1].min()
    else:
        assert sheet[:, 0].min() > structure[:, 0].max()
    assert np.linalg.det(place.axes) == pytest.approx(1)
    wide, tall = np.ptp(sheet, axis=0)[:2]
    assert (wide < tall) == turned
    assert 1 / place.scale == round(1 / place.scale)
    assert 1 / beside(CLOUD, flat, VIEW.axes, Manner(below, turned, reduced=True)).scale == 1 / place.scale + 1

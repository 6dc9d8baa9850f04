"""What is shown fills the window, and the sheet lies beside the structure."""

from contextlib import nullcontext
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

import plisse
from plisse.draw.camera import Camera, best_view
from plisse.io.designs import read_design
from plisse.shipped import shipped_design
from plisse.studio.framing import BAR, FIELD_OF_VIEW, FILLED, TINY, Manner, Window, beside
from plisse.studio.requests import Found
from plisse.studio.scene import Scene
from plisse.studio.view import flat_view, folded_view, posed_view

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


def test_the_share_is_the_larger_extent_in_the_window_wherever_it_is():
    window = Window(1.3)
    camera = camera_at(window.stand(CLOUD, VIEW.axes), VIEW, window)
    assert window.share(CLOUD, camera) == pytest.approx(FILLED)
    small = 0.1 * CLOUD + 0.3 * np.ptp(CLOUD, axis=0).max() * VIEW.axes[0]
    assert window.share(small, camera) < 0.15
    assert window.reach(small, camera) > 0.3


class Cards:
    """Stands for a scene of viser, whose nodes keep what is set, and for its client."""

    def __init__(self, aspect=1.5):
        self.camera = SimpleNamespace(position=np.array([0.0, -500, 300]), look_at=np.zeros(3), aspect=aspect,
                                      up_direction=np.array([0.0, 0, 1]), image_width=1200, image_height=800,
                                      on_update=lambda _: None)
        self.scene, self.atomic = self, nullcontext

    def add_mesh_simple(self, _name, points, triangles, **_):
        return SimpleNamespace(vertices=points, faces=triangles)

    def __getattr__(self, _name):
        return lambda *_, **__: SimpleNamespace(visible=True)


@pytest.fixture(scope="module")
def found():
    result = plisse.design(read_design(shipped_design("fig01d")))
    structure = result.structure
    folded = replace(folded_view(structure), sky=None)
    return structure, Found(result.report, False, folded=folded, sheet=flat_view(structure), camera=best_view(structure))


def test_the_best_view_of_nothing_is_where_one_is():
    cards = Cards()
    scene, place = Scene(cards, None), cards.camera.position
    scene.frame()
    scene.pale()
    assert cards.camera.position is place
    assert len(scene.points) == scene.height_of_paper == 0
    assert not scene.is_pale


def test_a_structure_that_folds_up_is_seen_again_from_near_although_its_sheet_was_always_large(found):
    structure, found = found
    cards = Cards()
    scene, motion = Scene(cards, None), structure.flex(100)
    scene.show(found)
    scene.frame()

    def share():
        return Window.of(cards.camera).share(scene.points, cards.camera)

    best = share()
    for percent, least in ((0, 0.8), (150, 0.5 * best), (0, 0.8), (100, 0.95 * best)):
        scene.pose(replace(posed_view(motion, percent), sky=None))
        assert share() > least
    cards.camera.position = 4 * cards.camera.position - 3 * cards.camera.look_at
    far = share()
    scene.follow()
    assert share() == far


@pytest.mark.parametrize("percent", [150, 190, 196])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 1.5])
def test_the_best_view_of_a_structure_that_is_folded_up_is_not_filled_by_its_sheet(found, percent, aspect):
    structure, found = found
    cards = Cards(aspect)
    scene, window = Scene(cards, None), Window(aspect)
    scene.show(found)
    scene.frame()
    assert window.reach(scene._everything, cards.camera) < 1  # as it was designed all is seen
    scene.pose(replace(posed_view(structure.flex(100), percent), sky=None))
    scene.frame()
    assert window.share(scene.points, cards.camera) > 0.6 * TINY  # not quite: from farther away what is deep is smaller
    assert window.reach(scene.points, cards.camera) < 1


def test_on_the_way_to_a_nearer_camera_what_it_sees_stays_in_the_window():
    window, small = Window(1.3), 0.2 * CLOUD + 40 * VIEW.axes[0]
    far, near = (window.stand(points, VIEW.axes) for points in (np.concatenate([CLOUD, small]), small))
    for part in (0.2, 0.5, 0.8):
        between = far.nearer(near, (1 - part) * far.distance + part * near.distance)
        assert window.reach(small, camera_at(between, VIEW, window)) <= FILLED + 1e-9
        assert between.distance == pytest.approx((1 - part) * far.distance + part * near.distance)
    assert far.nearer(near, 2 * far.distance) is far


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

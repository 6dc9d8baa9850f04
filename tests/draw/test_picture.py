"""Pictures: silhouettes, light, transparency, colours and turns, each against something computed another way."""

import numpy as np
import pytest
from PIL import Image
from shapely import Polygon, contains_xy, unary_union

from plisse.draw.camera import Camera
from plisse.draw.colour_maps import colour_maps
from plisse.draw.colours import opening, quality, rgb
from plisse.draw.light import TILE, Fineness, open_share
from plisse.draw.picture import Style, picture, turntable, write_picture, write_turntable
from plisse.draw.rays import Occluder, can_cast, fibonacci_sphere
from plisse.draw.render import render
from plisse.draw.views import VIEWS, view_of
from plisse.errors import InvalidDesign
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure

casting = pytest.mark.skipif(not can_cast(), reason="embreex is not installed: pip install 'plisse[render]'")
SMALL = Style(size=(240, 180), ambient=False)


def groove(opening_angle: float, length: float = 4000.0) -> PleatedStructure:
    """Two long walls that meet in a valley along the x axis, symmetric to the z axis."""
    half = opening_angle / 2
    wall = 100 * np.array([np.sin(half), np.cos(half)])
    x = np.array([-length, length]) / 2
    rows = [(-wall[0], wall[1]), (0.0, 0.0), (wall[0], wall[1])]
    return PleatedStructure(grid(3, 2), np.array([[a, *row] for row in rows for a in x]))


@pytest.mark.parametrize("name", ["iso", "front", "30,-20"])
def test_silhouettes_are_those_of_the_projected_faces(cones, name):
    camera, scale = view_of(cones, name), 2.0
    shown = render(cones, camera, scale)
    faces = shown.pixels(cones.vertices)[cones.topology.quads][..., :2]
    shape = unary_union([Polygon(face).buffer(0) for face in faces])
    coverage = shown.image[..., 3]
    assert coverage.sum() == pytest.approx(shape.area, rel=0.01)  # pixels have four samples
    height, width = coverage.shape
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    assert (coverage[contains_xy(shape.buffer(-0.75), x, y)] == 1).all()
    assert (coverage[~contains_xy(shape.buffer(0.75), x, y)] == 0).all()


def test_named_views_look_where_they_say(cones):
    for name in VIEWS:
        camera = view_of(cones, name)
        assert np.allclose(camera.axes @ camera.axes.T, np.eye(3), atol=1e-12)
        assert np.linalg.det(camera.axes) == pytest.approx(1)
        assert camera.axes[1] @ [0, 0, 1] >= -1e-12  # z is never upside down
    assert np.allclose(view_of(cones, "top").axes, np.eye(3), atol=1e-12)
    assert np.allclose(view_of(cones, "front").axes[2], [0, -1, 0], atol=1e-12)
    assert view_of(cones, "30,40").elevation_degrees == pytest.approx(40)
    for wrong in ("above", "30", "1,2,3", "0,91", "nan,0"):
        with pytest.raises(InvalidDesign, match="--view"):
            view_of(cones, wrong)


@casting
@pytest.mark.parametrize("degrees", [40, 90, 150])
def test_at_the_bottom_of_a_groove_as_much_sky_is_seen_as_the_closed_form_says(degrees):
    """A wall sees (1 − cos φ) / 2 of a cosine-weighted sky at the bottom of a groove with opening φ."""
    angle = np.radians(degrees)
    valley = groove(angle)
    corners = valley.vertices[valley.topology.quads]
    triangles = corners[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3, 3)
    normal = np.array([0, -np.cos(angle / 2), np.sin(angle / 2)])  # of the wall at positive y, into the groove
    wall = np.array([0, np.sin(angle / 2), np.cos(angle / 2)])
    points = np.tile((0.5 * wall + 1e-3 * normal).astype(np.float32), (TILE * TILE, 1))
    share = open_share(Occluder(triangles), points, fibonacci_sphere(TILE * TILE * 200), np.arange(TILE * TILE),
                       np.tile(normal.astype(np.float32), (TILE * TILE, 1)))
    assert share.mean() == pytest.approx((1 - np.cos(angle)) / 2, abs=0.01)  # 1,800 rays


@pytest.mark.parametrize("cast", [False, pytest.param(True, marks=casting)])
def test_valleys_are_darker_than_ridges(cast):
    image = render(groove(np.radians(60), 200), Camera(np.eye(3)), 1.0, fineness=Fineness(cast=cast)).image
    middle, width = image[:, 60:-60, :3].mean(axis=(1, 2)), image.shape[0] // 2
    assert middle[width - 3:width + 3].mean() < 0.8 * middle[[10, -10]].mean()


@casting
def test_a_sheet_alone_sees_the_whole_sky():
    sheet = groove(np.pi, 200)
    flat = render(sheet, Camera(np.eye(3)), 1.0, fineness=Fineness(cast=True)).image
    inside = flat[12:-12, 12:-12, :3]
    assert np.ptp(inside, axis=(0, 1)).max() < 1e-5


def test_a_transparent_picture_is_clear_around_the_structure_and_solid_on_it(cones):
    clear, full = (picture(cones, style=Style(SMALL.size, transparent=flag, ambient=False)) for flag in (True, False))
    assert clear.shape == (180, 240, 4)
    assert (clear[[0, 0, -1, -1], [0, -1, 0, -1], 3] == 0).all()
    assert (clear[..., 3] == 255).mean() > 0.1
    assert (full[..., 3] == 255).all()


def test_creases_are_drawn_in_two_colours_or_not_at_all(cones):
    def reds_and_blues(creases):
        pixels = picture(cones, camera=view_of(cones, "top"), style=Style((480, 360), creases, ambient=False)).astype(int)
        red, green, blue, _ = np.moveaxis(pixels, -1, 0)
        return ((red - blue > 70) & (red - green > 45)).sum(), (blue - red > 10).sum()

    assert min(reds_and_blues(True)) > 50
    assert max(reds_and_blues(False)) == 0


def test_the_worst_face_is_the_darkest_of_a_map(cones):
    vertices = cones.vertices.copy()
    moved = 3 * 25 + 12
    vertices[moved, 2] += 1.5
    bent = cones.with_vertices(vertices)
    found = colour_maps(bent)["planarity"]
    assert found.largest > 1e-3
    worst = int(np.argmax(np.nan_to_num(found.values)))
    assert bent.topology.corners.face[worst] in np.flatnonzero((bent.topology.quads == moved).any(axis=1))
    shown = render(bent, view_of(bent, "top"), 2.0, colour=found)
    face = bent.topology.quads[bent.topology.corners.face[worst]]
    middle = shown.pixels(vertices[face]).mean(axis=0).astype(int)
    far = shown.pixels(vertices[bent.topology.quads[0]]).mean(axis=0).astype(int)
    (r1, _, b1), (r0, _, b0) = shown.image[middle[1], middle[0], :3], shown.image[far[1], far[0], :3]
    assert b1 / r1 < 0.75 * b0 / r0


def test_maps_of_an_exact_structure_are_pale_and_its_openings_are_those_of_the_formula(cones):
    maps = colour_maps(cones)
    for name in ("planarity", "angle", "principal"):
        assert maps[name].scale.high == 1e-9
        assert maps[name].scale.shares(maps[name].values).max() < 0.7
    slope = 2 * np.degrees(np.arctan2(6.0, 8.0))  # between two cones of slope 8 : 6
    assert np.allclose(maps["opening"].values, slope, atol=1)  # 25 columns on half a turn
    assert "deviation" not in maps


def test_both_palettes_grow_lighter_or_darker_all_the_way_and_unknown_values_are_grey(cones):
    steps = np.linspace(0, 1, 50)
    luminance = [palette(steps) @ [0.2126, 0.7152, 0.0722] for palette in (quality, opening)]
    assert (np.diff(luminance[0]) < 0).all() and (np.diff(luminance[1]) > 0).all()
    grey = colour_maps(cones)["opening"].colours(np.array([np.nan]))
    assert np.allclose(grey, rgb("#cfc8bb"))


def test_equal_pictures_have_equal_bytes(cones, tmp_path):
    for name in ("a.png", "b.png"):
        write_picture(cones, tmp_path / name, style=Style((200, 150)))
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_a_turntable_has_its_frames_and_nothing_leaves_the_page(cones, tmp_path):
    write_turntable(cones, tmp_path / "turn.gif", frames=5, style=SMALL)
    with Image.open(tmp_path / "turn.gif") as image:
        assert (image.n_frames, image.size, image.info["loop"]) == (5, SMALL.size, 0)
    clear = Style(SMALL.size, transparent=True, ambient=False)
    for frame in turntable(cones, 30.0, 4, clear):
        assert frame[[0, -1], :, 3].max() == frame[:, [0, -1], 3].max() == 0
        assert frame[..., 3].max() == 255

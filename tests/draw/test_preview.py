import sys

import numpy as np
import pytest
from PIL import Image

from plisse.draw.camera import Camera, best_view
from plisse.draw.colours import quality, rgb
from plisse.draw.layout import arrange
from plisse.draw.preview import SIZE, write_preview
from plisse.draw.raster import rasterise
from plisse.draw.render import render
from plisse.draw.table import table
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure


def square(z: float, low: float = 1.0, high: float = 9.0) -> np.ndarray:
    a, b, c, d = [low, low, z], [high, low, z], [high, high, z], [low, high, z]
    return np.array([[a, b, c], [a, c, d]])


def test_the_picture_shows_paper_and_folds_and_two_writes_give_the_same_bytes(closed_cones, tmp_path):
    write_preview(closed_cones, tmp_path / "a.png", title="cones")
    write_preview(closed_cones, tmp_path / "b.png", title="cones")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    with Image.open(tmp_path / "a.png") as image:
        assert image.size == SIZE
        assert "Software" not in image.info
        pixels = np.asarray(image.convert("RGB")).astype(int)
    red, green, blue = np.moveaxis(pixels, -1, 0)
    assert ((red - green > 60) & (red - blue > 60)).sum() > 1000
    assert ((blue - red > 40) & (blue > green)).sum() > 1000
    assert pixels.std() > 5


def test_a_structure_without_development_is_drawn_alone(cones, tmp_path):
    write_preview(cones.with_vertices(cones.vertices), tmp_path / "a.png")
    assert (tmp_path / "a.png").stat().st_size > 10_000


def test_no_global_plotting_state_is_touched(cones, tmp_path):
    write_preview(cones, tmp_path / "a.png")
    assert "matplotlib.pyplot" not in sys.modules


def test_the_nearer_triangle_hides_the_other_whatever_their_order():
    for order in (slice(None), slice(None, None, -1)):
        buffer = rasterise(np.concatenate([square(0.0), square(5.0, 3, 7)])[order], 10, 10)
        near = buffer.depth == 5
        assert near.sum() == 16 and (buffer.depth == 0).sum() == 48
        assert np.isneginf(buffer.depth[0]).all() and (buffer.triangle[0] == -1).all()


def test_triangles_that_share_an_edge_leave_no_gap_and_no_overlap():
    rng = np.random.default_rng(0)
    x, y = np.meshgrid(np.arange(12.0) * 10, np.arange(12.0) * 10)
    points = np.stack([x, y, 0 * x], axis=-1).reshape(-1, 3)
    points[:, :2] += rng.uniform(-3, 3, (144, 2))
    quads = grid(12, 12).quads
    inner = points[np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])]
    covered = sum((rasterise(triangle[None], 120, 120).triangle >= 0).astype(int) for triangle in inner)
    assert covered.max() == 1
    assert (covered[5:105, 5:105] == 1).all()


def test_depth_is_exact_on_a_tilted_plane():
    points = square(0.0)
    points[..., 2] = 2 * points[..., 0] - points[..., 1] + 3
    depth = rasterise(points, 10, 10).depth
    row, column = np.nonzero(np.isfinite(depth))
    assert np.allclose(depth[row, column], 2 * (column + 0.5) - (row + 0.5) + 3, atol=1e-5)


def test_cameras_are_rotations_and_see_most_of_the_paper(cones):
    camera = best_view(cones)
    assert np.allclose(camera.axes @ camera.axes.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(camera.axes) == pytest.approx(1)
    image = render(cones, camera, 4.0).image
    assert (image[..., 3] > 0.5).mean() > 0.15


def test_lines_behind_paper_are_hidden():
    wall = PleatedStructure(grid(2, 2), np.array([[0, 0, 0], [40, 0, 0], [0, 40, 0], [40, 40, 0]], float))
    picture = render(wall, Camera(np.eye(3)), 4.0)
    across = np.array([[-20.0, 20, 0], [60, 20, 0]])
    hidden = picture.visible(across - np.array([0, 0, 10]))
    shown = picture.visible(across + np.array([0, 0, 10]))
    length = lambda parts: sum(np.hypot(*(part[-1] - part[0])) for part in parts)  # noqa: E731
    assert length(shown) == pytest.approx(80 * 4, rel=0.02)
    assert length(hidden) < 0.6 * length(shown)


def test_both_pictures_fit_the_page_at_one_scale_and_keep_apart():
    rng = np.random.default_rng(1)
    folded, flat = rng.uniform(0, 1, (500, 2)) * [3, 1], rng.uniform(0, 1, (500, 2)) * [5, 2]
    low, high = np.array([10.0, 20.0]), np.array([1010.0, 520.0])
    layout = arrange(folded, flat, low, high)
    for corner, size in ((layout.folded, np.ptp(folded, axis=0)),):
        assert (corner >= low - 1e-9).all() and (corner + size * layout.scale <= high + 1e-9).all()
    assert layout.flat[0] > layout.folded[0]
    alone = arrange(folded, None, low, high)
    assert alone.scale == pytest.approx(1000 / np.ptp(folded[:, 0]))


def test_the_quality_scale_runs_from_pale_to_dark():
    colours = quality(np.linspace(0, 1, 20))
    assert (np.diff(colours.sum(axis=1)) < 0).all()
    assert rgb("#ff8000").tolist() == [1.0, 128 / 255, 0.0]


def test_papers_throw_their_shadows_on_the_table():
    loop = np.array([[600.0, 100], [900, 100], [900, 400], [600, 400]])
    bare = table((1000, 500), np.zeros((1, 1)), np.zeros(2), [])
    laid = table((1000, 500), np.ones((200, 200)), np.array([100.0, 200.0]), [loop])
    darker = (bare - laid).sum(axis=-1)
    assert bare.shape == (100, 200, 3) and darker.min() >= 0
    assert darker[50, 150] > 0.05 and darker[55, 35] > 0.05 and darker[5, 5] < 1e-3

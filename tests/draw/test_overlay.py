"""The overlay picture: pleats in the colours of their deviation under a transparent reference."""

import numpy as np
import pytest
from matplotlib.image import imread

from plisse.draw import colours
from plisse.draw.overlay import write_overlay
from plisse.geometry.mesh import grid_mesh
from plisse.geometry.vectors import norm


def reference(lift=4.0, reach=1.0):
    """The plane of the cones' mid-surface, or one hovering elsewhere."""
    radius, turn = np.meshgrid(np.linspace(64, 64 + 36 * reach, 8), np.linspace(0, np.pi, 30), indexing="ij")
    return grid_mesh(np.stack([radius * np.cos(turn), radius * np.sin(turn), 0 * turn + lift], axis=-1))


def drawn(path, cones, values, **options):
    write_overlay(cones, options.pop("mesh", reference()), values, path, amplitude=4.0, **options)
    return imread(path)[..., :3].reshape(-1, 3)[::3]


def redness(pixels):
    """How far the red channel is above the blue one, on average over what is no background."""
    seen = norm(pixels - colours.rgb(colours.BACKGROUND)) > 0.03
    return float((pixels[seen, 0] - pixels[seen, 2]).mean())


def test_equal_subjects_give_equal_bytes_and_the_picture_is_as_large_as_said(tmp_path, cones):
    values = np.linspace(0, 4, cones.topology.face_count)
    for name in ("a.png", "b.png"):
        write_overlay(cones, reference(), values, tmp_path / name, amplitude=4.0, title="cones")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert imread(tmp_path / "a.png").shape[:2] == (1200, 1800)


def test_far_pleats_are_redder_than_near_ones_and_unknown_ones_are_grey(tmp_path, cones):
    count = cones.topology.face_count
    near, far, unknown = (redness(drawn(tmp_path / "o.png", cones, np.full(count, value))) for value in (0.0, 3.9, np.nan))
    assert far > near + 0.05
    assert unknown < near


def test_the_reference_shows_where_there_are_no_pleats(tmp_path, cones):
    none = np.zeros(cones.topology.face_count)

    def glass(mesh):
        pixels = drawn(tmp_path / "o.png", cones, none, mesh=mesh)
        return float(np.mean(pixels[:, 2] > pixels[:, 0] + 0.01))  # only the reference is bluish

    assert glass(reference(reach=2.0)) > glass(reference()) + 0.05


@pytest.mark.parametrize("values", [0.0, 50.0])
def test_scales_fit_any_deviation(tmp_path, closed_cones, values):
    write_overlay(closed_cones, reference(), np.full(closed_cones.topology.face_count, values), tmp_path / "o.png",
                  amplitude=4.0)
    assert (tmp_path / "o.png").stat().st_size > 20_000

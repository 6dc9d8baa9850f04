"""Grooves are darker than ridges, once nothing moves."""

import io

import numpy as np
import pytest

from plisse.studio.shading import shaded
from plisse.studio.view import flat_view, folded_view

trimesh = pytest.importorskip("trimesh")


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def test_the_model_is_the_paper_from_both_sides(structure):
    view = folded_view(structure)
    scene = trimesh.load(io.BytesIO(shaded(view)), file_type="glb", process=False)
    front, back = scene.geometry.values()
    for mesh in (front, back):
        assert np.array_equal(np.asarray(mesh.vertices, np.float32), view.points)
    assert np.allclose(front.face_normals, -back.face_normals, atol=1e-6)
    assert front.area == pytest.approx(back.area)


def test_what_is_dark_on_one_side_is_light_on_the_other(structure):
    view = folded_view(structure)
    scene = trimesh.load(io.BytesIO(shaded(view)), file_type="glb", process=False)
    front, back = (mesh.visual.vertex_attributes["color"][:, 0].astype(float) for mesh in scene.geometry.values())
    open_front, open_back = view.sky.T.astype(float)
    assert np.corrcoef(front, open_front)[0, 1] > 0.9
    assert np.corrcoef(back, open_back)[0, 1] > 0.9
    assert (np.minimum(255 - open_front, 255 - open_back) == 0).all()


def test_a_flat_sheet_has_no_grooves(structure):
    assert flat_view(structure).sky is None

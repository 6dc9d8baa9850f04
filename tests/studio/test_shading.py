"""Grooves are darker than ridges, once nothing moves."""

import io
from types import SimpleNamespace

import numpy as np
import pytest

from plisse.studio.paper import PALE, Paper, Shown
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


def test_paper_that_a_model_took_the_place_of_is_seen_again_when_it_becomes_pale(structure):
    def node(*_, **__):
        made.append(SimpleNamespace(visible=True, opacity=None))
        return made[-1]

    made: list = []
    paper = Paper(SimpleNamespace(add_frame=node, add_mesh_simple=lambda *_, **__: node_of_mesh(node()),
                                  add_line_segments=node), "/folded")
    paper.show(folded_view(structure), Shown())
    sides = [part for part in made if hasattr(part, "faces")]
    paper.hide_paper()
    assert not any(side.visible for side in sides)
    paper.pale()
    assert len(sides) == 2
    assert all(side.visible and side.opacity == PALE for side in sides)


def node_of_mesh(node):
    """A node that has triangles."""
    node.faces = np.empty((0, 3))
    return node

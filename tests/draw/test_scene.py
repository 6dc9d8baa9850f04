"""The scene of a report page decodes to the structure that it was made of."""

import json
from base64 import b64decode

import numpy as np
import pytest

from plisse.draw.camera import best_view
from plisse.draw.colour_maps import colour_maps
from plisse.draw.openness import openness
from plisse.draw.scene import scene_json
from plisse.geometry.vectors import norm


@pytest.fixture
def scene(cones):
    return json.loads(scene_json(cones, best_view(cones), colour_maps(cones).values()))


def decoded(text, kind, columns):
    return np.frombuffer(b64decode(text), kind).reshape(-1, columns)


def test_vertices_are_the_structures_up_to_motion_and_scale(scene, cones):
    found = decoded(scene["vertices"], "<f4", 3).astype(float)
    a, b = cones.topology.edges.vertices.T
    ratio = norm(found[a] - found[b]) / norm(cones.vertices[a] - cones.vertices[b])
    assert np.ptp(ratio) / ratio.mean() < 1e-4  # single precision
    assert norm(found).max() == pytest.approx(1, abs=1e-6)


def test_triangles_cover_the_faces_and_lines_are_the_edges(scene, cones):
    corners = decoded(scene["corners"], "<u4", 1).ravel()
    triangles = corners[decoded(scene["triangles"], "<u4", 3)]
    assert len(triangles) == 2 * cones.topology.face_count
    areas = norm(np.cross(*(cones.vertices[triangles[:, k]] - cones.vertices[triangles[:, 0]] for k in (1, 2)))) / 2
    quads = cones.vertices[cones.topology.quads]
    assert areas.sum() == pytest.approx(norm(np.cross(quads[:, 2] - quads[:, 0], quads[:, 3] - quads[:, 1])).sum() / 2)
    edges = np.concatenate([decoded(line["edges"], "<u4", 2) for line in scene["lines"]])
    assert len(edges) == len(cones.topology.edges.vertices)


def test_normals_are_unit_and_the_view_is_upright(scene):
    normals = decoded(scene["normals"], "<i2", 4)[:, :3] / 32767
    assert np.allclose(norm(normals), 1, atol=1e-4)  # sixteen bits
    basis = np.array(scene["basis"])
    assert np.allclose(basis @ basis.T, np.eye(3), atol=1e-9)


def test_every_map_has_one_colour_per_corner(scene, cones):
    assert {found["name"] for found in scene["maps"]} == {"planarity", "angle", "principal", "opening"}
    for found in scene["maps"]:
        assert decoded(found["colours"], "u1", 4).shape == (4 * cones.topology.face_count, 4)


def test_valleys_see_less_sky_and_ridges_all_of_it_on_the_other_side_it_is_the_reverse(cones):
    seen = openness(cones.topology, cones.vertices)
    inner = ~cones.topology.is_boundary
    assert np.allclose(seen[inner].max(axis=1), 1)
    opening = 2 * np.arctan2(6.0, 8.0)
    assert np.allclose(seen[inner].min(axis=1), (1 - np.cos(opening)) / 2, atol=0.02)  # 25 columns on half a turn

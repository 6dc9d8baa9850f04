"""Handles: smooth pulls that end, and points that follow an edited mesh."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.errors import InvalidDesign, InvalidMesh
from plisse.geometry.handles import Handle, falloff, follow, moved
from plisse.geometry.mesh import grid_mesh


def sheet(bend=0.05, cells=24):
    x, y = np.meshgrid(np.linspace(-5, 5, cells), np.linspace(-4, 4, cells), indexing="ij")
    return grid_mesh(np.stack([x, y, -bend * (x**2 + 0.5 * y**2)], axis=-1))


def around(mesh, count=200, height=0.4, seed=1):
    rng = np.random.default_rng(seed)
    return mesh.vertices[rng.integers(len(mesh.vertices), size=count)] + height * rng.normal(size=(count, 3))


def test_a_handle_moves_its_point_by_its_displacement_and_nothing_beyond_its_radius():
    handle = Handle([1, 2, 3], [0, 0.5, -2], 4.0)
    ends = np.array([[1.0, 2, 3], [1, 2, 7], [1, 2, 7.001], [-9, 2, 3]])
    np.testing.assert_allclose(moved(ends, [handle]) - ends, [[0, 0.5, -2], *3 * [[0, 0, 0]]], atol=1e-15)
    assert (moved(ends, []) == ends).all()


def test_the_falloff_is_smooth_of_order_two_at_the_centre_and_at_the_radius():
    step = 1e-3
    second = {}
    for at in (0.0, 1.0):
        r = np.abs(at + step * np.arange(-3, 4))
        value = falloff(r)
        second[at] = np.diff(value, 2) / step**2
        assert np.ptp(second[at]) < 0.3  # a kink of curvature would be as large as the curvature, 20
    np.testing.assert_allclose(second[0.0], -20, rtol=0.02)
    np.testing.assert_allclose(second[1.0], 0, atol=0.01)
    assert (np.diff(falloff(np.linspace(0, 1, 100))) < 0).all()


def test_pulls_of_several_handles_add_up():
    points = around(sheet())
    one, other = Handle([0, 0, 0], [0, 0, 1], 4.0), Handle([1, 1, 0], [0.5, 0, 0], 3.0)
    both = moved(points, [one, other]) - points
    np.testing.assert_allclose(both, one.pull(points) + other.pull(points), atol=1e-14)


@pytest.mark.parametrize("change", [{"radius": 0.0}, {"radius": np.nan}, {"point": [0, 0]},
                                    {"displacement": [0, np.inf, 0]}])
def test_a_handle_with_impossible_numbers_is_refused_with_its_name(change):
    numbers = {"point": [0, 0, 0], "displacement": [0, 0, 1], "radius": 1.0} | change
    with pytest.raises(InvalidDesign, match=next(iter(change))):
        Handle(**numbers)


def test_points_follow_a_rigid_motion_of_the_mesh_exactly_also_beyond_its_boundary():
    mesh = sheet()
    turn = Rotation.from_rotvec([0.3, -0.8, 0.5])
    points = np.concatenate([around(mesh), [[8.0, 1.0, 0.2], [-6, -6, 1]]])
    shift = np.array([1.0, 2, 3])
    np.testing.assert_allclose(follow(points, mesh, turn.apply(mesh.vertices) + shift), turn.apply(points) + shift,
                               atol=1e-12)


def test_points_stay_where_they_are_when_nothing_is_edited():
    mesh = sheet()
    points = around(mesh, height=1.0)
    np.testing.assert_allclose(follow(points, mesh, mesh.vertices), points, atol=1e-13)


def test_points_off_a_bent_sheet_stay_at_their_distance_along_the_new_normals():
    cells = 60
    flat = sheet(bend=0.0, cells=cells)
    radius = 6.0
    x, y = flat.vertices[:, 0], flat.vertices[:, 1]
    rolled = np.stack([radius * np.sin(x / radius), y, radius * np.cos(x / radius)], axis=1)
    points = np.array([[1.0, 0.5, 0.7], [-2.0, 1.0, -0.4], [0.3, -3.0, 0.0]])
    found = follow(points, flat, rolled)
    expected = np.stack([(radius + points[:, 2]) * np.sin(points[:, 0] / radius), points[:, 1],
                         (radius + points[:, 2]) * np.cos(points[:, 0] / radius)], axis=1)
    # facets of length h deviate from the cylinder by h² / 8r, and turn by h / r at edges
    np.testing.assert_allclose(found, expected, atol=5e-3)


def test_an_edited_mesh_with_other_vertices_or_collapsed_triangles_is_refused():
    mesh = sheet()
    with pytest.raises(InvalidMesh, match="connectivity"):
        follow(mesh.vertices, mesh, mesh.vertices[:-1])
    flat = mesh.vertices.copy()
    flat[mesh.triangles[0, 1]] = flat[mesh.triangles[0, 0]]
    with pytest.raises(InvalidMesh, match="gently"):
        follow(mesh.vertices, mesh, flat)
    with pytest.raises(InvalidMesh, match="no numbers"):
        follow(mesh.vertices, mesh, np.where(np.arange(len(flat))[:, None] == 3, np.nan, mesh.vertices))

"""Editing: pleats follow their surface and stay exact, regular and near it."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.errors import Infeasible
from plisse.geometry.graph import GraphSurface
from plisse.geometry.handles import Handle, follow, moved
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.measure.folds import fold_angles
from plisse.measure.mid_surface import mid_surface_deviation
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import regularity
from plisse.measure.sectors import angle_defect
from plisse.solve.edited import edited_structure
from plisse.solve.whole_surface import whole_surface


@cache
def mesh():
    x, y = np.meshgrid(np.linspace(-20, 20, 42), np.linspace(-18, 18, 39), indexing="ij")
    return grid_mesh(np.stack([x, y, 2.0 * np.sin(x / 7) * np.cos(y / 9) - 0.01 * (x**2 + y**2)], axis=-1))


@cache
def pleats():
    """A structure over a masked grid, and its amplitude."""
    found = whole_surface(mesh(), GraphSurface(mesh()), width=1.6, centre=np.array([0.0, -55.0, 0.0]))
    return found.structure, found.best.layout.sizes.amplitude


def edit(height, radius=14.0):
    return moved(mesh().vertices, [Handle([6, 4, 0], [0, 0, height], radius)])


def assert_sound(structure):
    topology, vertices = structure.topology, structure.vertices
    assert planarity_defect(topology, vertices).max() < 1e-9
    assert np.abs(angle_defect(topology, vertices)).max() < 1e-9
    assert regularity(topology, vertices).is_regular


def test_a_structure_follows_a_handle_exactly_and_near_the_edited_surface():
    structure, amplitude = pleats()
    vertices = edit(4.0, radius=18.0)
    surface = GraphSurface(ReferenceMesh(vertices, mesh().triangles))
    rest = follow(structure.vertices, mesh(), vertices)
    found = edited_structure(structure, rest, normals=surface.project(rest).normals)
    assert_sound(found.structure)
    assert found.structure.topology is structure.topology
    assert sum(found.steps) == pytest.approx(1)
    quads = structure.topology.quads
    after = mid_surface_deviation(surface, found.structure.vertices, quads)
    unmoved = mid_surface_deviation(surface, structure.vertices, quads)
    before = mid_surface_deviation(GraphSurface(mesh()), structure.vertices, quads)
    assert after.mean < before.mean + 0.15 * amplitude
    assert after.max < 0.7 * unmoved.max
    np.testing.assert_allclose(found.drift, np.linalg.norm(found.structure.vertices - rest, axis=1))
    assert found.drift.mean() < 0.5 * amplitude


def test_folds_keep_their_sides_and_their_inclination_varies_after_an_edit():
    structure, _ = pleats()
    found = edited_structure(structure, follow(structure.vertices, mesh(), edit(3.0)))
    creases = structure.topology.edges.is_crease
    before, after = (fold_angles(structure.topology, s.vertices)[creases] for s in (structure, found.structure))
    assert (np.sign(before) == np.sign(after)).all()
    assert np.abs(before - after).max() > np.radians(2)


def test_a_rigid_motion_changes_nothing_but_the_place():
    structure, _ = pleats()
    turn = Rotation.from_rotvec([0.05, 0.1, -0.1])
    rest = turn.apply(structure.vertices) + np.array([3.0, -2.0, 0.5])
    found = edited_structure(structure, rest)
    assert found.steps == (1.0,)
    np.testing.assert_allclose(found.structure.vertices, rest, atol=1e-7 * structure.diagonal)


def test_a_small_edit_moves_pleats_outside_its_radius_hardly_at_all():
    structure, amplitude = pleats()
    found = edited_structure(structure, follow(structure.vertices, mesh(), edit(0.5, radius=8.0)))
    shift = np.linalg.norm(found.structure.vertices - structure.vertices, axis=1)
    far = np.linalg.norm(structure.vertices[:, :2] - [6, 4], axis=1) > 16
    assert shift[far].mean() < 0.05 * amplitude


def test_a_structure_without_a_grid_is_edited_too(closed_cones):
    rest = moved(closed_cones.vertices, [Handle([100, 0, 0], [6, 0, 4], 90.0)])
    found = edited_structure(closed_cones, rest)
    assert_sound(found.structure)
    assert np.linalg.norm(found.structure.vertices - closed_cones.vertices, axis=1).max() > 2


def test_an_edit_that_pleats_cannot_follow_says_how_far_they_can():
    structure, _ = pleats()
    rest = structure.vertices.copy()
    rest[:, 2] += 60 * np.sin(structure.vertices[:, 0]) * np.sin(structure.vertices[:, 1])
    with pytest.raises(Infeasible, match=r"follow this edit for \d+ % of the way only"):
        edited_structure(structure, rest)


def test_moved_vertices_of_another_structure_are_refused():
    structure, _ = pleats()
    with pytest.raises(ValueError, match="expected"):
        edited_structure(structure, structure.vertices[:-1])

"""Whole surfaces that are no graphs: sheets bent too far, and tubes with creases that go up all around them."""

from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.errors import Infeasible
from plisse.geometry.closest import closest_on_mesh
from plisse.geometry.formulas import Sphere
from plisse.geometry.graph import facing_up
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.geometry.parametric import ParametricSurface
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import regularity
from plisse.measure.sectors import angle_defect
from plisse.solve.candidate import centre_of
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.solve.whole_surface import FOLDABLE, whole_surface

WIDTH = 2.2


@cache
def vault():
    """A barrel vault of 240° whose radius changes from end to end."""
    turn, along = np.meshgrid(np.linspace(0, np.radians(240), 50), np.linspace(0, 30, 36), indexing="ij")
    radius = 10 + 0.02 * along
    return grid_mesh(np.stack([radius * np.cos(turn), radius * np.sin(turn), along], axis=-1))


@cache
def tube():
    """A tube with a waist, open at both ends."""
    turn, along = np.meshgrid(2 * np.pi / 60 * np.arange(60), np.linspace(-15, 15, 30), indexing="ij")
    radius = 8 * np.sqrt(1 + (along / 16) ** 2)
    return grid_mesh(np.stack([radius * np.cos(turn), radius * np.sin(turn), along], axis=-1), (True, False))


MESHES = {"vault": vault, "tube": tube}


@cache
def solution(name):
    mesh = MESHES[name]()
    return whole_surface(mesh, ParametricSurface(mesh), width=WIDTH, seams=0)


@pytest.mark.parametrize("name", MESHES)
def test_surfaces_that_face_away_from_their_mean_plane_are_covered_exactly(name):
    found = solution(name)
    assert facing_up(MESHES[name]()) < 0.9
    structure = found.structure
    assert found.coverage > 0.99
    assert planarity_defect(structure.topology, structure.vertices).max() < 1e-9
    assert np.abs(angle_defect(structure.topology, structure.vertices)).max() < 1e-9
    measured = regularity(structure.topology, structure.vertices)
    assert measured.is_regular
    assert found.best.least_opening > FOLDABLE
    assert found.best.holes == 0


@pytest.mark.parametrize("name", MESHES)
def test_the_middles_of_faces_are_near_the_mesh_as_found_without_a_chart(name):
    found, mesh = solution(name), MESHES[name]()
    middles = found.structure.vertices[found.structure.topology.quads].mean(axis=1)
    known = np.isfinite(found.deviation.distances)
    distance = np.linalg.norm(middles - closest_on_mesh(mesh, middles)[0], axis=1)
    sagitta = mesh.edge_lengths.max() ** 2 / 8 / 8  # of triangles inscribed in radius 8
    np.testing.assert_allclose(found.deviation.distances[known], distance[known], atol=2 * sagitta)


def test_creases_go_up_a_tube_and_their_family_closes():
    found = solution("tube")
    topology = found.structure.topology
    assert found.best.layout.net.is_ring
    assert topology.euler_characteristic == 0
    assert len(found.structure.topology.creases) % 2 == 0
    assert not any(crease.closed for crease in topology.creases)
    flat = flatten(found.structure, best_cut(found.structure))
    assert flat.development is not None


@pytest.mark.parametrize("name", MESHES)
def test_a_turned_and_scaled_copy_is_pleated_alike(name):
    mesh, turn, scale, shift = MESHES[name](), Rotation.from_euler("xyz", [30, -70, 15], degrees=True), 0.04, [3, 1, -2]
    other = ReferenceMesh(scale * turn.apply(mesh.vertices) + shift, mesh.triangles)
    found = whole_surface(other, ParametricSurface(other), width=scale * WIDTH, seams=0)
    assert found.coverage == pytest.approx(solution(name).coverage, abs=0.02)
    expected = scale * turn.apply(solution(name).structure.vertices) + shift
    assert found.structure.vertices.shape == expected.shape
    off = np.linalg.norm(found.structure.vertices - expected, axis=1)
    assert off.max() < 0.1 * found.best.layout.sizes.amplitude


def test_a_centre_is_refused_for_tubes():
    with pytest.raises(Infeasible, match="up a tube or around it"):
        whole_surface(tube(), ParametricSurface(tube()), centre=np.zeros(3))


def test_a_centre_stands_for_the_nearest_place_of_a_sheet():
    surface = ParametricSurface(vault())
    centre = surface.to_space(np.array([[27.0, 3.0, 1.5]]))
    np.testing.assert_allclose(surface.to_plane(centre)[0], [27, 3, 1.5], atol=1e-8)
    found = whole_surface(vault(), surface, width=WIDTH, centre=centre[0], seams=0)
    np.testing.assert_allclose(found.best.layout.centre, [27, 3], atol=1e-8)
    np.testing.assert_allclose(centre_of(found.best, surface), surface.to_space(np.array([[27.0, 3.0, 0.0]]))[0], atol=1e-8)


@pytest.mark.slow
def test_more_than_a_hemisphere_is_covered_with_seams():
    mesh = Sphere(10.0, cap=np.radians(110)).mesh(48)
    found = whole_surface(mesh, ParametricSurface(mesh), width=1.4, candidates=6)
    assert found.best.solved.is_sound
    assert found.coverage > 0.95

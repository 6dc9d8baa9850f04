"""The ground truth is what its formulas say: exact, foldable, and different from disturbed copies."""

import numpy as np
import pytest

from plisse.geometry.vectors import angle_between, cross_flat, dot, norm, unit
from plisse.measure.folds import fold_angles
from plisse.measure.isometry import isometry_defect
from plisse.measure.planarity import face_normals, planarity_defect
from plisse.measure.regularity import regularity
from plisse.measure.sectors import angle_defect, principal_defect, sector_angles
from plisse.structure.exact import (
    alternating_cones,
    conic_creases,
    conical_vertex,
    folded_grid,
    marched,
    miura,
)

PRINCIPAL = {
    "cones": alternating_cones(),
    "closed cones": alternating_cones(closed=True),
    "miura": miura(),
    "vertex": conical_vertex(),
    "conics": conic_creases(),
}
EVERY = PRINCIPAL | {"marched": marched()}


def inner_folds(structure, *, crease):
    """Signed folds of inner crease (or ruling) edges, and the edges' vertices."""
    edges = structure.topology.edges
    chosen = (edges.is_crease == crease) & ~edges.is_boundary
    return fold_angles(structure.topology, structure.vertices)[chosen], edges.vertices[chosen]


@pytest.mark.parametrize("name", EVERY)
def test_faces_are_planar_and_angles_sum_to_a_full_turn(name):
    structure = EVERY[name]
    assert planarity_defect(structure.topology, structure.vertices).max() < 1e-14
    assert np.abs(angle_defect(structure.topology, structure.vertices)).max() < 3e-14


@pytest.mark.parametrize("name", PRINCIPAL)
def test_opposite_angles_of_principal_structures_are_supplementary(name):
    structure = PRINCIPAL[name]
    assert principal_defect(structure.topology, structure.vertices).max() < 3e-14


def test_marched_structure_is_not_principal():
    structure = marched()
    assert principal_defect(structure.topology, structure.vertices).max() > 1e-2


@pytest.mark.parametrize("name", EVERY)
def test_exact_structures_are_regular(name):
    structure = EVERY[name]
    found = regularity(structure.topology, structure.vertices)
    assert found.is_regular
    assert found.min_sector > np.radians(30)


@pytest.mark.parametrize("name", PRINCIPAL)
def test_development_is_isometric_and_faces_up(name):
    structure = PRINCIPAL[name]
    opened = structure.opened
    assert isometry_defect(opened.topology, opened.vertices, structure.development) < 3e-14
    corners = structure.development[opened.topology.quads]
    diagonal, other = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    assert (cross_flat(diagonal, other) > 0).all()


@pytest.mark.parametrize("name", PRINCIPAL)
def test_folds_are_constant_along_creases_and_alternate_across_rulings(name):
    structure = PRINCIPAL[name]
    _, columns = shape_of(structure)
    folds, vertices = inner_folds(structure, crease=True)
    for level in np.unique(vertices[:, 0] // columns):
        along = folds[vertices[:, 0] // columns == level]
        np.testing.assert_allclose(along, along[0], atol=1e-13)
    folds, vertices = inner_folds(structure, crease=False)
    for column in np.unique(vertices[:, 0] % columns):
        along = folds[vertices[:, 0] % columns == column]
        np.testing.assert_allclose(along[1:], -along[:-1], atol=1e-13)


def shape_of(structure):
    creases = len(structure.topology.creases)
    return creases, structure.topology.vertex_count // creases


def test_disturbed_copies_are_seen_by_every_measure():
    for structure in PRINCIPAL.values():
        topology = structure.topology
        shaken = structure.vertices + 1e-6 * np.random.default_rng(0).normal(size=structure.vertices.shape)
        assert planarity_defect(topology, shaken).max() > 1e-8
        assert np.abs(angle_defect(topology, shaken)).max() > 1e-8
        assert principal_defect(topology, shaken).max() > 1e-8


@pytest.mark.parametrize("slope", [0.2, 0.8, 3.0])
def test_cones_fold_by_the_slope_of_their_faces(slope):
    structure = alternating_cones(columns=12, sector=1.1, slope=slope)
    folds, _ = inner_folds(structure, crease=True)
    np.testing.assert_allclose(np.abs(folds), 2 * np.arctan(slope / np.cos(0.05)), rtol=1e-12)


def test_gauss_image_of_each_cone_is_a_circle():
    structure = alternating_cones(slope=0.8)
    normals = face_normals(structure.topology, structure.vertices).reshape(5, 23, 3)
    step = 2.0 / 23
    expected = 1 / np.hypot(1, 0.8 / np.cos(step / 2))
    np.testing.assert_allclose(np.abs(normals[..., 2]), expected, rtol=1e-12)
    turns = angle_between(normals[:, 1:] * [1, 1, 0], normals[:, :-1] * [1, 1, 0])
    np.testing.assert_allclose(turns, step, rtol=1e-9)


def test_curvature_of_developed_cones_is_the_geodesic_one():
    structure = alternating_cones(4, 60, radius=2.0, slope=0.5)
    flat = structure.development.reshape(4, 60, 2)
    edges = np.diff(flat, axis=1)
    ahead, behind = edges[:, 1:], edges[:, :-1]
    turn = np.arctan2(np.abs(cross_flat(behind, ahead)), dot(behind, ahead))
    radius = 2.0 + 0.2 * np.arange(4)
    cosine = 1 / np.hypot(1, 0.5)
    # κ_g = cos β / r for a circle of latitude on a cone; edges against arcs differ by their square
    np.testing.assert_allclose(turn.mean(axis=1) / norm(edges).mean(axis=1), cosine / radius, rtol=1e-3)


def test_fold_ratio_of_a_vertex_is_that_of_section_2_5():
    first, second = 1.2, 1.5
    for fold in (0.3, 1.0, 2.5):
        structure = conical_vertex(first, second, fold)
        crease, _ = inner_folds(structure, crease=True)
        ruling, _ = inner_folds(structure, crease=False)
        beside = np.pi - second
        ratio = np.sin((beside - first) / 2) / np.sin((beside + first) / 2)
        np.testing.assert_allclose(crease, fold, rtol=1e-13)
        np.testing.assert_allclose(np.abs(np.tan(ruling / 2) / np.tan(fold / 2)), abs(ratio), rtol=1e-12)


def test_miura_creases_fold_by_twice_the_inclination_of_faces():
    for fold in (0.2, 0.9, 1.4):
        structure = miura(fold=fold)
        folds, _ = inner_folds(structure, crease=True)
        np.testing.assert_allclose(np.abs(folds), 2 * fold, rtol=1e-12)
        np.testing.assert_allclose(np.unique(sector_angles(structure.topology, structure.vertices).round(12)),
                                   [1.1, round(np.pi - 1.1, 12)])


def test_conic_creases_develop_into_ellipses_whose_foci_lie_on_the_rulings():
    growth, eccentricity = 1.12, 0.45
    structure = conic_creases(eccentricity=eccentricity, growth=growth)
    flat = structure.development.reshape(5, 24, 2)
    foci = [np.array([-eccentricity, 0.0]), np.array([eccentricity, 0.0])]
    for level in range(5):
        distance = sum(norm(flat[level] - focus) for focus in foci[-2:])
        np.testing.assert_allclose(distance, 2 * growth**level, rtol=1e-13)
        if level < 4:
            ruling, ray = flat[level + 1] - flat[level], flat[level] - foci[-1]
            assert np.abs(cross_flat(ruling, ray)).max() < 1e-14
            foci.append(foci[-1] + growth * (foci[-2] - foci[-1]))


def test_rulings_reflect_in_conic_creases():
    flat = conic_creases().development.reshape(5, 24, 2)
    for level in range(1, 4):
        crease = flat[level]
        ahead, behind = unit(crease[2:] - crease[1:-1]), unit(crease[:-2] - crease[1:-1])
        inward = unit(flat[level - 1] - crease)[1:-1]
        outward = unit(flat[level + 1] - crease)[1:-1]
        bisector = unit(ahead + behind)
        np.testing.assert_allclose(dot(inward, bisector), dot(-outward, bisector), atol=1e-13)


@pytest.mark.parametrize("eccentricity", [0.05, 0.3, 0.7])
@pytest.mark.parametrize("fold", [0.3, 1.2, 2.4])
def test_conic_creases_stay_exact_while_they_fold(eccentricity, fold):
    structure = conic_creases(eccentricity=eccentricity, fold=fold)
    assert planarity_defect(structure.topology, structure.vertices).max() < 3e-14
    assert np.abs(angle_defect(structure.topology, structure.vertices)).max() < 3e-13


@pytest.mark.parametrize("fold", [1.5, 1.8, 2.1])
def test_marching_is_exact_for_any_fold_at_the_first_edge(fold):
    structure = marched(3, 16, fold=fold)
    assert planarity_defect(structure.topology, structure.vertices).max() < 1e-13
    assert np.abs(angle_defect(structure.topology, structure.vertices)).max() < 1e-13


def test_wrong_folds_tear_a_pattern_apart():
    flat = conic_creases().development.reshape(5, 24, 2)
    structure = folded_grid(flat, [1.2, -1.2, 1.2], np.full(22, 0.3))
    assert planarity_defect(structure.topology, structure.vertices).max() > 1e-3

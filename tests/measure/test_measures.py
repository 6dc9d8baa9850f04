"""Measures vanish on exact structures, see disturbed ones, and agree with five-line recomputations."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.measure.deviation import crease_deviation
from plisse.measure.folds import assignments, crease_opening_angles, fold_angles
from plisse.measure.intersection import intersecting_faces
from plisse.measure.isometry import isometry_defect
from plisse.measure.measurements import measure
from plisse.measure.overlap import development_overlap
from plisse.measure.planarity import face_areas, face_normals, planarity_defect
from plisse.measure.regularity import inverted_faces, regularity
from plisse.measure.sectors import angle_defect, principal_defect, sector_angles
from plisse.structure.exact import alternating_cones, conic_creases, marched, miura
from plisse.structure.grid import grid
from plisse.structure.topology import Topology

QUAD = Topology(4, np.array([[0, 1, 2, 3]]))
HEXAGON = Topology(6, np.empty((0, 4)), (np.arange(6),))
STRUCTURES = {"cones": alternating_cones(), "closed cones": alternating_cones(closed=True), "miura": miura(),
              "conics": conic_creases(), "marched": marched()}


def roof(rise):
    """Two unit squares along a crease on the y axis; the second one rises to `rise` at x = 1."""
    topology = Topology(6, np.array([[0, 1, 2, 3], [2, 1, 4, 5]]))
    vertices = np.array([[-1, 0, 0], [0, 0, 0], [0, 1, 0], [-1, 1, 0], [1, 0, rise], [1, 1, rise]], float)
    # faces begin with a crease edge: the common edge is 1–2
    quads = np.array([[1, 2, 3, 0], [2, 1, 4, 5]])
    return Topology(topology.vertex_count, quads), vertices


@pytest.mark.parametrize("name", STRUCTURES)
def test_planarity_and_angles_vanish_on_exact_structures(name):
    structure = STRUCTURES[name]
    found = measure(structure).shape
    assert found.planarity.max() < 1e-14
    assert np.abs(found.angle).max() < 3e-14
    assert not found.inverted.any()
    assert len(found.intersections) == 0


@pytest.mark.parametrize("name", STRUCTURES)
def test_defects_grow_with_the_disturbance(name):
    topology, vertices = STRUCTURES[name].topology, STRUCTURES[name].vertices
    noise = np.random.default_rng(0).normal(size=vertices.shape)
    for defect in (planarity_defect, angle_defect, principal_defect):
        if defect is principal_defect and name == "marched":
            continue
        small, large = (np.abs(defect(topology, vertices + size * noise)).max() for size in (1e-6, 1e-5))
        assert small > 1e-8
        assert large == pytest.approx(10 * small, rel=0.02)  # linear up to the square of the disturbance


@pytest.mark.parametrize("name", STRUCTURES)
def test_measures_do_not_see_rigid_motions_and_scale(name):
    structure = STRUCTURES[name]
    topology = structure.topology
    shaken = structure.vertices + 1e-3 * np.random.default_rng(0).normal(size=structure.vertices.shape)
    moved = 7 * shaken @ Rotation.from_rotvec([1.0, 0.4, -0.7]).as_matrix().T + [3, -2, 5]
    for number in (planarity_defect, angle_defect, principal_defect, sector_angles, fold_angles):
        np.testing.assert_allclose(number(topology, moved), number(topology, shaken), atol=1e-11)
    np.testing.assert_allclose(face_areas(topology, moved), 49 * face_areas(topology, shaken), rtol=1e-11)


def test_planarity_is_the_distance_of_diagonals_over_their_mean_length():
    corners = np.array([[0, 0, 0], [1, 0, 0.1], [1, 1, 0], [0, 1, 0.1]])
    # diagonals of length √2 at heights 0 and 0.1
    assert planarity_defect(QUAD, corners) == pytest.approx(0.1 / np.sqrt(2))


def test_planarity_of_a_hub_is_its_thickness_over_its_diameter():
    angle = np.pi / 3 * np.arange(6)
    flat = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    assert planarity_defect(HEXAGON, flat)[0] < 1e-15
    bent = flat + [0, 0, 0.1] * np.array([1, -1, 1, -1, 1, -1])[:, None]
    assert planarity_defect(HEXAGON, bent)[0] == pytest.approx(0.1 / np.sqrt(4.04))


def test_angle_defect_of_a_cube_corner_and_of_a_saddle():
    topology = grid(3, 3)
    plane = np.stack([*np.meshgrid(np.arange(3.0), np.arange(3.0)), np.zeros((3, 3))], axis=-1).reshape(-1, 3)
    assert not np.delete(angle_defect(topology, plane), 4).any()
    assert angle_defect(topology, plane)[4] == pytest.approx(0, abs=1e-15)
    tent, saddle = plane.copy(), plane.copy()
    tent[4, 2] = 1.0
    saddle[[1, 7], 2], saddle[[3, 5], 2] = 0.5, -0.5
    assert angle_defect(topology, tent)[4] < -0.1
    assert angle_defect(topology, saddle)[4] > 0.1


def test_sector_angles_of_every_planar_face_sum_to_its_polygon():
    for structure in STRUCTURES.values():
        topology = structure.topology
        sums = np.bincount(topology.corners.face, sector_angles(topology, structure.vertices))
        np.testing.assert_allclose(sums, 2 * np.pi, rtol=1e-14)


def test_sector_angles_agree_with_the_law_of_cosines():
    topology, vertices = STRUCTURES["conics"].topology, STRUCTURES["conics"].vertices
    corners = topology.corners
    a = np.linalg.norm(vertices[corners.next] - vertices[corners.vertex], axis=1)
    b = np.linalg.norm(vertices[corners.previous] - vertices[corners.vertex], axis=1)
    c = np.linalg.norm(vertices[corners.next] - vertices[corners.previous], axis=1)
    expected = np.arccos((a**2 + b**2 - c**2) / (2 * a * b))
    np.testing.assert_allclose(sector_angles(topology, vertices), expected, atol=1e-12)


@pytest.mark.parametrize("rise", [1.0, 0.2, -0.2, -1.0])
def test_valleys_rise_on_both_sides_of_their_fold(rise):
    topology, vertices = roof(rise)
    edge = ~topology.edges.is_boundary
    assert face_normals(topology, vertices)[0, 2] == pytest.approx(1)
    assert fold_angles(topology, vertices)[edge] == pytest.approx(np.arctan(rise))
    assert assignments(topology, vertices)[edge] == ("V" if rise > 0 else "M")


def test_opening_angle_complements_the_fold():
    topology, vertices = roof(1.0)
    np.testing.assert_allclose(crease_opening_angles(topology, vertices), [0.75 * np.pi])


def test_assignments_alternate_from_crease_to_crease():
    structure = alternating_cones(6, 10)
    edges = structure.topology.edges
    letters = assignments(structure.topology, structure.vertices)
    assert set(letters[edges.is_boundary]) == {"B"}
    level = edges.vertices[:, 0] // 10
    by_crease = [set(letters[edges.is_crease & (level == k)]) for k in range(1, 5)]
    assert by_crease in ([{"M"}, {"V"}] * 2, [{"V"}, {"M"}] * 2)


def test_nothing_is_folded_in_a_development():
    structure = miura()
    flat = np.pad(structure.development, ((0, 0), (0, 1)))
    inner = ~structure.topology.edges.is_boundary
    assert set(assignments(structure.topology, flat)[inner]) == {"F"}
    assert not fold_angles(structure.topology, flat).any()


def test_areas_in_space_and_plane_agree_on_exact_structures():
    for name in ("cones", "miura", "conics"):
        structure = STRUCTURES[name]
        flat = np.pad(structure.development, ((0, 0), (0, 1)))
        np.testing.assert_allclose(face_areas(structure.topology, structure.vertices),
                                   face_areas(structure.topology, flat), rtol=1e-12)


def test_isometry_defect_is_the_largest_stretch():
    structure = miura()
    topology, flat = structure.topology, structure.development
    assert isometry_defect(topology, structure.vertices, flat) < 1e-14
    longest = np.linalg.norm(np.diff(flat[topology.rods], axis=1)[:, 0], axis=1)
    assert isometry_defect(topology, structure.vertices, 1.01 * flat) == pytest.approx(
        0.01 * longest.max() / longest.mean(), rel=1e-9)


def test_a_corner_pulled_through_its_face_is_inverted():
    structure = miura()
    assert not inverted_faces(structure.topology, structure.vertices).any()
    pulled = structure.vertices.copy()
    face = structure.topology.quads[0]
    pulled[face[0]] = 2 * pulled[face[2]] - pulled[face[0]]
    assert inverted_faces(structure.topology, pulled)[0]


def test_regularity_is_lost_when_pleats_close():
    shallow, deep = (alternating_cones(slope=slope) for slope in (1.0, 300.0))
    assert regularity(shallow.topology, shallow.vertices).is_regular
    closed = regularity(deep.topology, deep.vertices)
    assert not closed.is_regular
    assert closed.max_opening < np.radians(2)


def test_faces_that_cut_through_each_other_are_found():
    topology = Topology(8, np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))
    square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
    upright = np.array([[0.5, 0.2, -1], [0.5, 0.8, -1], [0.5, 0.8, 1], [0.5, 0.2, 1]])
    assert len(intersecting_faces(topology, np.concatenate([square, upright]))) == 1
    assert len(intersecting_faces(topology, np.concatenate([square, upright + np.array([2, 0, 0])]))) == 0


def test_a_development_beyond_a_full_turn_overlaps():
    slim, full = (alternating_cones(3, 60, sector=sector, slope=0.1) for sector in (5.0, 7.0))
    assert not development_overlap(slim.topology, slim.development).overlaps
    assert development_overlap(full.topology, full.development).overlaps


def test_crease_deviation_ignores_sliding_along_guides():
    place = np.linspace(0, 1, 50)
    guide = np.stack([place, 0 * place, 0 * place], axis=1)
    slid = guide + np.array([0.013, 0, 0])
    raised = guide + np.array([0.013, 0.2, 0])
    deviation = crease_deviation(np.array([slid, raised]), np.array([guide, guide]))
    np.testing.assert_allclose(deviation, np.array([[0.0], [0.2]]) + np.zeros(50), atol=1e-15)

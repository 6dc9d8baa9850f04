"""The motion of principal structures: every state exact, independent of the others, and as §2.5 says."""

import numpy as np
import pytest

import plisse
from plisse.errors import InvalidDesign, InvalidStructure
from plisse.geometry.vectors import norm
from plisse.measure.isometry import isometry_defect
from plisse.measure.planarity import face_areas, planarity_defect
from plisse.measure.sectors import angle_defect, principal_defect
from plisse.solve.flatten import flatten
from plisse.structure.exact import alternating_cones, conic_creases, conical_vertex, marched, miura
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

PERCENT = np.array([0.0, 1.0, 37.0, 100.0, 142.0, 199.0, 200.0])


def helix_march(**numbers):
    recipe = {"curve": {"kind": "helix", "radius": 80, "pitch": 160, "turns": 0.6},
              "march": {"creases": 9, "distance": 9, "opening": 80, "samples": 41, **numbers}}
    return plisse.design(recipe).structure


STRUCTURES = {
    "cones": alternating_cones(6, 25, sector=2.5),
    "closed cones": alternating_cones(5, 24, closed=True),
    "conics": conic_creases(6, 30),
    "miura": miura(),
    "vertex": conical_vertex(),
    "march": helix_march(),
    "march that dies at its ends": helix_march(creases=21, fold=[[0, 60], [0.5, 100], [1, 60]]),
}


@pytest.fixture(params=STRUCTURES, scope="module")
def structure(request):
    return STRUCTURES[request.param]


def tan_half_folds(structure):
    """Five lines of their own: unsigned tan(φ/2) from the triangle normals of both faces at every inner edge."""
    edges = structure.topology.edges
    corners = np.array([face[:3] for face in structure.topology.faces])
    a, b, c = (structure.vertices[corners[:, k]] for k in range(3))
    normals = np.cross(b - a, c - a)
    one, other = normals[edges.faces[~edges.is_boundary].T]
    return norm(np.cross(one, other)) / (norm(one) * norm(other) + np.einsum("ei,ei->e", one, other))


def test_tangents_of_half_the_folds_scale_by_one_factor(structure):
    motion = structure.flex(PERCENT[1:-1])
    designed = tan_half_folds(structure.opened)
    for percent, state in zip(motion.percent, motion.structures, strict=True):
        factor = np.tan(np.pi * percent / 400)
        # 1e-9: normals of slim faces know an angle to 1e-13, and near 200 % the factor is 254
        assert np.abs(tan_half_folds(state) - factor * designed).max() < 1e-9 * factor * max(1, designed.max())


def test_every_state_is_isometric_to_the_one_development(structure):
    motion = structure.flex(PERCENT)
    size = np.linalg.norm(np.ptp(motion.development, axis=0))
    for vertices in motion.vertices:
        assert isometry_defect(motion.topology, vertices, motion.development) < 1e-10
        i, j = motion.topology.edges.vertices.T
        lengths, flat = norm(vertices[i] - vertices[j]), norm(motion.development[i] - motion.development[j])
        assert np.abs(lengths - flat).max() < 1e-12 * size


def test_every_state_is_planar_developable_and_principal(structure):
    motion = structure.flex(PERCENT)
    for vertices in motion.vertices:
        assert planarity_defect(motion.topology, vertices).max() < 1e-11
        assert np.abs(angle_defect(motion.topology, vertices)).max() < 1e-11
        assert principal_defect(motion.topology, vertices).max() < 1e-11


def test_a_state_develops_into_the_same_sheet(structure):
    motion = structure.flex([64.0])
    again = flatten(PleatedStructure(motion.topology, motion.vertices[0])).development
    size = np.linalg.norm(np.ptp(again, axis=0))
    i, j = np.random.default_rng(0).integers(0, len(again), (2, 400))
    assert np.abs(norm(again[i] - again[j]) - norm(motion.development[i] - motion.development[j])).max() < 1e-9 * size


def test_both_ends_of_the_motion_lie_in_a_plane_and_keep_all_areas(structure):
    motion = structure.flex([0.0, 200.0])
    areas = face_areas(structure.topology, structure.vertices)
    for vertices in motion.vertices:
        centred = vertices - vertices.mean(axis=0)
        axes = np.linalg.svd(centred, full_matrices=False)[2]
        assert np.abs(centred @ axes[2]).max() < 1e-9 * np.linalg.norm(np.ptp(vertices, axis=0))
        assert np.abs(face_areas(motion.topology, vertices) / areas - 1).max() < 1e-9


def test_the_flat_state_is_the_development_moved_rigidly(structure):
    motion = structure.flex(0)
    i, j = np.random.default_rng(1).integers(0, len(motion.development), (2, 400))
    space, plane = norm(motion.vertices[0][i] - motion.vertices[0][j]), norm(motion.development[i] - motion.development[j])
    assert np.abs(space - plane).max() < 1e-9 * plane.max()


def test_the_designed_state_is_the_structure_where_it_is(structure):
    motion = structure.flex(100)
    assert np.abs(motion.vertices[0] - structure.opened.vertices).max() < 1e-11 * structure.diagonal


def test_states_do_not_depend_on_each_other(structure):
    together = structure.flex([10.0, 70.0, 150.0, 70.0])
    alone = structure.flex(70.0)
    assert np.array_equal(together.vertices[1], together.vertices[3])
    assert np.abs(together.vertices[1] - alone.vertices[0]).max() <= 1e-14 * structure.diagonal


def test_a_state_flexes_into_the_states_of_the_whole_motion():
    cones = STRUCTURES["cones"]
    half = cones.flex(60).structures[0]
    # tan(0.45° · 100) of the half state is tan(0.45° · 60) of the whole: λ multiply
    further = half.flex(400 / np.pi * np.arctan(1 / np.tan(np.pi * 60 / 400))).vertices[0]
    pairs = cones.topology.rods.T
    goal = norm(cones.vertices[pairs[0]] - cones.vertices[pairs[1]])
    far = np.random.default_rng(2).integers(0, len(further), (2, 300))
    assert np.abs(norm(further[pairs[0]] - further[pairs[1]]) - goal).max() < 1e-11
    assert np.abs(norm(further[far[0]] - further[far[1]])
                  - norm(cones.vertices[far[0]] - cones.vertices[far[1]])).max() < 1e-10


def test_the_miura_flexes_into_the_miura_of_another_fold():
    whole, percent = miura(fold=0.9), 55.0
    # creases fold by 2θ, so tan θ is multiplied
    other = miura(fold=float(np.arctan(np.tan(0.9) * np.tan(np.pi * percent / 400))))
    state = whole.flex(percent).vertices[0]
    far = np.triu_indices(len(state), 1)
    assert np.abs(norm(state[far[0]] - state[far[1]]) - norm(other.vertices[far[0]] - other.vertices[far[1]])).max() < 1e-12


def test_the_flat_folded_miura_lies_on_itself():
    state = miura(5, 8, edge=1.0, ruling=1.3, sector=1.1).flex(200).vertices[0].reshape(5, 8, 3)
    # along a crease every second vertex returns to the same place
    assert norm(state[:, 2:] - state[:, :-2]).max() < 1e-12
    # along the rulings the pleats pile up as well: all of them turn back at their creases
    assert np.abs(state[2:] - state[:-2] - (state[2, 0] - state[0, 0])).max() < 1e-12


def test_cones_stay_cones_of_equal_slope():
    cones = alternating_cones(6, 25, sector=2.0)
    for state in cones.flex([30.0, 160.0]).structures:
        rows = state.vertices.reshape(6, 25, 3)
        _, radius = _circle(rows[2])
        for row in rows:
            middle, other = _circle(row)
            assert np.abs(norm(row - middle) - other).max() < 1e-9 * radius


def _circle(points):
    """Centre and radius of the circle through coplanar points, by least squares."""
    origin = points.mean(axis=0)
    axes = np.linalg.svd(points - origin, full_matrices=False)[2]
    x, y = (points - origin) @ axes[:2].T[:, 0], (points - origin) @ axes[:2].T[:, 1]
    u, v, c = np.linalg.lstsq(np.stack([2 * x, 2 * y, np.ones_like(x)], axis=1), x * x + y * y, rcond=None)[0]
    return origin + u * axes[0] + v * axes[1], float(np.sqrt(c + u * u + v * v))


def test_holes_and_missing_quads_do_not_matter():
    whole = alternating_cones(7, 20, sector=2.0)
    mask = np.ones((6, 19), bool)
    mask[2:4, 7:12] = False
    mask[:2, :3] = False
    holed = PleatedStructure(grid(7, 20, mask=mask), whole.vertices)
    motion = holed.flex([45.0])
    used = motion.cut.source[np.unique(motion.topology.corners.vertex)]
    state = whole.flex([45.0]).vertices[0]
    own = motion.vertices[0][np.unique(motion.topology.corners.vertex)]
    i, j = np.random.default_rng(3).integers(0, len(own), (2, 300))
    assert np.abs(norm(own[i] - own[j]) - norm(state[used[i]] - state[used[j]])).max() < 1e-10
    assert motion.cut_place


def test_polygons_in_the_middle_move_with_the_quads_around_them():
    whole = miura(5, 6)
    middle = len(whole.topology.quads) // 2
    others = np.delete(whole.topology.quads, middle, axis=0)
    with_hub = PleatedStructure(Topology(30, others, (whole.topology.quads[middle],)), whole.vertices)
    state, other = whole.flex(70).vertices[0], with_hub.flex(70).vertices[0]
    far = np.triu_indices(30, 1)
    assert np.abs(norm(state[far[0]] - state[far[1]]) - norm(other[far[0]] - other[far[1]])).max() < 1e-12


def test_reoriented_and_relabelled_structures_move_alike():
    cones = alternating_cones(5, 12, sector=1.5)
    renumber = np.random.default_rng(4).permutation(len(cones.vertices))
    vertices = np.empty_like(cones.vertices)
    vertices[renumber] = cones.vertices
    turned = renumber[cones.topology.quads][:, [1, 0, 3, 2]]
    other = PleatedStructure(Topology(len(vertices), turned), vertices).flex(30).vertices[0][renumber]
    state = cones.flex(30).vertices[0]
    far = np.triu_indices(len(state), 1)
    assert np.abs(norm(state[far[0]] - state[far[1]]) - norm(other[far[0]] - other[far[1]])).max() < 1e-11


def test_closed_structures_are_cut_first_and_say_where():
    motion = alternating_cones(5, 24, closed=True).flex([0.0, 100.0])
    assert len(motion.development) > 5 * 24
    assert "across the creases" in motion.cut_place
    assert alternating_cones(5, 24).flex(50).cut_place == ""


def test_general_structures_are_refused_with_vertex_and_defect():
    general = marched()
    worst = int(np.argmax(principal_defect(general.topology, general.vertices)))
    with pytest.raises(InvalidStructure, match=rf"not principal.*rad.*vertex {worst} .*no motion"):
        general.flex(50)


def test_inexact_structures_are_refused_with_the_face():
    cones = alternating_cones(5, 12)
    bent = cones.vertices.copy()
    bent[20] += [0, 0, 1e-3]
    with pytest.raises(InvalidStructure, match=r"not exact: face \d+"):
        cones.with_vertices(bent).flex(50)


@pytest.mark.parametrize("percent", [-1, 201, np.nan, [0, 300], [], [[1, 2]]])
def test_percents_outside_the_motion_are_refused(percent):
    with pytest.raises(InvalidDesign, match="percent"):
        conical_vertex().flex(percent)


@pytest.mark.parametrize("percent, what", [(0, "lies flat"), (200, "folded flat")])
def test_the_ends_of_a_motion_cannot_be_flexed_any_more(percent, what):
    end = conical_vertex().flex(percent).structures[0]
    with pytest.raises(InvalidStructure, match=what):
        end.flex(50)


def test_pieces_are_refused():
    vertex = conical_vertex()
    two = PleatedStructure(Topology(18, np.concatenate([vertex.topology.quads, 9 + vertex.topology.quads])),
                           np.concatenate([vertex.vertices, 50 + vertex.vertices]))
    with pytest.raises(InvalidStructure, match="2 pieces"):
        two.flex(50)

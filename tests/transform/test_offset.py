"""Offsets have constant face-face distance, parallel edges and the same cone axes, by recomputation from coordinates."""

import re

import numpy as np
import pytest

from plisse.assess import assess
from plisse.errors import InvalidDesign, InvalidStructure
from plisse.structure.exact import alternating_cones, conic_creases, conical_vertex, marched, miura
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.offset import offset_range

STRUCTURES = {"cones": alternating_cones(), "closed cones": alternating_cones(closed=True), "miura": miura(),
              "conics": conic_creases(), "vertex": conical_vertex()}


def with_a_corner_missing():
    """Cones without the first quad: a boundary vertex with three faces."""
    whole = alternating_cones()
    mask = np.ones((5, 23), bool)
    mask[0, 0] = False
    return PleatedStructure(Topology(143, grid(6, 24, mask=mask).quads - 1), whole.vertices[1:])


def planes(structure):
    """Unit normal and origin of every quad, by singular values, on the side to which the quad is oriented."""
    points = structure.vertices[structure.topology.quads]
    origin = points.mean(axis=1)
    normal = np.linalg.svd(points - origin[:, None])[2][:, 2]
    turn = np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0])
    return normal * np.sign((normal * turn).sum(axis=1))[:, None], origin


def edge_vectors(structure):
    start, end = structure.topology.edges.vertices.T
    return structure.vertices[end] - structure.vertices[start]


@pytest.mark.parametrize("distance", [0.03, -0.03])
@pytest.mark.parametrize("name", STRUCTURES)
def test_faces_are_parallel_at_the_distance_asked_for(name, distance):
    structure = STRUCTURES[name]
    moved = structure.offset(distance)
    (normal, origin), (moved_normal, moved_origin) = planes(structure), planes(moved)
    assert np.linalg.norm(normal - moved_normal, axis=1).max() < 1e-11
    heights = ((moved_origin - origin) * normal).sum(axis=1)
    assert np.abs(heights - distance).max() < 1e-11 * abs(distance) + 1e-14


@pytest.mark.parametrize("distance", [0.03, -0.03])
@pytest.mark.parametrize("name", STRUCTURES)
def test_every_edge_is_parallel_to_its_original_and_keeps_its_sense(name, distance):
    before, after = edge_vectors(STRUCTURES[name]), edge_vectors(STRUCTURES[name].offset(distance))
    scale = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    assert (np.linalg.norm(np.cross(before, after), axis=1) / scale).max() < 1e-11
    assert ((before * after).sum(axis=1) > 0).all()


@pytest.mark.parametrize("name", STRUCTURES)
def test_inner_vertices_move_along_their_cone_axes_which_stay(name):
    structure = STRUCTURES[name]
    moved = structure.offset(0.03)
    corners, inner = structure.topology.corners, np.flatnonzero(~structure.topology.is_boundary)
    for vertex in inner[:: max(1, len(inner) // 12)]:
        faces = corners.face[corners.vertex == vertex]
        axes = []
        for state in (structure, moved):
            normals = planes(state)[0][faces]
            # the axis makes one angle with all normals: it is orthogonal to their differences
            axes.append(np.linalg.svd(normals[1:] - normals[0])[2][2])
        step = moved.vertices[vertex] - structure.vertices[vertex]
        assert np.linalg.norm(np.cross(*axes)) < 1e-10
        assert np.linalg.norm(np.cross(axes[0], step)) < 1e-10 * np.linalg.norm(step)


@pytest.mark.parametrize("name", STRUCTURES)
def test_an_offset_is_an_exact_principal_structure_with_a_development(name):
    report = assess(STRUCTURES[name].offset(-0.02), principal=True)
    assert report.status == "exact", report.reasons
    assert report.principal
    assert report.isometry < 1e-12


def test_alternating_cones_are_only_lifted():
    slope, step = 0.8, 2.0 / 23
    lift = 0.4 * np.hypot(1, slope / np.cos(step / 2))
    moved = alternating_cones(slope=slope, sector=2.0).offset(0.4)
    difference = moved.vertices - alternating_cones(slope=slope, sector=2.0).vertices
    assert np.abs(difference[:, :2]).max() < 1e-11
    assert np.abs(np.abs(difference[:, 2]) - lift).max() < 1e-11
    assert offset_range(alternating_cones()) == (-np.inf, np.inf)


def test_offsets_add_up():
    once = STRUCTURES["conics"].offset(0.05)
    twice = STRUCTURES["conics"].offset(0.02).offset(0.03)
    inner = ~once.topology.is_boundary
    assert np.abs(once.vertices - twice.vertices)[inner].max() < 1e-10


def test_where_three_faces_meet_on_the_boundary_their_distance_is_kept_too():
    structure = with_a_corner_missing()
    moved = structure.offset(0.1)
    normal, origin = planes(structure)
    assert np.abs(((planes(moved)[1] - origin) * normal).sum(axis=1) - 0.1).max() < 1e-12


@pytest.mark.parametrize("side", [0, 1])
def test_the_limit_is_sharp_and_the_number_in_the_sentence_works(side):
    structure = STRUCTURES["conics"]
    limit = offset_range(structure)[side]
    shrunk = structure.offset(limit * (1 - 1e-7))
    lengths = np.linalg.norm(edge_vectors(shrunk), axis=1)
    assert 0 < lengths.min() < 1e-6 * lengths.max()
    with pytest.raises(InvalidDesign, match="largest possible distance on that side is") as caught:
        structure.offset(limit * (1 + 1e-7))
    named = float(re.search(r"is (-?[\d.]+)$", str(caught.value))[1])
    assert abs(named) <= abs(limit)
    assert named == pytest.approx(limit, rel=1e-4)
    structure.offset(named)


def test_structures_that_are_not_principal_are_refused_with_vertex_and_defect():
    with pytest.raises(InvalidStructure, match=r"opposite angles miss π by .* at vertex \d+ .*no offset"):
        marched().offset(0.1)


def test_what_is_folded_flat_has_no_offset():
    folded = conical_vertex().flex(200).structures[0]
    with pytest.raises(InvalidStructure, match="folded flat"):
        folded.offset(0.01)


def test_a_distance_must_be_a_number():
    with pytest.raises(InvalidDesign, match="finite"):
        miura().offset(np.nan)

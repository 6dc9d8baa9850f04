"""What is on screen is the structure: its points, its faces, its folds, its values."""

import numpy as np
import pytest
from scipy.spatial import cKDTree

from plisse.draw.colour_maps import colour_maps
from plisse.draw.dashes import SHARE
from plisse.geometry.vectors import norm, unit
from plisse.measure.folds import assignments
from plisse.measure.planarity import face_areas, face_normals
from plisse.structure.place import place_of, vertex_named
from plisse.studio.picking import first_hit
from plisse.studio.view import flat_view, folded_view, tinted


def area(view):
    a, b, c = (view.points[view.triangles[:, k]].astype(float) for k in range(3))
    return 0.5 * norm(np.cross(b - a, c - a)).sum()


@pytest.fixture(params=["cones", "closed_cones"])
def structure(request):
    return request.getfixturevalue(request.param)


def test_points_and_area_are_those_of_the_structure(structure):
    view = folded_view(structure)
    assert np.array_equal(np.unique(view.points, axis=0), np.unique(structure.vertices.astype(np.float32), axis=0))
    assert area(view) == pytest.approx(face_areas(structure.topology, structure.vertices).sum(), rel=1e-5)  # float32


def test_triangles_face_where_faces_do(structure):
    view = folded_view(structure)
    a, b, c = (view.points[view.triangles[:, k]].astype(float) for k in range(3))
    normals = face_normals(structure.topology, structure.vertices).repeat(2, axis=0)
    quads = len(structure.topology.quads)
    found = unit(np.cross(b - a, c - a))
    first, second = found[:quads], found[quads:]
    assert np.einsum("ij,ij->i", first, normals[::2]).min() > 0.99
    assert np.einsum("ij,ij->i", second, normals[::2]).min() > 0.99


def test_paper_is_doubled_along_creases_and_not_along_rulings(structure):
    topology = structure.topology
    inner = np.setdiff1d(np.unique(topology.edges.vertices[topology.edges.is_crease & ~topology.edges.is_boundary]), [])
    assert len(folded_view(structure).points) == topology.vertex_count + len(inner)


def lengths(lines):
    return norm(lines[:, 1] - lines[:, 0]).sum()


def test_mountains_are_whole_and_valleys_in_dashes_on_both_sides_of_the_paper(structure):
    letters = assignments(structure.topology, structure.vertices)
    edges, lines = structure.topology.edges, folded_view(structure).lines
    ends = structure.vertices[edges.vertices]
    mountain, valley = (ends[edges.is_crease & (letters == letter)] for letter in "MV")
    assert lengths(lines["mountain"]) == pytest.approx(2 * lengths(mountain), rel=0.1)  # beside the fold
    assert lengths(lines["valley"]) == pytest.approx(2 * SHARE * lengths(valley), rel=0.1)
    assert lengths(lines["boundary"]) == pytest.approx(lengths(ends[edges.is_boundary]), rel=0.001)
    assert len(lines["ruling"]) == (~edges.is_crease & ~edges.is_boundary).sum()


def test_lines_lie_near_their_creases_in_the_grooves(structure):
    """Nearer than a fifth of a strip's width, in front of the paper in valleys and behind it at mountains."""
    topology, letters = structure.topology, assignments(structure.topology, structure.vertices)
    mountain = topology.edges.vertices[topology.edges.is_crease & (letters == "M")]
    places = cKDTree(structure.vertices[np.unique(mountain)])
    across = topology.edges.vertices[~topology.edges.is_crease]
    width = np.median(norm(structure.vertices[across[:, 1]] - structure.vertices[across[:, 0]]))
    ridge, groove = np.split(folded_view(structure).lines["mountain"], 2)
    assert places.query(ridge.reshape(-1, 3))[0].max() < 0.02 * width
    assert 0.02 * width < places.query(groove.reshape(-1, 3))[0].max() < 0.2 * width


def test_the_sheet_has_the_same_area_and_the_same_folds(structure):
    flat, folded = flat_view(structure), folded_view(structure)
    assert np.ptp(flat.points[:, 2]) == 0
    assert area(flat) == pytest.approx(area(folded), rel=1e-5)  # float32
    for name, sides in (("mountain", 2), ("valley", 2), ("boundary", 1)):
        assert sides * lengths(flat.lines[name]) == pytest.approx(lengths(folded.lines[name]), rel=0.1)  # beside the fold


def test_colours_are_those_of_the_map(structure):
    colour = colour_maps(structure)["opening"]
    tint = tinted(structure, colour)
    shown = tint.bar[np.round(tint.shares * (len(tint.bar) - 1)).astype(int)] / 255
    assert np.abs(shown - colour.colours(colour.values)).max() < 0.02  # 128 shades
    assert np.array_equal(tint.points, structure.vertices[structure.topology.corners.vertex].astype(np.float32))


def test_a_place_in_words_leads_back_to_its_vertex(structure):
    topology = structure.topology
    for vertex in range(0, topology.vertex_count, 7):
        assert vertex_named(topology, f"faces are slivers at {place_of(topology, vertex)}; lower it") == vertex
    assert vertex_named(topology, "no place at all") is None
    assert vertex_named(topology, "crease 99 near 5 % of its length") is None
    assert vertex_named(topology, f"vertex {topology.vertex_count}") is None


def test_a_ray_meets_the_nearest_triangle():
    points = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 5], [2, 0, 5], [0, 2, 5]], float)
    triangles = np.array([[0, 1, 2], [3, 4, 5]])
    down = np.array([0.0, 0.0, -1.0])
    assert first_hit(points, triangles, np.array([0.5, 0.5, 9.0]), down).tolist() == [0.5, 0.5, 5.0]
    assert first_hit(points, triangles, np.array([0.5, 0.5, 4.0]), down).tolist() == [0.5, 0.5, 0.0]
    assert first_hit(points, triangles, np.array([3.0, 3.0, 4.0]), down) is None

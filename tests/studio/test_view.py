"""What is on screen is the structure: its points, its faces, its folds, its values."""

import numpy as np
import pytest

from plisse.draw.colour_maps import colour_maps
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


def test_lines_are_the_edges_of_their_letter(structure):
    letters = assignments(structure.topology, structure.vertices)
    edges, lines = structure.topology.edges, folded_view(structure).lines
    assert len(lines["mountain"]) == (edges.is_crease & (letters == "M")).sum()
    assert len(lines["valley"]) == (edges.is_crease & (letters == "V")).sum()
    assert sum(map(len, lines.values())) == len(edges.vertices)


def test_the_sheet_has_the_same_area_and_the_same_folds(structure):
    flat, folded = flat_view(structure), folded_view(structure)
    assert np.ptp(flat.points[:, 2]) == 0
    assert area(flat) == pytest.approx(area(folded), rel=1e-5)  # float32
    for name in ("mountain", "valley"):
        lengths = [norm(view.lines[name][:, 1] - view.lines[name][:, 0]).sum() for view in (flat, folded)]
        assert lengths[0] == pytest.approx(lengths[1], rel=1e-5)  # float32


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

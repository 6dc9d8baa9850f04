"""Connectivity: counts, stars, polylines, cuts, hubs and the sentences for broken meshes."""

import numpy as np
import pytest

from plisse.errors import InvalidStructure
from plisse.structure.chains import boundary_loops
from plisse.structure.cut import cut_along, uncut
from plisse.structure.grid import grid
from plisse.structure.topology import Polyline, Topology, _sorted

GRIDS = {
    "open": (grid(5, 7), 5 * 7, 4 * 6, 1),
    "closed creases": (grid(5, 7, closed_creases=True), 5 * 7, 4 * 7, 0),
    "closed family": (grid(6, 7, closed_family=True), 6 * 7, 6 * 6, 0),
    "torus": (grid(6, 7, closed_creases=True, closed_family=True), 6 * 7, 6 * 7, 0),
}


def hub(sectors=3):
    """A planar 2K-gon with one quad on every side and quads between those: every hub vertex is 4-valent.

    Hub vertices are 0 … 2K−1; vertex i has three outer ones: beside edge i−1, apart, beside edge i.
    """
    count = 2 * sectors
    inner = np.arange(count)
    following = (inner + 1) % count
    before, apart, after = count + 3 * inner, count + 3 * inner + 1, count + 3 * inner + 2
    # the hub's edges are crease, ruling, crease …; a quad beyond one begins with a crease edge
    beyond = np.stack([following, inner, after, before[following]], axis=1)
    beyond[1::2] = np.roll(beyond[1::2], -1, axis=1)
    between = np.stack([inner, before, apart, after], axis=1)
    between[1::2] = np.roll(between[1::2], -1, axis=1)
    return Topology(4 * count, np.concatenate([beyond, between]), (inner,))


@pytest.mark.parametrize("name", GRIDS)
def test_grids_have_the_counts_of_figure_21(name):
    topology, vertices, faces, euler = GRIDS[name]
    assert topology.vertex_count == vertices
    assert topology.face_count == faces
    assert topology.euler_characteristic == euler
    assert topology.components == 1


@pytest.mark.parametrize("name", GRIDS)
def test_every_edge_has_its_faces(name):
    topology = GRIDS[name][0]
    edges = topology.edges
    count = np.bincount(topology.corners.face, minlength=topology.face_count)
    inner = ~edges.is_boundary
    assert count.sum() == len(edges.vertices) + inner.sum()
    for (a, b), (first, second) in zip(edges.vertices, edges.faces, strict=True):
        for face in {first, second} - {-1}:
            assert {a, b} <= set(topology.faces[face])


@pytest.mark.parametrize("name", GRIDS)
def test_stars_begin_on_a_crease_and_alternate(name):
    topology = GRIDS[name][0]
    creases = {frozenset(pair) for pair in topology.edges.vertices[topology.edges.is_crease].tolist()}
    stars = topology.stars[4]
    assert len(stars) == (~topology.is_boundary).sum()
    for centre, *ring in stars.tolist():
        assert [frozenset((centre, v)) in creases for v in ring] == [True, False, True, False]
        assert len(set(ring)) == 4


def test_corners_of_stars_lie_between_their_spokes():
    topology = grid(4, 5)
    stars, walk = topology.stars[4], topology.star_corners[4]
    corners = topology.corners
    for k in range(4):
        np.testing.assert_array_equal(corners.vertex[walk[:, k]], stars[:, 0])
        np.testing.assert_array_equal(corners.next[walk[:, k]], stars[:, 1 + k])
        np.testing.assert_array_equal(corners.previous[walk[:, k]], stars[:, 1 + (k + 1) % 4])


@pytest.mark.parametrize(("name", "creases", "closed", "rulings", "rings"), [
    ("open", 5, False, 7, False),
    ("closed creases", 5, True, 7, False),
    ("closed family", 6, False, 7, True),
    ("torus", 6, True, 7, True),
])
def test_polylines_run_along_and_across(name, creases, closed, rulings, rings):
    topology = GRIDS[name][0]
    assert len(topology.creases) == creases
    assert len(topology.rulings) == rulings
    assert {line.closed for line in topology.creases} == {closed}
    assert {line.closed for line in topology.rulings} == {rings}
    columns = 7
    for level, line in enumerate(topology.creases):
        assert set(line.vertices // columns) == {level}
    for column, line in enumerate(topology.rulings):
        assert set(line.vertices % columns) == {column}


@pytest.mark.parametrize(("name", "loops"),
                         [("open", 1), ("closed creases", 2), ("closed family", 2), ("torus", 0)])
def test_boundary_loops_bound_the_surface(name, loops):
    topology = GRIDS[name][0]
    found = boundary_loops(topology)
    assert len(found) == loops
    assert sum(len(loop) for loop in found) == topology.edges.is_boundary.sum()


def test_closed_grids_are_narrow_in_their_ordering():
    for topology in (grid(8, 200), grid(8, 200, closed_creases=True), grid(200, 8, closed_family=True)):
        rank = np.argsort(np.argsort(topology.ordering))
        reach = np.abs(np.diff(rank[topology.quads], axis=1)).max()
        assert reach < 3 * 8


def test_cut_opens_closed_creases_into_a_disk():
    topology = grid(5, 7, closed_creases=True)
    cut = cut_along(topology, topology.rulings[2])
    assert cut.topology.euler_characteristic == 1
    assert cut.topology.vertex_count == 35 + 5
    np.testing.assert_array_equal(cut.source[:35], np.arange(35))
    assert set(cut.source[35:]) == set(topology.rulings[2].vertices)
    assert not cut.is_trivial


def test_cut_keeps_faces_and_labels():
    topology = grid(5, 7, closed_creases=True)
    cut = cut_along(topology, topology.rulings[0])
    np.testing.assert_array_equal(cut.source[cut.topology.quads], topology.quads)
    severed = cut.topology.edges.is_boundary.sum() - topology.edges.is_boundary.sum()
    assert severed == 2 * 4


def test_cut_along_a_crease_opens_a_closed_family():
    topology = grid(6, 7, closed_family=True)
    cut = cut_along(topology, topology.creases[3])
    assert cut.topology.euler_characteristic == 1
    assert len(cut.source) == 42 + 7


def test_two_cuts_open_a_torus():
    topology = grid(6, 7, closed_creases=True, closed_family=True)
    cut = cut_along(topology, topology.creases[0], topology.rulings[0])
    assert cut.topology.euler_characteristic == 1
    assert np.bincount(cut.source).max() == 4


def test_cutting_a_disk_across_gives_two_pieces():
    topology = grid(5, 7)
    assert cut_along(topology, topology.rulings[3]).topology.components == 2


def test_a_slit_that_ends_inside_does_not_double_its_end():
    topology = grid(5, 7)
    slit = Polyline(topology.rulings[3].vertices[:3])
    cut = cut_along(topology, slit)
    assert cut.topology.components == 1
    assert set(cut.source[35:]) == set(slit.vertices[:2])


def test_nothing_is_cut_by_default():
    topology = grid(3, 3)
    assert uncut(topology).is_trivial
    assert uncut(topology).topology is topology


def test_masked_grid_loses_quads_but_no_numbers():
    mask = np.ones((4, 6), bool)
    mask[1:3, 2:4] = False
    topology = grid(5, 7, mask=mask)
    assert topology.face_count == 24 - 4
    assert topology.vertex_count == 35
    assert topology.euler_characteristic == 0
    assert sorted(len(loop) for loop in boundary_loops(topology)) == [8, 20]
    assert topology.is_boundary[2 * 7 + 3]


def test_hub_is_a_polygon_among_quads():
    topology = hub()
    assert topology.face_count == 1 + 6 + 6
    assert topology.euler_characteristic == 1
    assert [len(face) for face in topology.faces[-1:]] == [6]
    assert set(topology.stars) == {4}
    np.testing.assert_array_equal(np.sort(topology.stars[4][:, 0]), np.arange(6))
    assert len(topology.tetrahedra) == 12 + 3
    assert len(topology.rods) == len(topology.edges.vertices) + 2 * 12 + 9


def test_edges_of_a_hub_are_crease_and_ruling_in_turn():
    topology = hub(4)
    on_hub = (topology.edges.vertices < 8).all(axis=1)
    labels = {frozenset(pair): crease for pair, crease in
              zip(topology.edges.vertices[on_hub].tolist(), topology.edges.is_crease[on_hub], strict=True)}
    assert [labels[frozenset((i, (i + 1) % 8))] for i in range(8)] == 4 * [True, False]


def test_three_faces_in_an_edge_are_refused():
    book = Topology(8, np.array([[0, 1, 2, 3], [1, 0, 4, 5], [0, 1, 6, 7]]))
    with pytest.raises(InvalidStructure, match="3 faces meet in the edge between vertices 0 and 1"):
        _ = book.edges


def test_differently_oriented_faces_are_refused():
    with pytest.raises(InvalidStructure, match="oriented differently"):
        _ = Topology(6, np.array([[0, 1, 2, 3], [0, 1, 4, 5]])).edges


def test_edges_with_two_labels_are_refused():
    with pytest.raises(InvalidStructure, match="crease in one face and a ruling in the other"):
        _ = Topology(6, np.array([[0, 1, 2, 3], [5, 1, 0, 4]])).edges


def test_fans_that_touch_in_a_vertex_have_a_boundary_there():
    corner = Topology(7, np.array([[0, 1, 2, 3], [0, 4, 5, 6]]))
    assert corner.is_boundary.all()
    assert corner.components == 2


@pytest.mark.parametrize(("arguments", "sentence"), [
    ({"creases": 1, "columns": 5}, "too small"),
    ({"creases": 3, "columns": 1}, "too small"),
    ({"creases": 3, "columns": 2, "closed_creases": True}, "too small"),
    ({"creases": 5, "columns": 5, "closed_family": True}, "even number of creases"),
    ({"creases": 3, "columns": 4, "mask": np.ones((3, 3), bool)}, "2 × 3 quads"),
    ({"creases": 3, "columns": 4, "mask": np.zeros((2, 3), bool)}, "at least one face"),
])
def test_impossible_grids_are_refused(arguments, sentence):
    with pytest.raises(InvalidStructure, match=sentence):
        grid(**arguments)


def test_indices_out_of_range_are_refused():
    with pytest.raises(InvalidStructure, match="face indices run from 0 to 4, but there are 4 vertices"):
        Topology(4, np.array([[0, 1, 2, 4]]))


def test_keys_are_sorted_alike_where_their_places_do_not_fit_beside_them():
    keys = np.array([7, 3, 7, 0, 3, 5])
    for limit in (8, 2**62):
        found, places = _sorted(keys, limit)
        assert found.tolist() == [0, 3, 3, 5, 7, 7]
        assert places.tolist() == [3, 1, 4, 5, 0, 2]

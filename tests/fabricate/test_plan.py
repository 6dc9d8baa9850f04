"""Sheets of developments that overlap: disjoint, complete, numbered, and they go together again."""

import sys
from itertools import pairwise

import numpy as np
import pytest
import shapely

from plisse.errors import Infeasible, InvalidStructure, MissingExtra, PlisseError
from plisse.fabricate import sheets
from plisse.fabricate.pieces import _outline, _without_islands
from plisse.fabricate.tabs import Tab
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure

FIGURES = ["fig19", "fig27"]


def reassembled(plan):
    """Every piece put where its numbers say, starting from the first: points (V', 2) per piece, placed one by one."""
    points, done = plan.paper.points, {0: (np.eye(2), np.zeros(2))}
    on_sheet = [placement.apply(points) for placement in plan.placements]
    open_joints = [joint for joint in plan.joints if not joint.closes]
    while len(done) < len(plan.pieces):
        joint = next(j for j in open_joints if (j.pieces[0] in done) != (j.pieces[1] in done))
        known, new = joint.pieces if joint.pieces[0] in done else joint.pieces[::-1]
        known_path, new_path = (joint.left, joint.right) if joint.pieces[0] == known else (joint.right, joint.left)
        turn, shift = done[known]
        target, source = on_sheet[known][known_path] @ turn + shift, on_sheet[new][new_path]
        u, _, vt = np.linalg.svd((source - source.mean(0)).T @ (target - target.mean(0)))
        rotation = u @ np.diag([1, np.sign(np.linalg.det(u @ vt))]) @ vt
        done[new] = rotation, target.mean(0) - source.mean(0) @ rotation
    return [on_sheet[k] @ done[k][0] + done[k][1] for k in range(len(plan.pieces))]


def used(plan, piece):
    """Vertices of a piece."""
    return np.unique([v for face in np.flatnonzero(piece.faces) for v in plan.paper.topology.faces[face]])


@pytest.mark.parametrize("figure", FIGURES)
def test_pieces_are_the_whole_development_and_none_covers_a_place_twice(plans, figure):
    plan = plans[figure]
    assert np.array_equal(sum(piece.faces.astype(int) for piece in plan.pieces), np.ones(plan.paper.topology.face_count))
    bare = [plan.paper.polygon(piece.faces) for piece in plan.pieces]
    assert all(polygon.is_valid for polygon in bare)
    whole = sum(shapely.Polygon(plan.paper.points[face]).area for face in plan.paper.topology.faces)
    assert sum(polygon.area for polygon in bare) == pytest.approx(whole, rel=1e-9)
    assert sum(piece.area for piece in plan.pieces) == pytest.approx(whole, rel=1e-9)


@pytest.mark.parametrize("figure", FIGURES)
def test_outlines_lie_inside_the_sheet_and_apart_from_each_other(plans, figure):
    plan = plans[figure]
    room = shapely.box(5, 5, 595, 295).buffer(1e-9, join_style="mitre")
    for number in range(plan.count):
        placed = [shapely.transform(piece.outline, placement.apply) for piece, placement in plan.on_sheet(number)]
        assert placed and all(room.contains(outline) for outline in placed)
        assert all(one.distance(other) >= 2.0 for k, one in enumerate(placed) for other in placed[:k])


@pytest.mark.parametrize("figure", FIGURES)
def test_every_cut_edge_is_numbered_once_on_either_side(plans, figure):
    plan = plans[figure]
    numbered = [path for joint in plan.joints for side in (0, 1) for path in joint.edges(side)]
    edges = sorted(tuple(sorted(map(int, pair))) for path in numbered for pair in pairwise(path))
    topology, piece = plan.paper.topology, np.zeros(plan.paper.topology.face_count, int)
    for one in plan.pieces:
        piece[one.faces] = one.number
    faces = topology.edges.faces
    between = ~topology.edges.is_boundary & (piece[faces[:, 0]] != piece[faces[:, 1]])
    wanted = [*topology.edges.vertices[between]] * 2 + [*topology.edges.vertices[plan.paper.severed]]
    assert edges == sorted(tuple(sorted(map(int, pair))) for pair in wanted)
    labels = [label for joint in plan.joints for label in joint.labels]
    assert len(set(labels)) == len(labels) == plan.edge_count


@pytest.mark.parametrize("figure", FIGURES)
def test_joined_by_their_numbers_the_pieces_are_the_development_again(plans, figure):
    plan = plans[figure]
    points = plan.paper.points
    back = reassembled(plan)
    first = used(plan, plan.pieces[0])
    source, target = back[0][first], points[first]
    z, w = (p @ [1, 1j] - (p @ [1, 1j]).mean() for p in (source, target))
    turn = np.vdot(z, w) / abs(np.vdot(z, w))
    for piece, placed in zip(plan.pieces, back, strict=True):
        own = used(plan, piece)
        moved = turn * (placed[own] @ [1, 1j] - (source @ [1, 1j]).mean()) + (target @ [1, 1j]).mean()
        assert np.abs(moved - points[own] @ [1, 1j]).max() < 1e-9


def test_the_two_sides_of_a_closing_joint_are_congruent(plans):
    closing = [joint for joint in plans["fig19"].joints if joint.closes]
    assert closing and not any(joint.closes for joint in plans["fig27"].joints)
    for joint in closing:
        one, other = (np.linalg.norm(np.diff(plans["fig19"].paper.points[path], axis=0), axis=1)
                      for path in (joint.left, joint.right))
        assert np.abs(one - other).max() < 1e-9
        assert np.array_equal(plans["fig19"].paper.source[joint.left], plans["fig19"].paper.source[joint.right])


@pytest.mark.parametrize("figure", FIGURES)
def test_flaps_lie_beyond_their_edges_and_touch_neither_piece_nor_each_other(plans, figure):
    plan = plans[figure]
    assert sum(len(piece.tabs) for piece in plan.pieces) == plan.edge_count
    for piece in plan.pieces:
        bare = plan.paper.polygon(piece.faces)
        flaps = [shapely.Polygon(tab.points) for tab in piece.tabs]
        for k, flap in enumerate(flaps):
            assert flap.intersection(bare).area < 0.03 * flap.length  # the 0.02 mm by which it reaches in
            assert not any(flap.intersects(other) for other in flaps[:k])
        assert piece.outline.area == pytest.approx(bare.area + sum(flap.difference(bare).area for flap in flaps), rel=1e-9)


def test_a_development_that_fits_stays_in_one_piece(cones):
    plan = sheets(cones, material=(600.0, 400.0))
    assert len(plan.pieces) == plan.count == 1 and not plan.joints and not plan.notes


def test_smaller_material_means_more_pieces_that_all_fit_and_go_together(cones):
    counts = []
    for side in (300.0, 150.0, 60.0):
        plan = sheets(cones, material=(side, side), joint="edges")
        counts.append(len(plan.pieces))
        back = reassembled(plan)
        for joint in plan.joints:
            one, other = back[joint.pieces[0]][joint.left], back[joint.pieces[1]][joint.right]
            assert np.abs(one - other).max() < 1e-9
    assert counts == sorted(counts) and counts[0] < counts[-1]


def test_bands_too_long_for_the_material_are_cut_along_creases_and_their_edges_say_so(cones):
    whole, narrow = sheets(cones, material=(150.0, 150.0)), sheets(cones, material=(60.0, 60.0))
    assert not any(joint.on_crease for joint in whole.joints)
    assert any(joint.on_crease for joint in narrow.joints)


@pytest.mark.parametrize("side", [600.0, 110.0])
def test_holes_and_notches_of_masked_grids_are_cut_out_too(cones, side):
    kept = np.ones((6, 24), bool)
    kept[2:4, 8:12] = kept[0, :5] = kept[5, 15:] = False
    topology = grid(7, 25, mask=kept)
    masked = PleatedStructure(topology, cones.vertices, development=cones.development)
    plan = sheets(masked, material=(side, side))
    bare = [plan.paper.polygon(piece.faces) for piece in plan.pieces]
    assert all(polygon.is_valid for polygon in bare)
    whole = sum(shapely.Polygon(plan.paper.points[face]).area for face in topology.faces)
    assert sum(polygon.area for polygon in bare) == pytest.approx(whole, rel=1e-9)
    if side == 600.0:
        piece, = plan.pieces
        assert [len(piece.outline.interiors), len(piece.rings)] == [1, 2]
    else:
        assert len(plan.pieces) > 2
        back = reassembled(plan)
        for joint in plan.joints:
            assert np.abs(back[joint.pieces[0]][joint.left] - back[joint.pieces[1]][joint.right]).max() < 1e-9


def test_kerf_grows_outlines_by_half_of_it_and_nothing_else(cones):
    plain, grown = (sheets(cones, material=(600.0, 400.0), kerf=kerf) for kerf in (0.0, 0.4))
    piece, cut = plain.pieces[0].outline, grown.pieces[0].outline
    assert cut.buffer(-0.2, join_style="mitre").symmetric_difference(piece).area < 1e-6 * piece.area
    assert shapely.hausdorff_distance(cut.exterior, piece.exterior) < 0.3  # at corners
    assert grown.pieces[0].area == plain.pieces[0].area
    assert np.array_equal(grown.paper.points, plain.paper.points)


def test_units_and_scale_set_the_size(cones):
    plain, scaled = sheets(cones, material=(4e3, 4e3)), sheets(cones, material=(4e3, 4e3), units="cm", scale=0.5)
    assert scaled.pieces[0].area == pytest.approx(25 * plain.pieces[0].area, rel=1e-12)


def test_the_method_of_a_structure_is_the_same(cones):
    assert cones.sheets(material=(300.0, 200.0)).edge_count == sheets(cones, material=(300.0, 200.0)).edge_count


@pytest.mark.parametrize(("options", "error", "words"), [
    ({"material": (10.0, 40.0)}, Infeasible, "smaller than its margins"),
    ({"material": (24.0, 24.0)}, Infeasible, "face .* alone"),
    ({"kerf": 90.0}, Infeasible, "kerf of 90 mm is wider than piece 1"),
    ({"kerf": 900.0}, Infeasible, "kerf of 900 mm is wider than any piece"),
    ({"kerf": -1.0}, PlisseError, "kerf is -1"),
    ({"scale": 0.0}, PlisseError, "scale is 0"),
    ({"joint": "glue"}, PlisseError, "tabs or edges"),
    ({"nesting": "best"}, PlisseError, "quick or dense"),
    ({"margin": float("nan")}, PlisseError, "margin is nan"),
    ({"units": "parsec"}, PlisseError, "units"),
])
def test_what_cannot_be_made_is_said_in_one_sentence(cones, options, error, words):
    with pytest.raises(error, match=words):
        sheets(cones, **options)


def test_developments_out_of_proportion_are_refused_before_hours_go_by(cones, monkeypatch):
    monkeypatch.setattr("plisse.fabricate.splitting.MOST", 3)
    with pytest.raises(Infeasible, match="at least 4 sheets"):
        sheets(cones, material=(80.0, 80.0))


def test_dense_nesting_without_its_library_says_what_to_install(cones, monkeypatch):
    monkeypatch.setitem(sys.modules, "spyrrow", None)
    with pytest.raises(MissingExtra, match=r"plisse\[nest\]"):
        sheets(cones, nesting="dense")


def test_without_development_there_is_nothing_to_cut(cones):
    with pytest.raises(InvalidStructure, match="flatten"):
        sheets(cones.with_vertices(cones.vertices))


@pytest.mark.parametrize("kerf", [0.1, 0.2, 0.5])
def test_every_piece_is_one_loop_to_cut_and_flaps_stay_apart_however_wide_the_kerf(cones, kerf):
    plan = sheets(cones, material=(110.0, 110.0), kerf=kerf)
    assert len(plan.joints) > 0 and sum(len(piece.rings) for piece in plan.pieces) == len(plan.pieces)
    flaps = [[shapely.Polygon(tab.points) for tab in piece.tabs] for piece in plan.pieces]
    assert all(one.distance(other) > kerf for some in flaps for k, one in enumerate(some) for other in some[:k])


@pytest.mark.slow
@pytest.mark.parametrize("kerf", [0.1, 0.5])
def test_flaps_of_a_winding_ring_do_not_fuse(ring, kerf):
    plan = sheets(ring, material=(600.0, 300.0), kerf=kerf)
    assert sum(len(piece.rings) for piece in plan.pieces) == len(plan.pieces)
    assert any("less than 6 mm" in note for note in plan.notes)


def test_flaps_that_close_around_a_hole_are_left_out():
    square = shapely.box(0, 0, 20, 20)
    hooks = [np.array([[2, 20], [3, 20], [3, 24], [9, 24], [9, 25], [2, 25]], float),
             np.array([[17, 20], [17, 25], [9.2, 25], [9.2, 24], [16, 24], [16, 20]], float)]
    tabs = tuple(Tab(str(k), 0, hook - [0, 0.02], 5.0) for k, hook in enumerate(hooks))
    outline = _outline(square, tabs, 0.5, 1)
    assert len(outline.interiors) == 1
    kept, outline = _without_islands(square, tabs, outline, 0.5, 1)
    assert kept == () and len(outline.interiors) == 0

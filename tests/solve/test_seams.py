"""Seams: a strongly curved surface in several sheets, each exact, all of them watertight in space and apart in the plane."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
import shapely

from plisse.geometry.graph import GraphSurface
from plisse.geometry.height_field import HeightField
from plisse.io.fold import read_fold, write_fold
from plisse.io.obj import read_obj, write_obj
from plisse.layout.automatic import Sizes, lay_out, starting_rows
from plisse.layout.coverage import AreaSamples, covered
from plisse.measure.mid_surface import MidSurfaceDeviation
from plisse.measure.overlap import development_overlap
from plisse.measure.sectors import angle_defect
from plisse.solve.candidate import FULL, Candidate
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.solve.masked import MaskedGrid, Trim, solve_masked
from plisse.solve.seams import even_columns, seam_counts, seam_defects, worst_columns
from plisse.solve.search import best_of, stages
from plisse.solve.whole_surface import whole_surface
from plisse.structure.grid import grid
from plisse.structure.masks import cleaned
from plisse.structure.parts import parts
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

EGG_CRATE = "12*cos(x/11)*cos(y/11)"
WIDTH = 5.0
FAR = np.array([-90.0, 70.0, 0.0])
TRIM = Trim(rounds=10, worst=0.004, least_opening=np.radians(15))


@pytest.fixture(scope="module")
def crate():
    """Layout over an egg crate, and samples of its area."""
    mesh = HeightField(EGG_CRATE, (-28.0, 28.0), (-28.0, 28.0)).mesh(50)
    surface = GraphSurface(mesh)
    samples = AreaSamples.of(mesh.vertices, mesh.triangles)
    rows = starting_rows(mesh, surface, surface.to_plane(FAR[None])[0, :2], WIDTH)
    return mesh, surface, samples, lay_out(rows, samples, surface, Sizes(WIDTH, 0.8 * WIDTH, curvature=0.0))


@pytest.fixture(scope="module")
def apart(crate):
    """The crate with four seams, laid flat."""
    _, _, _, layout = crate
    columns = even_columns(layout.mask, False, 4)
    found = solve_masked(layout.zigzag, layout.net.normals, layout.mask, False, TRIM, seams=columns)
    assert found.is_sound
    assert found.grid.seams == columns
    structure = PleatedStructure(found.grid.topology, found.vertices)
    return flatten(structure, best_cut(structure))


def angle(p, q):
    return np.arctan2(np.linalg.norm(np.cross(p, q)), p @ q)


def worst_angle_sum(vertices, quads):
    """Largest |Σω − 2π| over vertices whose quads form a ring, face by face in plain Python."""
    corners = {}
    for quad in quads.tolist():
        for k, vertex in enumerate(quad):
            before, after = quad[k - 1], quad[(k + 1) % 4]
            turn = angle(vertices[before] - vertices[vertex], vertices[after] - vertices[vertex])
            corners.setdefault(vertex, []).append((before, after, turn))
    rings = [ring for ring in corners.values() if {b for b, _, _ in ring} == {a for _, a, _ in ring}]
    return max(abs(sum(turn for _, _, turn in ring) - 2 * np.pi) for ring in rings)


def test_seams_cover_what_one_sheet_cannot(crate, apart):
    _, _, samples, layout = crate
    whole = solve_masked(layout.zigzag, layout.net.normals, layout.mask, False, TRIM)
    one, more = (covered(samples, vertices, topology.quads, 3 * WIDTH)
                 for vertices, topology in ((whole.vertices, whole.grid.topology), (apart.vertices, apart.topology)))
    assert one < 0.97
    assert more > 0.98


def test_every_sheet_is_exact_and_develops_isometrically_by_an_independent_count(apart):
    sheets = parts(apart.cut.topology)
    assert len(sheets) == 5
    for sheet in sheets:
        vertices, flat = apart.opened.vertices[sheet.vertices], apart.development[sheet.vertices]
        quads = sheet.topology.quads
        assert worst_angle_sum(vertices, quads) < 1e-12
        a, b, c, d = (vertices[column] for column in quads.T)
        normal = np.cross(c - a, d - b)
        assert np.abs(np.einsum("qi,qi->q", b - a, normal) / np.linalg.norm(normal, axis=1)).max() < 1e-12 * WIDTH
        for i, j in itertools.combinations(range(4), 2):
            folded, spread = (np.linalg.norm(points[quads[:, i]] - points[quads[:, j]], axis=1)
                              for points in (vertices, flat))
            np.testing.assert_allclose(spread, folded, rtol=0, atol=1e-11)
        assert sheet.topology.euler_characteristic == 1


def test_the_sheets_meet_in_space_and_angles_along_the_seams_do_not_sum_up(apart):
    topology, cut = apart.topology, apart.cut
    assert topology.components == 1
    assert len(apart.opened.vertices) - len(apart.vertices) >= len(np.unique(topology.seams))
    copies = [np.flatnonzero(cut.source == vertex) for vertex in np.unique(topology.seams)]
    assert min(len(some) for some in copies) == 2
    assert all((apart.opened.vertices[some] == apart.opened.vertices[some[0]]).all() for some in copies)
    assert np.degrees(seam_defects(topology, apart.vertices).max()) > 5
    assert np.abs(angle_defect(topology, apart.vertices)).max() < 1e-12
    assert np.abs(angle_defect(Topology(topology.vertex_count, topology.quads), apart.vertices)).max() > np.radians(5)


def test_the_sheets_lie_apart_in_the_plane(apart):
    outlines = [shapely.union_all(shapely.polygons(apart.development[sheet.vertices][sheet.topology.quads]))
                for sheet in parts(apart.cut.topology)]
    assert all(one.distance(other) > 0.5 * apart.mean_edge for one, other in itertools.combinations(outlines, 2))
    assert not development_overlap(apart.cut.topology, apart.development).overlaps
    onto_each_other = apart.development.copy()
    sheets = parts(apart.cut.topology)
    onto_each_other[sheets[1].vertices] += apart.development[sheets[0].vertices].mean(axis=0) \
        - apart.development[sheets[1].vertices].mean(axis=0)
    assert development_overlap(apart.cut.topology, onto_each_other).overlaps


@pytest.mark.parametrize(("write", "read"), [(write_fold, read_fold), (write_obj, read_obj)])
def test_files_keep_the_seams(apart, tmp_path, write, read):
    write(apart, tmp_path / "crate", title="seams")
    again = read(tmp_path / "crate")
    seams = {frozenset(map(tuple, apart.vertices[edge])) for edge in apart.topology.seams}
    assert {frozenset(map(tuple, again.vertices[edge])) for edge in again.topology.seams} == seams
    assert np.abs(angle_defect(again.topology, again.vertices)).max() < 1e-12
    assert again.topology.components == 1
    assert again.development is None or np.array_equal(again.development, apart.development)


@pytest.mark.slow
def test_the_search_takes_seams_only_where_they_are_allowed_and_help(crate):
    mesh, surface, _, _ = crate
    options = {"width": WIDTH, "centre": FAR}
    whole = whole_surface(mesh, surface, seams=0, **options)
    assert all(not candidate.seams for candidate in whole.candidates)
    parted = whole_surface(mesh, surface, seams=4, **options)
    assert 0 < len(parted.best.seams) <= 4
    assert parted.best.solved.is_sound
    assert parted.coverage > whole.coverage + 0.01
    assert any("cut the sheet apart" in note for note in parted.notes)
    assert np.degrees(parted.best.least_opening) >= 15


def test_seams_are_chosen_where_they_cover_more_and_unasked_only_where_they_cover_much_more(crate):
    _, _, _, layout = crate
    one, more = (Candidate(layout, solve_masked(layout.zigzag, layout.net.normals, layout.mask, False, TRIM, seams=columns),
                           1.0, MidSurfaceDeviation(np.zeros(1)), 0.5, 0.5) for columns in ((), (9, 18)))
    for lost, unasked, asked in ((0.0, one, one), (0.01, one, more), (0.2, more, more)):
        tried = [replace(one, coverage=FULL - lost), replace(more, coverage=FULL)]
        assert best_of(tried, None).seams == unasked.seams
        assert best_of(tried, 2).seams == asked.seams
    assert best_of([more], None) is more
    assert [stage for stage, _ in stages(iter(()), [], [], 0)] == ["scan", "refine"]


def test_a_surface_that_one_sheet_covers_stays_whole_whatever_is_allowed():
    mesh = HeightField("0.01*x*y", (-20.0, 20.0), (-20.0, 20.0)).mesh(30)
    found = whole_surface(mesh, GraphSurface(mesh), width=5.0, centre=FAR, seams=3)
    assert found.coverage > FULL
    assert found.best.seams == ()
    assert found.structure.topology.components == 1


@pytest.mark.parametrize("closed", [False, True])
def test_columns_are_inside_the_mask_well_apart_and_no_more_than_asked_for(closed):
    rng = np.random.default_rng(2)
    mask = np.ones((9, 40), bool)
    kept = mask & (rng.random(mask.shape) > 0.1)
    for count in range(1, 20):
        for columns in (even_columns(mask, closed, count), worst_columns(mask, kept, closed, count)):
            assert len(columns) <= count
            gaps = np.diff([*columns, columns[0] + 40] if closed else [0, *columns, 40])
            assert gaps.min() >= 3
    kept = mask.copy()
    kept[2:6, 21:23] = False
    assert worst_columns(mask, kept, closed, 1) == (22,)


def test_the_numbers_of_seams_rise_to_the_one_allowed():
    assert seam_counts(1) == [1]
    for most in range(1, 60):
        counts = seam_counts(most)
        assert counts == sorted(set(counts))
        assert counts[-1] == most


@pytest.mark.parametrize("closed", [False, True])
def test_a_seam_parts_the_topology_and_frees_its_vertices(closed):
    mask = np.ones((6, 12), bool)
    mask[2, 1] = False
    seams = (4, 8)
    part = MaskedGrid.of((7, 12 + (not closed)), closed, mask, seams)
    whole = grid(7, 12 + (not closed), closed_creases=closed, mask=mask)
    assert part.seams == seams
    assert part.topology.is_inner.sum() == Topology(whole.vertex_count, whole.quads).is_inner.sum() - 2 * 5
    flat = np.column_stack([*np.divmod(np.arange(whole.vertex_count), 12 + (not closed)), np.zeros(whole.vertex_count)])
    cut = best_cut(PleatedStructure(part.topology, flat[part.used]))
    sheets = parts(cut.topology)
    assert len(sheets) == (2 if closed else 3)
    assert all(sheet.topology.euler_characteristic == 1 for sheet in sheets)
    assert sum(len(sheet.faces) for sheet in sheets) == mask.sum()


def test_no_sheet_is_a_crumb():
    mask = np.zeros((8, 12), bool)
    mask[:, :6], mask[3:5, 6:8] = True, True
    assert cleaned(mask, False).sum() == 52
    assert cleaned(mask, False, (6,)).sum() == 48

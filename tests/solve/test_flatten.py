"""Developments: isometric, oriented, closed, without loss of digits on long strips."""

import numpy as np
import pytest
from shapely import Polygon

from plisse.geometry.vectors import cross_flat
from plisse.measure.isometry import isometry_defect
from plisse.measure.overlap import development_overlap
from plisse.solve import cutting
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten, unfold
from plisse.structure.chains import boundary_loops
from plisse.structure.cut import cut_along
from plisse.structure.grid import grid
from plisse.structure.pleated import PleatedStructure


def helical_cones(columns, turns):
    """Alternating cones over `turns` of a circle: exact, developing into a ring sector."""
    radius, height = 100.0 - 6.0 * np.arange(5), 8.0 * (np.arange(5) % 2)
    angle = np.linspace(0, 2 * np.pi * turns, columns)
    vertices = np.stack([np.outer(radius, np.cos(angle)), np.outer(radius, np.sin(angle)),
                         np.repeat(height[:, None], columns, axis=1)], axis=-1)
    return PleatedStructure(grid(5, columns), vertices.reshape(-1, 3))


def test_the_development_of_cones_is_the_ring_of_the_formula(cones):
    flat = flatten(PleatedStructure(cones.topology, cones.vertices)).development
    pairwise = np.linalg.norm(flat[:, None] - flat, axis=2)
    truth = np.linalg.norm(cones.development[:, None] - cones.development, axis=2)
    assert np.abs(pairwise - truth).max() < 1e-10 * truth.max()


def test_unfolding_two_thousand_columns_keeps_eleven_digits():
    structure = helical_cones(2000, 0.9)
    raw = unfold(structure.topology, structure.vertices)
    assert isometry_defect(structure.topology, structure.vertices, raw) < 1e-10
    done = flatten(structure)
    assert isometry_defect(structure.topology, structure.vertices, done.development) < 1e-12


def test_faces_are_counterclockwise_and_the_sheet_starts_at_the_origin(cones):
    flat = flatten(PleatedStructure(cones.topology, cones.vertices)).development
    a, b, c = (flat[cones.topology.quads[:, k]] for k in range(3))
    assert (cross_flat(b - a, c - b) > 0).all()
    assert np.allclose(flat.min(axis=0), 0, atol=1e-9)
    assert np.ptp(flat[:, 0]) >= np.ptp(flat[:, 1])


def test_a_mirrored_structure_has_the_mirrored_development(cones):
    from plisse.structure.topology import Topology

    flipped = Topology(cones.topology.vertex_count, cones.topology.quads[:, [1, 0, 3, 2]])
    one = flatten(PleatedStructure(cones.topology, cones.vertices)).development
    other = flatten(PleatedStructure(flipped, cones.vertices * [1, 1, -1])).development
    spans = [np.sort(np.linalg.norm(flat - flat.mean(axis=0), axis=1)) for flat in (one, other)]
    assert np.allclose(*spans, rtol=1e-10)


def test_overlaps_are_found_with_a_place_and_only_where_they_are():
    narrow, wide = flatten(helical_cones(300, 1.2)), flatten(helical_cones(300, 1.9))
    # cones of slope 6 : 10 develop into 0.6 of their angle
    assert not development_overlap(narrow.topology, narrow.development).overlaps
    found = development_overlap(wide.topology, wide.development)
    assert found.overlaps
    assert found.place is not None
    assert np.linalg.norm(wide.development - found.place, axis=1).min() < 10


def test_a_hole_is_no_overlap():
    mask = np.ones((4, 40), bool)
    mask[1, 10:14] = False
    structure = helical_cones(41, 0.5)
    holed = flatten(PleatedStructure(grid(5, 41, mask=mask), structure.vertices))
    assert not development_overlap(holed.topology, holed.development).overlaps


def test_a_closed_structure_is_cut_open_and_lies_flat(closed_cones):
    closed = PleatedStructure(closed_cones.topology, closed_cones.vertices)
    cut = best_cut(closed)
    done = flatten(closed, cut)
    assert cut.topology.euler_characteristic == 1
    assert isometry_defect(cut.topology, closed.vertices[cut.source], done.development) < 1e-12


def test_the_outlines_of_all_cuts_are_those_of_their_developments():
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    radius = 100.0 - 6.0 * np.arange(5)[:, None] * (1 + 0.2 * np.sin(angle))
    height = 8.0 * (np.arange(5) % 2)[:, None] + 0 * angle
    vertices = np.stack([radius * np.cos(angle), radius * np.sin(angle), height], axis=-1).reshape(-1, 3)
    ring = PleatedStructure(grid(5, 24, closed_creases=True), vertices)
    lines = [ring.topology.rulings[k] for k in (3, 11, 20)]
    for line, outline in zip(lines, cutting._outlines(ring, lines), strict=True):
        cut = cut_along(ring.topology, line)
        flat = unfold(cut.topology, ring.vertices[cut.source])[boundary_loops(cut.topology)[0]]
        # not developable: the sheet meets itself only nearly where it is continued
        for measure in (lambda ring: Polygon(ring).area, lambda ring: Polygon(ring).length):
            assert measure(outline) == pytest.approx(measure(flat), rel=0.02)


@pytest.mark.parametrize("percent", [0, 25, 75])
def test_the_cut_can_be_named_by_percent(closed_cones, percent):
    closed = PleatedStructure(closed_cones.topology, closed_cones.vertices)
    cut = best_cut(closed, percent)
    assert set(cut.source[closed.topology.vertex_count:] % 24) == {24 * percent // 100}


def test_a_tube_of_creases_is_cut_along_a_crease():
    topology = grid(6, 10, closed_family=True)
    around = np.linspace(0, 2 * np.pi, 6, endpoint=False)
    tube = np.stack([np.cos(around), np.sin(around)], axis=1) * (1 + 0.3 * (np.arange(6) % 2))[:, None]
    vertices = np.concatenate([np.repeat(tube, 10, axis=0), np.tile(np.arange(10.0), 6)[:, None]], axis=1)
    done = flatten(PleatedStructure(topology, vertices), best_cut(PleatedStructure(topology, vertices)))
    assert done.cut.topology.euler_characteristic == 1
    assert len(done.cut.source) == 70
    assert isometry_defect(done.cut.topology, done.opened.vertices, done.development) < 1e-12

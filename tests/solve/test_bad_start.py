"""The start of Fig. 25: why it is bad, and that it fails in both ways."""

from functools import cache

import numpy as np
import pytest

from plisse.errors import Infeasible
from plisse.geometry.graph import GraphSurface
from plisse.geometry.height_field import HeightField
from plisse.layout.automatic import Sizes, lay_out, starting_rows
from plisse.layout.coverage import AreaSamples
from plisse.layout.evolve import evolve
from plisse.layout.widths import strip_widths
from plisse.solve.bad_start import (
    BadStart,
    NormalStart,
    bisector_angles,
    bow,
    fail_both_ways,
    normal_start,
    normals_over,
    pattern_start,
    surface_start,
)
from plisse.solve.energies import Guides
from plisse.solve.masked import MaskedGrid
from plisse.solve.paper import solve_paper
from plisse.solve.zigzag import zigzag
from plisse.structure.grid import grid
from plisse.structure.masks import cleaned
from plisse.structure.pleated import PleatedStructure

AMPLITUDE = 0.5


def arches(creases=11, columns=29):
    """Evenly spaced parallel arches (m, n, 3) of a vault, nearly geodesics."""
    x, y = np.linspace(-18, 18, columns)[None], np.arange(creases)[:, None] - (creases - 1) / 2
    x, y = np.broadcast_arrays(x, y)
    return np.stack([x, y, -0.02 * x**2 - 0.006 * y**2], axis=-1)


@cache
def failed():
    curves = arches()
    return fail_both_ways(normal_start(curves, normals_over(curves), AMPLITUDE))


def circle_pattern(theta, spacing):
    """Pseudo-geodesics from a quarter circle with strips of width 5, for the amplitude 2."""
    turn = np.linspace(0, np.pi / 2, 60)
    seed = 100.0 * np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    inclination = np.full(7, theta)
    widths = strip_widths(5.0, inclination, 2.0, np.linspace(0, 1, 60), closed=False, spacing=spacing)
    return evolve(seed, inclination, widths)


def test_bisectors_of_a_zigzag_along_normals_of_geodesics_lie_in_the_osculating_planes():
    assert np.degrees(failed().angles).max() < 10


def test_bisectors_of_exact_folds_are_binormals(cones, closed_cones):
    for structure in (cones, closed_cones):
        np.testing.assert_allclose(np.degrees(bisector_angles(structure.topology, structure.vertices)), 90, atol=0.1)


def test_bisectors_of_a_zigzag_along_binormals_are_nearly_orthogonal_to_the_osculating_planes():
    theta = np.radians(40.0)
    good = zigzag(circle_pattern(theta, "mirror"), 2.0)
    bad = pattern_start(circle_pattern(theta, "uniform"), 2.0).structure
    assert np.degrees(bisector_angles(good.topology, good.vertices)).mean() > 80
    # moved along the surface normals instead, they lean by the inclination of the pattern
    assert np.degrees(bisector_angles(bad.topology, bad.vertices)).mean() == pytest.approx(50, abs=8)


def test_strong_fairness_comes_near_exactness_and_straightens_the_creases_off_the_surface():
    planarity, angle = failed().defects(failed().straightened)
    assert planarity < 1e-3
    assert angle < 1e-2
    before, after = failed().straightness
    assert after < 0.5 * before
    assert failed().departure(failed().straightened) > 1


def test_holding_the_creases_leaves_them_neither_planar_nor_developable():
    planarity, angle = failed().defects(failed().held)
    assert planarity > 3e-3
    assert angle > 0.02
    assert failed().departure(failed().held) < 0.3
    topology = failed().start.structure.topology
    assert bow(topology, failed().held.vertices) > 0.8 * failed().straightness[0]


def test_with_little_fairness_a_start_along_binormals_becomes_exact_near_its_surface_and_this_one_does_not():
    mesh = HeightField("-0.006 * x**2 - 0.002 * y**2", (-100, 100), (-70, 70)).mesh(40)
    surface, samples = GraphSurface(mesh), AreaSamples.of(mesh.vertices, mesh.triangles)
    sizes = Sizes(8.0, 4.0, limit=np.radians(80))
    rows = starting_rows(mesh, surface, surface.to_plane(np.array([[0.0, 250, 0]]))[0, :2], sizes.width)
    layout = lay_out(rows, samples, surface, sizes, grow=0)
    part = MaskedGrid.of(layout.zigzag.shape[:2], layout.net.closed, cleaned(layout.mask, layout.net.closed))
    good = NormalStart(PleatedStructure(part.topology, layout.zigzag.reshape(-1, 3)[part.used]),
                       layout.net.normals.reshape(-1, 3)[part.used], sizes.amplitude)
    angle = {}
    for name, start in (("good", good), ("bad", surface_start(surface, samples, rows, sizes))):
        topology, vertices = start.structure.topology, start.structure.vertices
        found = solve_paper(topology, vertices, Guides.along_creases(topology, vertices),
                            weights=(100, 1e-2, 1000, 1, 0), iterations=30)
        outcome = BadStart(start, bisector_angles(topology, vertices), found, found)
        angle[name] = outcome.defects(found)[1]
        if name == "good":
            before, after = outcome.straightness
            assert after > 0.9 * before
            assert outcome.departure(found) < 0.5
    assert angle["good"] < 1e-3
    assert angle["bad"] > 0.05


def test_the_diagnosis_is_one_sentence_with_the_numbers():
    said = failed().diagnosis
    assert f"{np.degrees(failed().angles).mean():.0f}° on average" in said
    assert f"{failed().departure(failed().straightened):.1f} amplitudes off" in said
    assert "folds need 90°" in said
    assert 'initial = "normal"' in said
    assert not said.endswith(".")


def test_a_surface_gives_a_start_with_evenly_spaced_rows_where_they_meet_it():
    mesh = HeightField("-0.01 * (x**2 + y**2)", (-20, 20), (-16, 16)).mesh(24)
    surface = GraphSurface(mesh)
    samples = AreaSamples.of(mesh.vertices, mesh.triangles)
    rows = starting_rows(mesh, surface, surface.to_plane(np.array([[0.0, 60, 0]]))[0, :2], 2.0)
    start = surface_start(surface, samples, rows, Sizes(2.0, 1.0))
    topology, vertices = start.structure.topology, start.structure.vertices
    middle = vertices[topology.edges.vertices[~topology.edges.is_crease]].mean(axis=1)
    points = surface.project(middle)
    assert np.abs(np.einsum("ni,ni->n", middle - points.positions, points.normals)).max() < 0.1
    gaps = np.linalg.norm(np.diff(vertices[topology.edges.vertices[~topology.edges.is_crease]], axis=1)[:, 0], axis=1)
    assert np.median(gaps) == pytest.approx(np.hypot(2.0, 2 * start.amplitude), rel=0.1)
    np.testing.assert_allclose(np.linalg.norm(start.normals, axis=1), 1)


def test_curves_that_meet_the_surface_in_a_few_quads_only_are_no_start():
    curves = arches()
    mask = np.zeros((10, 28), bool)
    mask[:3, :4] = True
    with pytest.raises(Infeasible, match="smaller width"):
        normal_start(curves, normals_over(curves), AMPLITUDE, mask=mask)


def test_the_bow_of_straight_creases_is_zero_and_that_of_a_half_circle_is_its_mean_height():
    topology = grid(2, 200)
    turn = np.linspace(0, np.pi, 200)
    half = np.stack([np.cos(turn), np.sin(turn), 0 * turn], axis=1)
    line = np.stack([np.linspace(0, 1, 200), np.zeros(200), np.zeros(200)], axis=1)
    beside = np.array([0.0, 0, 1])
    assert bow(topology, np.concatenate([line, line + beside])) == 0
    assert bow(topology, np.concatenate([half, half + beside])) == pytest.approx(1 / np.pi, rel=0.01)

"""Whole surfaces: covered exactly and regularly, with numbers that an independent computation confirms."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from plisse.errors import Infeasible
from plisse.geometry.graph import GraphSurface
from plisse.geometry.mesh import ReferenceMesh, grid_mesh
from plisse.layout.automatic import centres, sensible_width, starting_rows
from plisse.layout.coverage import AreaSamples, covered, located
from plisse.measure.inclination import crease_inclinations
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import regularity
from plisse.measure.sectors import angle_defect
from plisse.solve.candidate import centre_of
from plisse.solve.flatten import flatten
from plisse.solve.whole_surface import FOLDABLE, whole_surface
from plisse.structure.grid import grid

CENTRE = np.array([0.0, -55.0, 0.0])


def wave(x, y):
    return 2.0 * np.sin(x / 7) * np.cos(y / 9) - 0.01 * (x**2 + y**2)


@cache
def mesh():
    x, y = np.meshgrid(np.linspace(-20, 20, 42), np.linspace(-18, 18, 39), indexing="ij")
    return grid_mesh(np.stack([x, y, wave(x, y)], axis=-1))


@cache
def surface():
    return GraphSurface(mesh())


@cache
def solution():
    return whole_surface(mesh(), surface(), centre=CENTRE)


def moved(turn, scale, shift):
    return ReferenceMesh(scale * turn.apply(mesh().vertices) + shift, mesh().triangles)


def hits(origins, directions, triangles, reach):
    """Whether lines meet any of the triangles (T, 3, 3) within reach: Möller–Trumbore, all against all."""
    a, ab, ac = triangles[:, 0], triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    out = []
    for origin, direction in zip(origins, directions, strict=True):
        p = np.cross(direction, ac)
        inverse = 1 / np.einsum("ti,ti->t", ab, p)
        u = np.einsum("ti,ti->t", origin - a, p) * inverse
        q = np.cross(origin - a, ab)
        v, t = q @ direction * inverse, np.einsum("ti,ti->t", ac, q) * inverse
        out.append(((u >= 0) & (v >= 0) & (u + v <= 1) & (np.abs(t) < reach)).any())
    return np.array(out)


def test_a_wave_is_covered_exactly_and_regularly_in_one_piece():
    found = solution()
    topology, vertices = found.structure.topology, found.structure.vertices
    assert found.coverage > 0.95
    assert planarity_defect(topology, vertices).max() < 1e-9
    assert np.abs(angle_defect(topology, vertices)).max() < 1e-9
    verdict = regularity(topology, vertices)
    assert verdict.is_regular
    assert verdict.min_opening > FOLDABLE
    assert topology.components == 1
    assert len(np.unique(topology.quads)) == topology.vertex_count
    assert found.notes[0].startswith("fitted inclination")
    assert sum(len(part) for part in found.inclination_by_crease.values()) == len(found.inclination)
    assert 0 <= found.overhanging < 1


def test_labels_of_centres_are_in_model_coordinates():
    best = solution().best
    label = "centre ({:.4g}, {:.4g}, {:.4g})".format(*centre_of(best, GraphSurface(mesh())) + 0.0)
    assert best.layout.label == label


def test_overhang_is_told_plainly_and_upright_pleats_win_where_coverage_is_nearly_the_same():
    found = solution()
    said = [note for note in found.notes if note.startswith("overhang = false keeps creases open by 15° and prefers")]
    assert bool(said) == (found.overhanging > 0)
    leaning, upright = (replace(found.best, overhanging=share, coverage=0.98) for share in (0.5, 0.0))
    assert leaning.rank < upright.rank
    assert replace(leaning, coverage=0.985).rank < upright.rank
    assert replace(leaning, coverage=0.995).rank > upright.rank
    assert replace(leaning, upright=False).rank == replace(upright, upright=False).rank


def test_the_development_of_a_whole_surface_is_isometric():
    flat = flatten(solution().structure)
    i, j = flat.topology.rods.T
    lengths = np.linalg.norm(flat.vertices[i] - flat.vertices[j], axis=1)
    np.testing.assert_allclose(np.linalg.norm(flat.development[i] - flat.development[j], axis=1), lengths, rtol=1e-9)


def test_coverage_agrees_with_lines_through_random_points():
    found, rng = solution(), np.random.default_rng(0)
    corners = mesh().vertices[mesh().triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    size = np.linalg.norm(area, axis=1)
    chosen = rng.choice(len(size), 5000, p=size / size.sum())
    weights = rng.dirichlet([1, 1, 1], 5000)
    points = np.einsum("nk,nki->ni", weights, corners[chosen])
    quads = found.structure.vertices[found.structure.topology.quads]
    quads = quads[quads[:, :, 1].max(axis=1) < 3.0]  # half a structure, so that there is something to miss
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    reach = 3 * found.best.layout.sizes.width
    expected = hits(points, (area / size[:, None])[chosen], triangles, reach).mean()
    samples = AreaSamples.of(mesh().vertices, mesh().triangles, levels=2)
    assert samples.total == pytest.approx(mesh().area)
    measured = covered(samples, quads.reshape(-1, 3), np.arange(quads[..., 0].size).reshape(-1, 4), reach)
    assert 0.3 < expected < 0.8
    assert measured == pytest.approx(expected, abs=0.02)


def test_deviation_agrees_with_closest_points_of_a_dense_sampling():
    from scipy.spatial import cKDTree

    found = solution()
    x, y = np.meshgrid(np.linspace(-20, 20, 900), np.linspace(-18, 18, 900), indexing="ij")
    tree = cKDTree(np.stack([x, y, wave(x, y)], axis=-1).reshape(-1, 3))
    middles = found.structure.vertices[found.structure.topology.quads].mean(axis=1)
    inside = (np.abs(middles[:, 0]) < 19) & (np.abs(middles[:, 1]) < 17)
    distance = tree.query(middles[inside])[0]
    amplitude = found.best.layout.sizes.amplitude
    np.testing.assert_allclose(found.deviation.distances[inside], distance, atol=0.1 * amplitude)
    assert found.deviation.mean < 0.6 * amplitude


def test_a_moved_and_scaled_copy_gives_the_same_structure():
    # right angles keep the bounding box, whose diagonal decides how a graph is continued beyond its boundary
    turn = Rotation.from_euler("xyz", [90, 0, 90], degrees=True)
    scale, shift = 25.4, np.array([100.0, -20.0, 7.0])
    other = moved(turn, scale, shift)
    found = whole_surface(other, GraphSurface(other), centre=scale * turn.apply(CENTRE) + shift)
    expected = scale * turn.apply(solution().structure.vertices) + shift
    assert found.structure.vertices.shape == expected.shape
    off = np.linalg.norm(found.structure.vertices - expected, axis=1)
    assert off.max() < 0.1 * found.best.layout.sizes.amplitude
    assert found.coverage == pytest.approx(solution().coverage, abs=1e-3)


def test_an_automatic_layout_scans_centres_and_reports_progress():
    seen = []
    found = whole_surface(mesh(), surface(), candidates=3, progress=lambda *news: seen.append(news))
    assert found.coverage > 0.95
    assert found.best.solved.is_sound
    assert seen[0] == ("scan", 0.0)
    assert all(0 <= fraction < 1 for _, fraction in seen)
    assert found.best.rank == max(candidate.rank for candidate in found.candidates)


def test_an_annulus_gets_creases_around_its_hole():
    r, a = np.meshgrid(np.linspace(8, 24, 17), np.linspace(0, 2 * np.pi, 80, endpoint=False), indexing="ij")
    x, y = r * np.cos(a), r * np.sin(a)
    ring = grid_mesh(np.stack([x, y, 0.015 * r**2 + 0.3 * np.cos(2 * a)], axis=-1), closed=(False, True))
    found = whole_surface(ring, GraphSurface(ring), width=1.6)
    assert found.best.solved.is_sound
    assert found.coverage > 0.95
    assert found.best.layout.net.closed
    assert any(crease.closed for crease in found.structure.topology.creases)


def test_widths_follow_size_and_curvature():
    width = sensible_width(mesh(), surface())
    assert width == pytest.approx(np.sqrt(mesh().area) / 32, rel=0.3)
    x, y = np.meshgrid(np.linspace(-20, 20, 81), np.linspace(-20, 20, 81), indexing="ij")
    rough = grid_mesh(np.stack([x, y, np.cos(x) * np.cos(y)], axis=-1))
    assert sensible_width(rough, GraphSurface(rough, smoothing=0.1)) < 0.6 * width


def test_centres_surround_the_surface_in_its_chart():
    places = np.array(list(centres(mesh(), surface(), 12)))
    assert (np.linalg.norm(places, axis=1) > 27).all()
    angles = np.sort(np.arctan2(places[:, 1], places[:, 0]))
    assert np.diff(angles).max() < 1.2


def test_rows_between_boundaries_need_two_of_them():
    with pytest.raises(Infeasible, match="two boundary loops, and this surface has 1"):
        starting_rows(mesh(), surface(), None, 1.0)


def test_points_are_located_in_the_quads_they_lie_in():
    x, y = np.meshgrid(np.arange(4.0), np.arange(3.0), indexing="ij")
    corners = np.stack([x, y, 0 * x], axis=-1)
    quads = np.stack([corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=2).reshape(-1, 4, 3)
    points = np.array([[0.5, 0.5, 0.1], [2.2, 1.9, 0.0], [5.0, 1.0, 0.0], [0.5, 1.5, 3.0]])
    samples = AreaSamples(points, np.ones(4), np.tile([0.0, 0.0, 1.0], (4, 1)))
    assert located(samples, quads, 1.0).tolist() == [0, 5, -1, -1]
    assert located(samples, quads[:0], 1.0).tolist() == [-1] * 4


def test_upright_pleats_have_no_inclination_and_leaning_ones_their_angle():
    row, column = np.divmod(np.arange(6 * 9), 9)
    vertices = np.stack([column, 0.7 * row, 0.4 * (-1.0) ** row], axis=1)
    topology = grid(6, 9)
    normals, outward = np.tile([0.0, 0, 1], (54, 1)), np.tile([0.0, 1, 0], (54, 1))
    assert np.abs(crease_inclinations(topology, vertices, normals, outward)).max() < 1e-12
    leaning = Rotation.from_rotvec([-0.3, 0, 0]).apply(vertices)
    np.testing.assert_allclose(crease_inclinations(topology, leaning, normals, outward), 0.3, atol=1e-12)
    np.testing.assert_allclose(crease_inclinations(topology, leaning, normals, -outward), -0.3, atol=1e-12)

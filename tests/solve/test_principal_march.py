"""The construction of principal structures: exact, batched, closed; measured by independent formulas."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from plisse.errors import Infeasible
from plisse.geometry.components import dot
from plisse.solve.principal import march as march_module
from plisse.solve.principal import march_closed, march_structure
from plisse.solve.principal.judge import regularity
from plisse.solve.principal.moebius import affine_chain, homogeneous_chain, prefix_products
from plisse.solve.principal.seed import rectifying_binormals
from plisse.solve.principal.strip import edge_directions


def angle(a, b):
    return np.arctan2(np.linalg.norm(np.cross(a, b), axis=-1), (a * b).sum(axis=-1))


def defects(vertices, closed=False):
    """Largest planarity, angle and principal defect of a grid (m, n, 3)."""
    if closed:
        vertices = np.concatenate([vertices[:, -1:], vertices, vertices[:, :1]], axis=1)
    a, b, c, d = vertices[:-1, :-1], vertices[:-1, 1:], vertices[1:, 1:], vertices[1:, :-1]
    normal = np.cross(c - a, d - b)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    diagonals = 0.5 * (np.linalg.norm(c - a, axis=-1) + np.linalg.norm(d - b, axis=-1))
    planarity = np.abs(((b - a) * normal).sum(axis=-1)) / diagonals
    middle = vertices[1:-1, 1:-1]
    arms = [vertices[1:-1, :-2] - middle, vertices[2:, 1:-1] - middle,
            vertices[1:-1, 2:] - middle, vertices[:-2, 1:-1] - middle]
    sectors = [angle(arms[k], arms[(k + 1) % 4]) for k in range(4)]
    return (planarity.max(), np.abs(sum(sectors) - 2 * np.pi).max(),
            np.abs(sectors[0] + sectors[2] - np.pi).max())


def fold_angles(vertices):
    normal = np.cross(vertices[1:, 1:] - vertices[:-1, :-1], vertices[1:, :-1] - vertices[:-1, 1:])
    return angle(normal[1:], normal[:-1])


def arc(samples, rise=0.0, twist=0.0, length=1.2):
    t = np.linspace(-length / 2, length / 2, samples)
    return 100 * np.stack([np.cos(t), np.sin(t), rise * t + twist * t**2], axis=1)


def ring(samples, wave=0.04):
    t = 2 * np.pi * np.arange(samples) / samples
    return 100 * np.stack([np.cos(t), 0.9 * np.sin(t), wave * np.cos(2 * t + 0.3)], axis=1)


def pleats(creases, fold, sign, distance=6.0, direction=np.nan):
    return np.array([[distance, direction, sign * fold * (-1) ** k] for k in range(creases)])


def both(creases, half_opening, **numbers):
    fold = np.pi - 2 * half_opening
    return pleats(creases, fold, -1, **numbers), pleats(creases, fold, 1, **numbers)


@settings(max_examples=25, deadline=None)
@given(rise=st.floats(-0.1, 0.1), twist=st.floats(-0.1, 0.1), half=st.floats(0.6, 1.1),
       distance=st.floats(2, 6), change=st.floats(0.95, 1.05), samples=st.integers(20, 160))
def test_every_march_is_exact(rise, twist, half, distance, change, samples):
    after, before = both(4, half, distance=distance)
    after[1, 2] *= change
    vertices = march_structure(arc(samples, rise, twist), half, after, before)
    looks = regularity(np.moveaxis(vertices, 2, 1), closed=False)
    assume(looks.sector > 20 and looks.inverted == 0)
    planarity, sums, principal = defects(vertices)
    assert planarity < 2e-14
    assert sums < 5e-13
    assert principal < 1e-12


def test_fold_angles_are_constant_along_creases():
    after, before = both(4, 0.9)
    folds = fold_angles(march_structure(arc(80, 0.05, 0.1), 0.9, after, before))
    assert np.ptp(folds, axis=1).max() < 1e-11
    assert folds == pytest.approx(np.pi - 1.8)


def test_with_the_wrong_fold_sense_about_rulings_angles_miss_by_far(monkeypatch):
    after, before = both(3, 0.9)
    points = arc(40, 0.05, 0.1)
    assert defects(march_structure(points, 0.9, after, before))[1] < 5e-13
    right = march_module.ruling_folds
    monkeypatch.setattr(march_module, "ruling_folds", lambda *strip, **closed: -right(*strip, **closed))
    assert defects(march_structure(points, 0.9, after, before))[1] > 1e-3


def test_a_circular_seed_with_equal_numbers_gives_alternating_cones():
    half = 0.9
    after, before = both(4, half)
    vertices = march_structure(arc(81), half, after, before)
    radius = np.linalg.norm(vertices[..., :2], axis=-1)
    assert np.ptp(radius, axis=1).max() < 1e-11
    assert np.ptp(vertices[..., 2], axis=1).max() < 1e-11
    steps = np.diff(np.stack([radius.mean(axis=1), vertices[..., 2].mean(axis=1)]), axis=1)
    slope = np.abs(steps[1] / steps[0])
    exact = np.cos(0.6 / 80) / np.tan(half)  # radii end at the corners of a polygon, not at its edges
    assert slope == pytest.approx(np.full(10, exact), rel=1e-9)


def test_closed_marches_close_and_are_exact():
    after, before = both(4, 0.9)
    vertices = march_closed(ring(121), 0.9, after, before)
    planarity, sums, principal = defects(vertices, closed=True)
    assert planarity < 2e-14
    assert sums < 5e-13
    assert principal < 5e-13


def test_a_smooth_closed_seed_may_have_an_even_number_of_points():
    after, before = both(3, 0.9)
    assert max(defects(march_closed(ring(120), 0.9, after, before), closed=True)) < 1e-11


def test_an_even_closed_seed_that_cannot_close_is_refused_in_one_sentence():
    rough = ring(20) + np.random.default_rng(1).normal(scale=0.5, size=(20, 3))
    with pytest.raises(Infeasible, match="odd number of points"):
        march_closed(rough, 0.9, pleats(1, 1.3, -1))


def test_an_odd_closed_polyline_has_rectifying_planes_however_rough():
    rough = (ring(21) + np.random.default_rng(1).normal(scale=0.5, size=(21, 3))).T[:, None]
    reference = np.broadcast_to(np.array([0.0, 0, 1])[:, None, None], rough.shape)
    edges = edge_directions(rough, closed=True)
    binormals = rectifying_binormals(rough, reference, closed=True)
    before, mirror = np.roll(binormals, 1, -1), edges - np.roll(edges, 1, -1)
    image = before - 2 * dot(before, mirror) / dot(mirror, mirror) * mirror
    assert np.abs(image - binormals).max() < 1e-13
    assert np.abs(dot(binormals, edges)).max() < 1e-15


def test_batches_equal_single_marches():
    halves = np.array([0.8, 0.9, 1.0])
    sides = [both(3, half) for half in halves]
    after, before = (np.stack(side) for side in zip(*sides, strict=True))
    together = march_structure(arc(50, 0.1), halves, after, before)
    for k, half in enumerate(halves):
        alone = march_structure(arc(50, 0.1), half, after[k], before[k])
        assert np.abs(together[k] - alone).max() < 1e-11
    closed = march_closed(ring(51), halves, after, before)
    assert np.abs(closed[1] - march_closed(ring(51), halves[1], after[1], before[1])).max() < 1e-9


def test_scans_equal_plain_loops():
    random = np.random.default_rng(3)
    matrices = tuple(random.normal(size=(2, 37)) for _ in range(4))
    state = np.array([[0.3, 0.8], [-0.5, 0.2]]).T
    u, v = homogeneous_chain(matrices, *state.T)
    factor, shift = random.uniform(0.8, 1.2, size=(2, 2, 37))
    chain = affine_chain(factor, shift, np.ones(2))
    for member in range(2):
        point, value, product = state[member], 1.0, np.eye(2)
        for i in range(37):
            matrix = np.array([[x[member, i] for x in matrices[:2]], [x[member, i] for x in matrices[2:]]])
            point, product = matrix @ point, matrix @ product
            value = factor[member, i] * value + shift[member, i]
            parallel = u[member, i] * point[1] - v[member, i] * point[0]
            assert abs(parallel) < 1e-9 * np.hypot(u[member, i], v[member, i]) * np.hypot(*point)
            assert chain[member, i] == pytest.approx(value, rel=1e-12)
        last = np.array([x[member, -1] for x in prefix_products(matrices)]).reshape(2, 2)
        assert last / np.abs(last).max() == pytest.approx(product / np.abs(product).max(), abs=1e-9)


def test_numbers_do_not_depend_on_the_number_of_samples():
    after, before = both(4, 0.9)
    shapes = [march_structure(arc(samples, 0.05, 0.1), 0.9, after, before)[:, ::(samples - 1) // 20]
              for samples in (41, 81, 161)]
    coarse, fine = (np.abs(shapes[k] - shapes[k + 1])[1:-1].max() for k in range(2))
    assert coarse < 0.05
    assert np.log2(coarse / fine) > 1.5


def test_marching_commutes_with_rigid_motions_and_scaling():
    after, before = both(3, 0.9)
    turn, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    points = arc(60, 0.05, 0.1)
    moved = march_structure(2 * points @ turn.T + [1, 2, 3], 0.9, after * [2, 1, 1], before * [2, 1, 1])
    expected = 2 * march_structure(points, 0.9, after, before) @ turn.T + [1, 2, 3]
    assert np.abs(moved - expected).max() < 1e-5  # rulings of a rounded polyline: 1e-14 / h² of its curvature

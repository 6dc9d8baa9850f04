"""Masked grids: masks without loose ends, compact structures, exact solutions where some quads cannot stay."""

import numpy as np
import pytest

from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import regularity
from plisse.measure.sectors import angle_defect
from plisse.solve.energies.mid_surface import mid_surface_closeness
from plisse.solve.masked import MaskedGrid, Trim, irregular, solve_masked
from plisse.structure.chains import boundary_loops
from plisse.structure.grid import grid
from plisse.structure.masks import cleaned, grown, largest_piece

SHAPE = (15, 26)


def bowl(closed=False, theta=0.35, amplitude=0.5):
    """Zigzag (n, m, 3) over a shallow paraboloid with circles around a far centre, and the surface normals."""
    radius = (14.0 if not closed else 5.0) + np.arange(SHAPE[0])[:, None]
    angle = (np.arange(SHAPE[1]) * (0.9 if not closed else 2 * np.pi / SHAPE[1] * 14) / 14)[None]
    x, y = radius * np.cos(angle) - (20.0 if not closed else 0.0), radius * np.sin(angle)
    points = np.stack([x, y, -0.01 * (x**2 + y**2)], axis=-1)
    normals = np.stack([0.02 * x, 0.02 * y, np.ones_like(x)], axis=-1)
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    outward = np.stack(np.broadcast_arrays(np.cos(angle), np.sin(angle), 0 * radius), axis=-1)
    side = np.where(np.arange(SHAPE[0]) % 2, amplitude, -amplitude)[:, None, None]
    return points + side * (np.cos(theta) * normals - np.sin(theta) * outward), normals


def full(closed=False):
    return np.ones((SHAPE[0] - 1, SHAPE[1] - (not closed)), bool)


def assert_sound(found):
    topology = found.grid.topology
    assert planarity_defect(topology, found.vertices).max() < 1e-10
    assert np.abs(angle_defect(topology, found.vertices)).max() < 1e-10
    assert regularity(topology, found.vertices).is_regular
    assert topology.components == 1
    assert not irregular(found.grid, found.vertices).any()


@pytest.mark.parametrize("closed", [False, True])
def test_a_cleaned_mask_is_one_piece_without_loose_ends_or_pinched_corners(closed):
    rng = np.random.default_rng(3)
    for _ in range(20):
        mask = cleaned(rng.random((12, 17)) < 0.7, closed)
        if not mask.any():
            continue
        assert (cleaned(mask, closed) == mask).all()
        topology = grid(13, 17 + (not closed), closed_creases=closed, mask=mask)
        assert topology.components == 1
        ends = topology.edges.vertices[topology.edges.is_boundary]
        assert np.bincount(ends.ravel()).max() == 2  # the boundary nowhere touches itself
    assert (largest_piece(np.eye(4, dtype=bool), closed).sum()) == 1


def test_growing_goes_around_closed_creases():
    mask = np.zeros((3, 6), bool)
    mask[1, 0] = True
    assert grown(mask, True).sum() == 9
    assert grown(mask, False).sum() == 6
    assert (grown(mask, True, 0) == mask).all()


def test_a_masked_grid_keeps_used_vertices_only_and_their_order():
    mask = full()
    mask[:4, :5] = False
    part = MaskedGrid.of(SHAPE, False, mask)
    assert part.topology.vertex_count == len(part.used) == SHAPE[0] * SHAPE[1] - 4 * 5
    assert (np.diff(part.used) > 0).all()
    whole = grid(*SHAPE, mask=mask)
    assert (part.used[part.topology.quads] == whole.quads).all()
    assert (part.topology.ordering == whole.ordering[part.used]).all()
    assert part.topology.euler_characteristic == 1


def test_a_zigzag_with_notches_and_a_hole_becomes_exact_and_stays_watertight():
    start, normals = bowl()
    mask = full()
    mask[:3, :6], mask[-2:, 10:], mask[6:8, 12:14] = False, False, False
    found = solve_masked(start, normals, mask, False)
    assert_sound(found)
    assert (found.grid.mask == mask).all()
    assert found.grid.topology.euler_characteristic == 0
    assert len(boundary_loops(found.grid.topology)) == 2


def test_a_place_that_cannot_be_solved_is_taken_away_and_the_rest_is_exact():
    start, normals = bowl()
    rng = np.random.default_rng(5)
    start[7, 12:14] += 0.6 * rng.normal(size=(2, 3))
    found = solve_masked(start, normals, full(), False, Trim(worst=0.02))
    assert_sound(found)
    lost = full() & ~found.grid.mask
    assert 0 < lost.sum() < 60
    assert lost[6:8, 11:14].any()


def test_closed_creases_are_solved_on_their_grid():
    start, normals = bowl(closed=True)
    found = solve_masked(start, normals, full(True), True)
    assert_sound(found)
    assert found.grid.topology.euler_characteristic == 0
    assert all(crease.closed for crease in found.grid.topology.creases)


def test_too_few_quads_are_no_structure():
    start, normals = bowl()
    mask = np.zeros_like(full())
    mask[:3, :4] = True
    assert solve_masked(start, normals, mask, False) is None


def test_the_mid_surface_is_held_along_normals_only():
    start, normals = bowl()
    topology = grid(*SHAPE)
    rest, up = start.reshape(-1, 3).T, normals.reshape(-1, 3).T
    term = mid_surface_closeness(topology, rest, up)

    def residual(vertices):
        return term.kernel(*(vertices[:, rows.index] for rows in term.arguments), **term.data)

    assert np.abs(residual(rest)).max() < 1e-14
    flat = np.cross(normals, [0, 0, 1.0]).reshape(-1, 3).T  # sideways moves of a surface of revolution
    assert np.abs(residual(rest + 1e-3 * flat)).max() < 1e-4
    np.testing.assert_allclose(residual(rest + 1e-3 * up), 1e-3, rtol=0.01)


def test_holding_the_mid_surface_brings_it_nearer():
    start, normals = bowl(theta=0.5)
    middle = [np.abs(np.einsum("qi,qi->q", (found.vertices - start.reshape(-1, 3)[found.grid.used])[
        found.grid.topology.quads].mean(axis=1), normals.reshape(-1, 3)[found.grid.used][
            found.grid.topology.quads].mean(axis=1))).mean()
        for found in (solve_masked(start, normals, full(), False, Trim(hold=hold)) for hold in (0.0, 1.0))]
    assert middle[1] < 0.7 * middle[0]

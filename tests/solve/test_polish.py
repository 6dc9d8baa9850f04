"""The exact method: quadratic convergence, least movement, recovery from noise, honest failure."""

from itertools import pairwise

import numpy as np
import pytest

from plisse.solve.anneal import anneal
from plisse.solve.constraints import Constraints
from plisse.solve.polish import polish
from plisse.structure.grid import grid


def in_units(structure):
    return np.ascontiguousarray((structure.vertices / structure.mean_edge).T)


def disturbed(structure, size, seed=0):
    vertices = in_units(structure)
    return vertices + size * np.random.default_rng(seed).normal(size=vertices.shape)


@pytest.mark.parametrize("principal", [False, True])
def test_polish_returns_to_an_exact_structure_from_noise(cones, principal):
    done = polish(Constraints(cones.topology, principal), disturbed(cones, 1e-3))
    assert done.defect < 1e-12
    assert np.abs(done.vertices - in_units(cones)).max() < 0.1


def test_polish_converges_quadratically(cones):
    history = polish(Constraints(cones.topology), disturbed(cones, 3e-3)).history
    large = [defect for defect in history[:-1] if defect > 1e-10]
    assert len(large) >= 2
    rates = [np.log(b) / np.log(a) for a, b in pairwise(large)]
    assert rates[-1] > 1.5


def test_the_first_step_is_the_shortest_that_satisfies_the_linearised_conditions(cones):
    constraints, start = Constraints(cones.topology, True), disturbed(cones, 1e-4)
    jacobian, residual = constraints.jacobian(start), constraints.residual(start)
    step = -constraints.pull_back(jacobian, constraints.factor(jacobian).solve(residual))
    rows, vertices = constraints._entries
    dense = np.zeros((constraints.count, 3, cones.topology.vertex_count))
    for component in range(3):
        np.add.at(dense[:, component], (rows, vertices), jacobian[component])
    shortest = -np.linalg.lstsq(dense.reshape(constraints.count, -1), residual, rcond=1e-9)[0]
    assert np.linalg.norm(step) <= np.linalg.norm(shortest) * (1 + 1e-3)  # damping 1e-13 against tiny singular values
    assert np.abs(dense.reshape(constraints.count, -1) @ step.ravel() + residual).max() < 1e-3 * np.abs(residual).max()


def test_chords_reach_the_same_solution_with_fewer_factorisations(cones):
    start = disturbed(cones, 1e-3)
    newton = polish(Constraints(cones.topology), start)
    chord = polish(Constraints(cones.topology), start, chord=True, steps=20)
    assert chord.defect < 1e-12
    assert chord.factorisations < newton.factorisations + 1
    assert np.abs(chord.vertices - newton.vertices).max() < 1e-4  # both nearest solutions, to second order


def test_a_hopeless_start_ends_with_the_best_seen_and_finite(cones):
    done = polish(Constraints(cones.topology), disturbed(cones, 2.0))
    assert np.isfinite(done.vertices).all()
    assert done.defect <= done.history[0]


def test_annealing_alone_brings_noise_near_the_conditions_without_moving_far(cones):
    start = disturbed(cones, 1e-2)
    relaxed = anneal(cones.topology, start)
    constraints = Constraints(cones.topology)
    assert np.abs(constraints.residual(relaxed)).max() < 1e-2 * np.abs(constraints.residual(start)).max()
    assert np.abs(relaxed - start).max() < 0.5


def test_results_do_not_depend_on_the_numbering_of_vertices(cones):
    shuffle = np.random.default_rng(3).permutation(cones.topology.vertex_count)
    place = np.argsort(shuffle)
    from plisse.structure.topology import Topology

    start = disturbed(cones, 1e-3)
    straight = polish(Constraints(cones.topology), start).vertices
    renumbered = Topology(cones.topology.vertex_count, place[cones.topology.quads])
    other = polish(Constraints(renumbered), start[:, shuffle]).vertices  # sparse solver: no ordering given
    assert np.abs(other[:, place] - straight).max() < 1e-9


def test_a_closed_grid_is_solved_across_its_seam(closed_cones):
    done = polish(Constraints(closed_cones.topology, True), disturbed(closed_cones, 1e-3))
    assert done.defect < 1e-12


def test_a_strip_without_inner_vertices_only_needs_planar_faces():
    topology = grid(2, 6)
    vertices = np.random.default_rng(0).normal(size=(3, 12))
    assert polish(Constraints(topology), vertices, steps=30).defect < 1e-12

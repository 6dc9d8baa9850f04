"""The paper's own optimisation does at least what its Fig. 21 prints."""

import numpy as np
import pytest

from plisse.geometry.curves import seed_curve
from plisse.geometry.vectors import norm
from plisse.layout.evolve import evolve
from plisse.layout.widths import strip_widths
from plisse.leastsquares.levenberg import Status
from plisse.measure.isometry import isometry_defect
from plisse.measure.planarity import face_normals, planarity_defect
from plisse.measure.sectors import angle_defect, principal_defect
from plisse.recipe import Helix, TorusKnot
from plisse.solve.energies import Guides
from plisse.solve.paper import paper_weights, quasi_unfolding, solve_paper, square_grid
from plisse.solve.zigzag import zigzag
from plisse.structure.cut import cut_along, uncut
from plisse.structure.exact import alternating_cones, conic_creases
from plisse.structure.grid import grid
from plisse.structure.topology import Topology


def start(curve, creases, samples, *, theta=30.0, width=2.5, amplitude=2.0, nodes=60):
    """A zigzag over an evolved pattern, and its guides."""
    seed = seed_curve(curve, nodes)
    inclination = np.full(creases, np.radians(theta))
    parameters = np.linspace(0, 1, nodes, endpoint=not curve.closed)
    widths = strip_widths(width, inclination, amplitude, parameters, closed=curve.closed)
    pattern = evolve(seed, inclination, widths, closed=curve.closed).resampled(samples)
    zigzagged = zigzag(pattern, amplitude)
    guides = Guides.along_creases(zigzagged.topology, zigzagged.vertices, pattern.binormals.reshape(-1, 3))
    return zigzagged, guides


@pytest.fixture(scope="module")
def helical():
    return start(Helix(radius=100, pitch=60, turns=0.5), 8, 60)


@pytest.fixture(scope="module")
def knotted():
    return start(TorusKnot(p=2, q=3, R=100, r=13, rz=10), 6, 120, amplitude=2.5, nodes=120)


def test_square_grid_is_recognised_whatever_quads_it_lacks():
    mask = np.ones((4, 6), bool)
    mask[1, 2] = mask[3, 4] = False
    for topology in (grid(5, 7), grid(5, 7, mask=mask)):
        level, column = np.divmod(np.arange(35), 7)
        used = np.isin(np.arange(35), topology.quads)
        squares = square_grid(topology)
        np.testing.assert_array_equal((squares - squares[0])[used], np.stack([column, level], axis=1)[used])


def test_closed_creases_are_no_square_grid_until_they_are_cut():
    topology = grid(4, 12, closed_creases=True)
    assert square_grid(topology) is None
    assert square_grid(cut_along(topology, topology.rulings[0]).topology) is not None


def test_a_hub_is_no_square_grid():
    assert square_grid(Topology(6, np.empty((0, 4)), (np.arange(6),))) is None


@pytest.mark.parametrize("structure", [alternating_cones(8, 60, sector=2.5), conic_creases(8, 40)],
                         ids=["cones", "conics"])
def test_square_grid_bends_into_the_development_of_an_exact_structure(structure):
    flat = quasi_unfolding(uncut(structure.topology), structure.vertices)
    # stage 1 stops when a step gains less than 1e-6 of its cost
    assert isometry_defect(structure.topology, structure.vertices, flat) < 1e-7


def test_exact_structures_stay_as_they_are_without_fairness():
    structure = alternating_cones(6, 20)
    guides = Guides.along_creases(structure.topology, structure.vertices)
    found = solve_paper(structure.topology, structure.vertices, guides, weights=(10, 1, 100, 0, 100))
    assert found.status is Status.CONVERGED
    np.testing.assert_allclose(found.vertices, structure.vertices, atol=1e-6)  # as exact as stage 1
    assert isometry_defect(structure.topology, found.vertices, found.development) < 1e-7


@pytest.mark.parametrize("principal", [False, True])
def test_open_design_beats_the_printed_defects(helical, principal):
    zigzagged, guides = helical
    topology = zigzagged.topology
    found = solve_paper(topology, zigzagged.vertices, guides, principal=principal)
    planarity, angle = planarity_defect(topology, found.vertices), angle_defect(topology, found.vertices)
    # Fig. 21, row 1d: planarity 8e-5 at most, angles 1.4e-2; a coarser mesh than the paper's is less planar
    assert planarity.max() < 2e-4
    assert np.abs(angle).max() < 1.4e-2
    assert planarity.max() < 0.2 * planarity_defect(topology, zigzagged.vertices).max()
    assert found.iterations <= 20


def test_principal_weight_keeps_folds_constant(helical):
    zigzagged, guides = helical
    topology = zigzagged.topology
    general, principal = (solve_paper(topology, zigzagged.vertices, guides, principal=flag).vertices
                          for flag in (False, True))
    assert principal_defect(topology, principal).max() < 0.3 * principal_defect(topology, general).max()


def test_solution_carries_its_development_normals_and_history(helical):
    zigzagged, guides = helical
    topology = zigzagged.topology
    found = solve_paper(topology, zigzagged.vertices, guides, iterations=5)
    assert len(found.history) == found.iterations + 1 == 6
    assert found.factorisations >= 5
    assert found.history[-1] < found.history[0]
    np.testing.assert_allclose(norm(found.normals), 1, atol=1e-3)
    assert np.abs((found.normals * face_normals(topology, found.vertices)).sum(axis=1) - 1).max() < 1e-3
    assert isometry_defect(topology, found.vertices, found.development) < 1e-2


def test_units_of_length_do_not_matter(helical):
    zigzagged, guides = helical
    found = solve_paper(zigzagged.topology, zigzagged.vertices, guides, iterations=3)
    large = Guides(zigzagged.topology, 1000 * guides.vertices, guides.principal_normals)
    scaled = solve_paper(zigzagged.topology, 1000 * zigzagged.vertices, large, iterations=3)
    # rounding of the start is amplified by unfolding and damped steps
    np.testing.assert_allclose(scaled.vertices, 1000 * found.vertices, rtol=0, atol=1e-3)


def test_angles_along_the_cut_of_closed_creases_are_as_good_as_elsewhere(knotted):
    zigzagged, guides = knotted
    topology = zigzagged.topology
    cut = cut_along(topology, topology.rulings[0])
    found = solve_paper(topology, zigzagged.vertices, guides, iterations=10, cut=cut)
    angle = np.abs(angle_defect(topology, found.vertices))
    on_cut = np.isin(np.arange(topology.vertex_count), topology.rulings[0].vertices)
    # Fig. 21, row 19: planarity 1.7e-3 at most, 4e-4 on average; angles 4.3e-2 and 6.7e-3
    assert planarity_defect(topology, found.vertices).max() < 1.7e-3
    assert angle.max() < 4.3e-2
    assert angle[on_cut].max() < 3 * angle[~on_cut].max()
    assert found.development.shape == (len(cut.source), 2)


def test_both_copies_of_the_cut_are_congruent(knotted):
    zigzagged, guides = knotted
    topology = zigzagged.topology
    line = topology.rulings[0].vertices
    cut = cut_along(topology, topology.rulings[0])
    flat = solve_paper(topology, zigzagged.vertices, guides, iterations=10, cut=cut).development
    copy = np.array([np.flatnonzero(cut.source == vertex)[1] for vertex in line])
    shapes = [flat[side] - flat[side].mean(axis=0) for side in (line, copy)]
    left, right = (shape @ np.array([1, 1j]) for shape in shapes)
    turn = np.vdot(left, right)
    gap = np.abs(right - left * turn / np.abs(turn)).max()
    assert gap < 1e-2 * np.abs(left).max()  # congruent up to the accuracy of the angle sums


def test_default_weights_are_those_of_figure_21():
    assert paper_weights(False) == (10, 1, 100, 1, 0)
    assert paper_weights(True) == (10, 1, 100, 1, 100)

"""Patterns with singularities become exact, fold as labelled, and stay so when they are refined."""

import numpy as np
import pytest

from plisse.geometry.chart import FormulaChart
from plisse.geometry.height_field import HeightField
from plisse.geometry.vectors import dot, norm
from plisse.geometry.weierstrass import MinimalSurface
from plisse.layout.asymptotic.pattern import lay_out
from plisse.layout.asymptotic.sizing import Sizes
from plisse.leastsquares.problem import Problem
from plisse.measure.folds import assignments
from plisse.solve.energies.amplitude import kept_amplitude
from plisse.solve.raising import finer, raised, zigzag_over
from plisse.solve.workspace import Workspace


def laid_out(sectors):
    chart = MinimalSurface(f"z**{sectors - 1}", "1", (-0.5, 0.5), (-0.5, 0.5))
    return lay_out(chart, 1, Sizes(5, 8, 0.06)).cut_along_legs(8.0)


@pytest.fixture(scope="module", params=[3, 4])
def found(request):
    return raised(laid_out(request.param), 0.03, Workspace())[0]


def sums_of_angles(faces, vertices):
    """Angles around every vertex, face by face, by the law of cosines: shares no code with the solver."""
    total = np.zeros(len(vertices))
    for face in faces:
        for before, at, after in zip(np.roll(face, 1), face, np.roll(face, -1), strict=True):
            a, b, c = (np.linalg.norm(vertices[p] - vertices[q]) for p, q in ((at, before), (at, after), (before, after)))
            total[at] += np.arccos((a * a + b * b - c * c) / (2 * a * b))
    return total


def test_patterns_around_singularities_become_exact_and_regular(found):
    assert found.is_sound
    assert found.comfort > np.radians(15)


def test_angles_around_inner_vertices_sum_to_a_full_turn(found):
    topology = found.zigzag.topology
    sums = sums_of_angles(topology.faces, found.solved.vertices)
    np.testing.assert_allclose(sums[topology.is_inner], 2 * np.pi, atol=1e-11)
    assert topology.is_inner[topology.hubs[0]].all()


def test_mountains_and_valleys_are_those_of_the_labels(found):
    topology = found.zigzag.topology
    letters = assignments(topology, found.solved.vertices)
    edges = topology.edges
    inner = edges.is_crease & ~edges.is_boundary
    wanted = np.where(found.zigzag.labels[edges.vertices[:, 0]] > 0, "M", "V")  # upper creases are mountains from above
    assert (letters[inner] == wanted[inner]).all()
    assert {"M", "V"} == set(letters[inner])


def test_finer_structures_stay_exact_and_move_no_further(found):
    fine = finer(found, found.layout.refined(), Workspace())
    assert fine is not None
    assert fine.is_sound
    assert fine.zigzag.topology.vertex_count > 1.7 * found.zigzag.topology.vertex_count
    moved = [norm(state.solved.vertices - state.zigzag.vertices).max() for state in (found, fine)]
    assert moved[1] < 1.3 * moved[0]
    np.testing.assert_array_equal([len(hub) for hub in fine.zigzag.topology.hubs],
                                  [len(hub) for hub in found.zigzag.topology.hubs])


def test_lowering_a_surface_keeps_its_asymptotic_curves():
    low, high = (lay_out(FormulaChart(HeightField(f"{k}*(x**3 - 3*x*y**2)")), 1, Sizes(3, 5, 0.15, 0.6, 0.12))
                 for k in (0.01, 0.02))
    np.testing.assert_allclose(low.net.places, high.net.places, atol=2e-3)  # spacing is measured in space
    zigzag = zigzag_over(high, 0.05)
    lowered = zigzag.raised(0.5)
    spread = np.ptp(lowered.feet[:, 2]) / np.ptp(zigzag.feet[:, 2])
    assert spread == pytest.approx(0.5, abs=1e-3)  # the mean normal is not quite vertical
    np.testing.assert_allclose(norm(lowered.normals), 1, rtol=1e-14)
    along = lowered.feet[lowered.topology.quads[:, 1]] - lowered.feet[lowered.topology.quads[:, 0]]
    before = zigzag.feet[lowered.topology.quads[:, 1]] - zigzag.feet[lowered.topology.quads[:, 0]]
    normals = zigzag.normals[lowered.topology.quads[:, 0]]
    # normals stay normal: inner products with images of the same vectors keep their sign and shrink
    assert np.abs(dot(along, lowered.normals[lowered.topology.quads[:, 0]])).max() <= np.abs(dot(before, normals)).max()


def test_kept_amplitude_vanishes_at_rest_and_sees_creases_sink():
    zigzag = zigzag_over(laid_out(3), 0.03)
    rest = np.ascontiguousarray(zigzag.vertices.T)
    terms = kept_amplitude(zigzag.topology, rest, zigzag.normals.T, zigzag.repeats)
    problem = Problem(terms, {"vertices": (3, np.arange(rest.shape[1]))})
    assert np.abs(problem.residual({"vertices": rest})).max() < 1e-15
    shifted = problem.residual({"vertices": rest + np.array([[1.0], [2.0], [3.0]])})
    assert np.abs(shifted).max() < 1e-13
    sunk = problem.residual({"vertices": np.ascontiguousarray(zigzag.feet.T)})
    assert np.median(np.abs(sunk)) == pytest.approx(0.06, rel=0.1)  # both creases lose 0.03

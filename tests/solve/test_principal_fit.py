"""Principal structures fitted to guides: recovery, exactness, resolution, closed creases, honest failure."""

import numpy as np
import pytest

from plisse.errors import InvalidDesign
from plisse.solve.principal import fit_candidates, fit_principal, march_closed, march_structure

HALF = 0.9
AMPLITUDE = 3.0


def seed(samples):
    t = np.linspace(-0.6, 0.6, samples)
    return 100 * np.stack([np.cos(t), np.sin(t), 0.06 * t + 0.05 * t**2 + 0.03 * t**3], axis=1)


def ring(samples):
    t = 2 * np.pi * np.arange(samples) / samples
    return 100 * np.stack([np.cos(t), 0.9 * np.sin(t), 0.04 * np.cos(2 * t + 0.3)], axis=1)


def numbers(creases, sign, direction=np.nan):
    fold = np.pi - 2 * HALF
    trios = [[5 + 0.1 * k, direction, sign * fold * (-1) ** k] for k in range(creases)]
    return np.array(trios)


def marched(samples):
    """A principal structure (9, samples, 3) with its seed in the middle."""
    return march_structure(seed(samples), HALF, numbers(3, -1), numbers(3, 1))


def zigzag(samples, creases=9, width=4.0, closed=False):
    """Concentric upright zigzags (creases, samples, 3) along a curve that is no circle: nearly principal."""
    points = ring(samples) if closed else seed(samples)
    flat = points * [1, 1, 0]
    inward = flat / np.linalg.norm(flat, axis=1, keepdims=True)
    rows = [points - k * width * inward + [0, 0, AMPLITUDE * (-1) ** (k + 1)] for k in range(creases)]
    return np.array(rows)


def defects(vertices, closed=False):
    """Largest angle sum defect and |ω1 + ω3 − π| of a grid (m, n, 3)."""
    if closed:
        vertices = np.concatenate([vertices[:, -1:], vertices, vertices[:, :1]], axis=1)
    middle = vertices[1:-1, 1:-1]
    arms = [vertices[1:-1, :-2] - middle, vertices[2:, 1:-1] - middle,
            vertices[1:-1, 2:] - middle, vertices[:-2, 1:-1] - middle]
    sectors = [np.arctan2(np.linalg.norm(np.cross(arms[k], arms[(k + 1) % 4]), axis=-1),
                          (arms[k] * arms[(k + 1) % 4]).sum(axis=-1)) for k in range(4)]
    return np.abs(sum(sectors) - 2 * np.pi).max(), np.abs(sectors[0] + sectors[2] - np.pi).max()


def test_a_fit_recovers_the_structure_it_was_given():
    given = marched(61)
    fit = fit_principal(given, AMPLITUDE)
    assert fit.is_good
    assert fit.deviation < 0.01
    # creases may slide along themselves where they end, inner vertices stay
    assert np.linalg.norm(fit.vertices - given, axis=-1)[1:-1, 5:-5].max() < 0.05 * AMPLITUDE


def test_numbers_are_recovered_too():
    fit = fit_principal(marched(61), AMPLITUDE)
    assert fit.numbers.seed == 4
    assert fit.numbers.half_opening == pytest.approx(HALF, abs=1e-2)
    assert np.abs(fit.numbers.creases[5:8, 0] - numbers(3, -1)[:, 0]).max() < 0.05
    assert np.abs(np.abs(fit.numbers.creases[5:8, 2]) - np.abs(numbers(3, -1)[:, 2])).max() < 1e-2


@pytest.mark.parametrize("samples", [20, 90, 200])
def test_fits_to_general_guides_are_exact_near_and_regular(samples):
    fit = fit_principal(zigzag(samples), AMPLITUDE)
    assert fit.vertices.shape == (9, samples, 3)
    assert fit.is_good
    assert fit.message == ""
    assert fit.deviation < 0.5
    assert fit.mean_deviation < 0.2
    sums, principal = defects(fit.vertices)
    assert sums < 5e-13
    assert principal < 1e-12


def test_fitted_numbers_hardly_depend_on_the_number_of_samples():
    coarse, fine = (fit_principal(zigzag(samples), AMPLITUDE) for samples in (61, 121))
    assert fine.numbers.half_opening == pytest.approx(coarse.numbers.half_opening, abs=1e-3)
    assert np.abs(fine.numbers.creases - coarse.numbers.creases)[1:-1].max() < 0.02
    assert fine.deviation == pytest.approx(coarse.deviation, abs=0.05)


@pytest.mark.parametrize("samples", [81, 80])
def test_closed_creases_are_fitted_with_odd_and_even_numbers_of_points(samples):
    fit = fit_principal(zigzag(samples, creases=7, closed=True), AMPLITUDE, closed=True)
    assert fit.is_good
    assert fit.deviation < 1
    sums, principal = defects(fit.vertices, closed=True)
    assert sums < 1e-12
    assert principal < 1e-12


def test_closed_fits_recover_a_closed_march():
    given = march_closed(ring(61), HALF, numbers(2, -1), numbers(2, 1))
    assert fit_principal(given, AMPLITUDE, closed=True).deviation < 0.01


def test_free_rims_are_smooth():
    rims = fit_principal(zigzag(121), AMPLITUDE).vertices[[0, -1]]
    lengths = np.linalg.norm(np.diff(rims, axis=1), axis=-1)
    assert np.abs(np.diff(lengths, n=2, axis=1)).max() < 0.02 * lengths.mean()


def test_creases_have_no_checkerboard():
    lengths = np.linalg.norm(np.diff(fit_principal(zigzag(121), AMPLITUDE).vertices, axis=1), axis=-1)[1:-1]
    alternating = np.diff(lengths, n=4, axis=1) / 16
    assert np.abs(alternating[:, 3:-3]).max() < 1e-3 * lengths.mean()


def test_fits_move_with_their_guides():
    guides = zigzag(40)
    turn, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))
    turn *= np.linalg.det(turn)
    moved = fit_principal(3 * guides @ turn.T + [10, -20, 30], 3 * AMPLITUDE)
    still = fit_principal(guides, AMPLITUDE)
    assert moved.deviation == pytest.approx(still.deviation, abs=1e-3)


def test_hopeless_guides_end_with_a_reason():
    crumpled = zigzag(30, creases=5) + np.random.default_rng(2).normal(scale=8, size=(5, 30, 3))
    fit = fit_principal(crumpled, AMPLITUDE)
    assert not fit.is_good
    assert fit.message


def test_candidates_are_lazy_and_never_none():
    attempts = fit_candidates(zigzag(30, creases=3), AMPLITUDE)
    assert next(attempts).vertices.shape == (3, 30, 3)


def test_guides_of_the_wrong_shape_are_refused():
    with pytest.raises(InvalidDesign, match="shape"):
        fit_principal(np.zeros((2, 30, 3)), AMPLITUDE)

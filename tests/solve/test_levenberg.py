"""Levenberg–Marquardt reaches minima, survives singular matrices and always ends with a reason."""

import numpy as np
import pytest

from plisse.leastsquares.kernel import Kernel, Rows, Term
from plisse.leastsquares.levenberg import Status, levenberg_marquardt
from plisse.leastsquares.problem import Problem

POINT = (Rows("point", np.array([0])),)
KEYS = {"point": (2, np.array([0]))}


def term(residual, gradient):
    """A term on one point of the plane whose kernel stays out of the library's register."""
    return Term("test", Kernel("test", residual, gradients=lambda p: (gradient(p),)), POINT)


VALLEY = term(lambda p: 10 * (p[1] - p[0] ** 2), lambda p: np.array([-20 * p[0], np.full_like(p[0], 10)]))
SLOPE = term(lambda p: 1 - p[0], lambda p: np.array([-np.ones_like(p[0]), np.zeros_like(p[0])]))


def at(x, y):
    return {"point": np.array([[x], [y]])}


def test_rosenbrock_valley_is_followed_to_its_minimum():
    found = levenberg_marquardt(Problem([VALLEY, SLOPE], KEYS), at(-1.2, 1.0), iterations=100)
    np.testing.assert_allclose(found.blocks["point"].ravel(), 1, atol=1e-9)
    assert found.status is Status.CONVERGED


def test_cost_never_rises_and_every_step_is_recorded():
    found = levenberg_marquardt(Problem([VALLEY, SLOPE], KEYS), at(-1.2, 1.0), iterations=100)
    assert (np.diff(found.history) <= 0).all()
    assert len(found.history) == found.iterations + 1
    assert found.factorisations >= found.iterations


def test_iterations_are_a_budget():
    found = levenberg_marquardt(Problem([VALLEY, SLOPE], KEYS), at(-1.2, 1.0), iterations=3)
    assert (found.iterations, found.status) == (3, Status.EXHAUSTED)


def test_convergence_is_quadratic_where_residuals_vanish():
    found = levenberg_marquardt(Problem([VALLEY, SLOPE], KEYS), at(0.9, 0.8), iterations=50, damping=1e-14)
    assert found.iterations < 8
    assert found.history[-1] < 1e-25


def test_unknowns_without_any_influence_stay_where_they_are():
    found = levenberg_marquardt(Problem([SLOPE], KEYS), at(3.0, 7.0))
    assert found.status is Status.CONVERGED
    np.testing.assert_allclose(found.blocks["point"].ravel(), [1, 7], atol=1e-9)


def test_a_vanishing_jacobian_ends_the_iteration():
    dead = term(lambda p: 1 + 0 * p[0], lambda p: 0 * p)
    found = levenberg_marquardt(Problem([dead], KEYS), at(0.0, 0.0))
    assert (found.iterations, found.status) == (0, Status.CONVERGED)


def test_wrong_derivatives_stall_after_a_bounded_number_of_trials():
    uphill = term(lambda p: 1 + p[0] ** 2, lambda p: np.array([np.ones_like(p[0]), np.zeros_like(p[0])]))
    found = levenberg_marquardt(Problem([uphill], KEYS), at(0.0, 0.0))
    assert (found.iterations, found.status) == (0, Status.STALLED)
    assert found.factorisations < 30


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_start_that_is_not_finite_is_refused(bad):
    found = levenberg_marquardt(Problem([SLOPE], KEYS), at(bad, 0.0))
    assert (found.iterations, found.status) == (0, Status.NOT_FINITE)


def test_steps_into_undefined_places_are_rejected():
    logarithm = term(lambda p: np.log(np.where(p[0] > 0, p[0], np.nan)),
                     lambda p: np.array([1 / p[0], np.zeros_like(p[0])]))
    found = levenberg_marquardt(Problem([logarithm], KEYS), at(10.0, 0.0), iterations=60)
    assert found.blocks["point"][0, 0] == pytest.approx(1, abs=1e-9)


def test_frozen_data_are_renewed_before_every_step():
    seen = []
    problem = Problem([VALLEY, SLOPE], KEYS)

    def renew(blocks):
        seen.append(blocks["point"].copy())
        return problem

    found = levenberg_marquardt(problem, at(-1.2, 1.0), iterations=5, renew=renew)
    assert len(seen) == found.iterations == 5
    assert not np.array_equal(seen[0], seen[1])


def test_every_status_says_a_sentence_of_its_own():
    assert len({status.value for status in Status}) == len(Status)
    assert all(" " in status.value for status in Status)

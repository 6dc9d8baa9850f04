"""Assembly on fixed patterns and both factorisations agree with dense linear algebra."""

import numpy as np
import pytest
from scipy.sparse import coo_array

from plisse.leastsquares import GramPattern, NotPositiveDefinite, factoriser
from plisse.leastsquares.factor import Banded, Sparse

SIZE, COLUMNS, ENTRIES = 30, 80, 400


def random_entries(components, seed=0):
    """Rows, columns and values of a random matrix, no entry given twice."""
    rng = np.random.default_rng(seed)
    row, column = np.divmod(rng.choice(SIZE * COLUMNS, ENTRIES, replace=False), COLUMNS)
    return row, column, rng.normal(size=(components, ENTRIES))


def dense(row, column, values):
    return sum(coo_array((part, (row, column)), shape=(SIZE, COLUMNS)).toarray()
               @ coo_array((part, (row, column)), shape=(SIZE, COLUMNS)).toarray().T for part in values)


def lower(pattern, entries):
    matrix = np.zeros((SIZE, SIZE))
    matrix[pattern.rows, pattern.columns] = entries
    return matrix


@pytest.mark.parametrize("components", [1, 3])
def test_assembled_gram_matrix_is_the_product(components):
    row, column, values = random_entries(components)
    pattern = GramPattern(row, column, SIZE)
    expected = np.tril(dense(row, column, values))
    np.testing.assert_allclose(lower(pattern, pattern.assemble(values)), expected, atol=1e-13)


def test_pattern_is_sorted_and_knows_its_diagonal_and_bandwidth():
    row, column, _ = random_entries(1)
    pattern = GramPattern(row, column, SIZE)
    assert (np.diff(pattern.columns * SIZE + pattern.rows) > 0).all()
    np.testing.assert_array_equal(pattern.rows[pattern.diagonal], np.arange(SIZE))
    assert pattern.bandwidth == (pattern.rows - pattern.columns).max()


@pytest.mark.parametrize("kind", [Banded, Sparse])
def test_factors_solve_like_dense_ones(kind):
    row, column, values = random_entries(3)
    pattern = GramPattern(row, column, SIZE)
    right = np.random.default_rng(5).normal(size=SIZE)
    solution = kind(pattern).factor(pattern.assemble(values)).solve(right)
    expected = np.linalg.solve(dense(row, column, values), right)
    np.testing.assert_allclose(solution, expected, rtol=0, atol=1e-11 * np.abs(expected).max())


def test_banded_factor_refuses_indefinite_matrices():
    pattern = GramPattern(np.array([0, 1]), np.array([0, 1]), 2)
    with pytest.raises(NotPositiveDefinite):
        Banded(pattern).factor(np.array([1.0, -1.0]))


def test_sparse_factor_refuses_singular_matrices():
    pattern = GramPattern(np.array([0, 1]), np.array([0, 1]), 2)
    with pytest.raises(NotPositiveDefinite):
        Sparse(pattern).factor(np.array([1.0, 0.0]))


def test_narrow_patterns_are_banded_and_scattered_ones_sparse():
    index = np.arange(2000)
    chain = GramPattern(np.concatenate([index, index[1:]]), np.concatenate([index, index[:-1]]), 2000)
    far = GramPattern(np.concatenate([index, index[:1000]]), np.concatenate([index, index[1000:]]), 2000)
    assert isinstance(factoriser(chain), Banded)
    assert isinstance(factoriser(far), Sparse)

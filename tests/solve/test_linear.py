"""Assembly on fixed patterns and all factorisations agree with dense linear algebra."""

import os
import sys
from importlib.util import find_spec

import numpy as np
import pytest
from scipy.sparse import coo_array

from plisse.leastsquares import GramPattern, NotPositiveDefinite, factoriser
from plisse.leastsquares.banded import Band, Banded
from plisse.leastsquares.sparse import Sparse
from plisse.leastsquares.supernodal import Supernodal
from plisse.solve.constraints import Constraints
from plisse.structure.grid import grid
from plisse.structure.topology import Topology

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
    assert pattern.count == len(pattern.rows)


needs_rslab = pytest.mark.skipif(find_spec("rslab") is None, reason="rslab is not installed (plisse[fast])")
KINDS = [pytest.param(lambda pattern: Banded(Band(pattern)), id="banded"),
         pytest.param(lambda pattern: Banded(Band.narrow(pattern)), id="reordered"),
         pytest.param(Sparse, id="superlu"),
         pytest.param(Supernodal, id="rslab", marks=needs_rslab)]


def structure_matrix(seed=0):
    """Pattern and entries of J Jᵀ for a crumpled grid with two holes, and its dense form."""
    whole = grid(9, 14)
    keep = np.ones(len(whole.quads), bool)
    keep[[17, 18, 60]] = False
    rows, columns = np.divmod(np.arange(whole.vertex_count), 14)
    flat = np.stack([rows, columns + 0.3 * (-1.0) ** rows, 0.5 * (-1.0) ** rows])
    vertices = flat + 0.05 * np.random.default_rng(seed).normal(size=flat.shape)
    constraints = Constraints(Topology(whole.vertex_count, whole.quads[keep]))
    pattern = constraints._pattern
    entries = pattern.assemble(constraints.jacobian(vertices))
    lower_half = np.zeros((pattern.size, pattern.size))
    lower_half[pattern.rows, pattern.columns] = entries
    return pattern, entries, lower_half + np.tril(lower_half, -1).T


@pytest.mark.parametrize("kind", KINDS)
def test_factors_solve_like_dense_ones(kind):
    row, column, values = random_entries(3)
    pattern = GramPattern(row, column, SIZE)
    right = np.random.default_rng(5).normal(size=SIZE)
    solution = kind(pattern).factor(pattern.assemble(values)).solve(right)
    expected = np.linalg.solve(dense(row, column, values), right)
    np.testing.assert_allclose(solution, expected, rtol=0, atol=1e-11 * np.abs(expected).max())


@pytest.mark.parametrize("kind", KINDS)
def test_factors_solve_the_conditions_of_a_structure_with_holes(kind):
    pattern, entries, full = structure_matrix()
    right = np.random.default_rng(5).normal(size=pattern.size)
    solution = kind(pattern).factor(entries).solve(right)
    # round-off grows with the condition of the matrix
    np.testing.assert_allclose(solution, np.linalg.solve(full, right), rtol=0,
                               atol=1e-15 * np.linalg.cond(full) * np.abs(solution).max())


@pytest.mark.parametrize("kind", KINDS)
def test_products_are_factorised_like_their_entries(kind):
    row, column, values = random_entries(3)
    pattern, right = GramPattern(row, column, SIZE), np.ones(SIZE)
    solution = kind(pattern).factor_product(values, 0.7).solve(right)
    expected = np.linalg.solve(dense(row, column, values) + 0.7 * np.eye(SIZE), right)
    np.testing.assert_allclose(solution, expected, rtol=0, atol=1e-12 * np.abs(expected).max())


@pytest.mark.parametrize("kind", KINDS)
def test_one_factoriser_serves_many_matrices(kind):
    pattern, entries, full = structure_matrix()
    _, others, other = structure_matrix(seed=1)
    prepared, right = kind(pattern), np.ones(pattern.size)
    first = prepared.factor(entries)
    second = prepared.factor(others)
    for factor, matrix in ((first, full), (second, other)):
        assert np.abs(matrix @ factor.solve(right) - right).max() < 1e-13 * np.linalg.cond(matrix)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("diagonal", [(1.0, -1.0), (1.0, 0.0), (np.nan, 1.0)])
def test_what_is_not_positive_definite_is_refused(kind, diagonal):
    pattern = GramPattern(np.array([0, 1]), np.array([0, 1]), 2)
    with pytest.raises(NotPositiveDefinite):
        kind(pattern).factor(np.array(diagonal))


@pytest.mark.parametrize("kind", KINDS)
def test_nearly_singular_matrices_are_refused_or_solved(kind):
    pattern = GramPattern(np.array([0, 1, 1]), np.array([0, 0, 1]), 2)
    for excess in 10.0 ** -np.arange(10, 25):
        entries = np.array([1.0, 1.0, 1.0 + excess])  # the second row repeats the first but for the excess
        try:
            solution = kind(pattern).factor(entries).solve(np.array([1.0, 2.0]))
        except NotPositiveDefinite:
            assert excess < 1e-12
            continue
        residual = np.array([[1, 1], [1, 1 + excess]]) @ solution - [1.0, 2.0]
        assert np.abs(residual).max() <= 1e-14 * np.abs(solution).max()


def test_a_narrow_order_is_found_for_shuffled_grids():
    size, width = 4000, 5
    shuffled = np.random.default_rng(3).permutation(size)
    index = np.arange(size)
    chain = GramPattern(shuffled[np.concatenate([index, index[width:]])],
                        np.concatenate([index, index[:-width]]), size)
    assert Band(chain).bandwidth > 100 * width
    assert Band.narrow(chain).bandwidth <= 2 * width
    assert isinstance(factoriser(chain), Banded)


def test_scattered_patterns_are_sparse():
    row, column = np.random.default_rng(2).integers(0, 3000, (2, 9000))
    scattered = GramPattern(np.concatenate([row, np.arange(3000)]), np.concatenate([column, np.arange(3000)]), 3000)
    assert isinstance(factoriser(scattered), Sparse if find_spec("rslab") is None else Supernodal)


def test_without_rslab_superlu_takes_its_place(monkeypatch):
    monkeypatch.setitem(sys.modules, "rslab", None)
    row, column = np.random.default_rng(2).integers(0, 3000, (2, 9000))
    scattered = GramPattern(np.concatenate([row, np.arange(3000)]), np.concatenate([column, np.arange(3000)]), 3000)
    assert isinstance(factoriser(scattered), Sparse)


@needs_rslab
def test_a_forked_process_does_without_rslab(monkeypatch):
    pattern, entries, full = structure_matrix()
    prepared = Supernodal(pattern)
    monkeypatch.setattr(os, "getpid", lambda: -1)
    right = np.ones(pattern.size)
    assert np.abs(full @ prepared.factor(entries).solve(right) - right).max() < 1e-13 * np.linalg.cond(full)

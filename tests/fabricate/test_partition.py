"""Few parts with short borders, on chains and on any graph."""

import numpy as np
import pytest

from plisse.fabricate.partition import Regions, partition


def chain(count):
    pairs = np.stack([np.arange(count - 1), np.arange(1, count)], axis=1)
    return Regions(np.ones(count), pairs, np.ones(count - 1))


def grid(rows, columns):
    index = np.arange(rows * columns).reshape(rows, columns)
    pairs = np.concatenate([np.stack([index[:, :-1], index[:, 1:]], -1).reshape(-1, 2),
                            np.stack([index[:-1], index[1:]], -1).reshape(-1, 2)])
    return Regions(np.ones(rows * columns), pairs, np.ones(len(pairs)))


@pytest.mark.parametrize(("count", "largest"), [(10, 3), (12, 4), (7, 7), (9, 1)])
def test_a_chain_falls_into_as_few_parts_as_possible_and_they_are_even(count, largest):
    parts = partition(chain(count), lambda some: some.sum() <= largest)
    sizes = [int(part.sum()) for part in parts]
    assert len(parts) == -(-count // largest)
    assert max(sizes) - min(sizes) <= 1
    assert np.array_equal(np.sum(parts, axis=0), np.ones(count))


def test_among_equally_few_parts_the_shortest_borders_win():
    regions = Regions(np.ones(10), chain(10).pairs, np.where(np.arange(9) == 5, 0.1, 1.0))
    first, second = partition(regions, lambda some: some.sum() <= 7)
    assert {int(first.sum()), int(second.sum())} == {6, 4}


def test_chains_may_be_numbered_in_any_order():
    order = np.random.default_rng(3).permutation(20)
    regions = Regions(np.ones(20), order[chain(20).pairs], np.ones(19))
    parts = partition(regions, lambda some: some.sum() <= 5)
    assert [int(part.sum()) for part in parts] == [5, 5, 5, 5]
    for part in parts:
        assert len(regions.components(part)) == 1


def test_graphs_fall_into_connected_good_parts_with_little_border():
    regions = grid(8, 12)
    parts = partition(regions, lambda some: some.sum() <= 24)
    assert np.array_equal(np.sum(parts, axis=0), np.ones(96))
    for part in parts:
        assert part.sum() <= 24 and len(regions.components(part)) == 1
    assert len(parts) <= 6
    assert sum(regions.border(part) for part in parts) / 2 < 60


def test_what_is_good_as_a_whole_stays_whole():
    part, = partition(grid(4, 5), lambda some: True)
    assert part.all()

"""Masks in a ring, whose last strip borders on the first: where they are cut open does not matter."""

import numpy as np
import pytest

from plisse.structure.grid import grid
from plisse.structure.masks import cleaned, grown, largest_piece


@pytest.mark.parametrize("seams", [(), (4, 9)])
def test_cleaning_a_ring_commutes_with_turning_it(seams):
    rng = np.random.default_rng(3)
    for _ in range(20):
        mask = rng.random((14, 17)) < 0.8
        turned = cleaned(np.roll(mask, 5, axis=0), False, seams, is_ring=True)
        assert (np.roll(cleaned(mask, False, seams, is_ring=True), 5, axis=0) == turned).all()


def test_what_is_left_of_a_ring_is_a_surface_in_one_piece():
    rng = np.random.default_rng(5)
    for _ in range(10):
        mask = cleaned(rng.random((14, 17)) < 0.8, False, is_ring=True)
        topology = grid(14, 18, closed_family=True, mask=mask)
        fans = np.bincount(topology.edges.vertices[topology.edges.is_boundary].ravel(), minlength=topology.vertex_count)
        assert set(fans) <= {0, 2}  # no vertex on two rims at once
        assert (largest_piece(mask, False, is_ring=True) == mask).all()


def test_growing_and_pieces_go_around_a_ring():
    mask = np.zeros((6, 5), bool)
    mask[0, 2] = True
    assert grown(mask, False, 1, is_ring=True)[[5, 0, 1], 1:4].all()
    mask[5, 2] = mask[4, 2] = mask[2, 2] = True
    assert largest_piece(mask, False, is_ring=True).sum() == 3
    assert largest_piece(mask, False).sum() == 2


def test_the_largest_piece_of_a_closed_mask_is_not_the_one_that_goes_around():
    mask = np.zeros((4, 6), bool)
    mask[0] = True
    mask[2:, :4] = True
    assert not largest_piece(mask, True)[0].any()

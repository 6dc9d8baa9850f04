"""Where a motion runs into itself."""

import numpy as np
import pytest

from plisse.measure.intersection import intersecting_faces
from plisse.structure.exact import alternating_cones, conic_creases, conical_vertex, miura
from plisse.structure.pleated import PleatedStructure


@pytest.mark.parametrize("structure", [miura(), conical_vertex()], ids=["miura", "vertex"])
def test_what_folds_flat_without_collision_is_free_all_the_way(structure):
    free = structure.flex(100).free_range
    assert (free.low, free.high, free.collisions) == (0.0, 200.0, ())


def test_a_long_pleat_rolls_up_until_its_ends_meet():
    """Cones over the sector ψ of the sheet: the roll is full where the sector in space reaches 2π."""
    cones = alternating_cones(6, 40, sector=4.6, slope=0.5)
    free = cones.flex(100).free_range
    assert free.low == 0
    assert 100 < free.high < 200
    just_before, just_after = cones.flex([free.high - 0.05, free.high + 0.05]).vertices
    assert len(intersecting_faces(cones.topology, just_before)) == 0
    assert len(intersecting_faces(cones.topology, just_after)) > 0
    step = _turn_of_first_crease(just_before.reshape(6, 40, 3))
    assert abs(39 * step - 2 * np.pi) < 0.05  # ends of slanted strips meet a little earlier than their creases
    assert f"above {free.high:.1f} % faces run into each other" in free.collisions[0]


def _turn_of_first_crease(rows):
    edges = np.diff(rows[0], axis=0)
    cosine = np.einsum("ei,ei->e", edges[1:], edges[:-1]) / np.einsum("ei,ei->e", edges[1:], edges[1:])
    return float(np.arccos(cosine).mean())


def test_percents_are_tested_for_lying_in_the_free_range():
    free = conic_creases(6, 60).flex(100).free_range
    assert 100 in free
    assert 0 in free
    assert 200 not in free or free.high == 200


def test_a_structure_that_cuts_through_itself_as_designed_has_no_free_range():
    cones = alternating_cones(4, 40, sector=6.9)
    free = PleatedStructure(cones.topology, cones.vertices).flex(100).free_range
    assert free.low == free.high == 100
    assert "designed state itself" in free.collisions[0]

"""Scales: round, monotone, and honest about what is exact."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from plisse.draw.scale import defect_scale, linear_scale


@given(st.floats(-1e3, 1e3), st.floats(1e-3, 1e6))
def test_a_straight_scale_holds_its_values_and_has_few_round_ticks_in_order(low, length):
    scale = linear_scale(low, low + length)
    slack = 1e-8 * (abs(low) + length)  # round numbers may be met, not only passed
    assert scale.low <= low + slack and scale.high >= low + length - slack
    places = [place for place, _ in scale.ticks()]
    assert 2 <= len(places) <= 8
    assert all(-1e-6 <= place <= 1 + 1e-6 for place in places) and (np.diff(places) > 0).all()


def test_what_is_exact_ends_at_the_limit_and_what_is_not_begins_there():
    assert defect_scale(3e-15).high == defect_scale(1e-9).high == defect_scale(2e-5).low == 1e-9
    rough = defect_scale(0.5)
    assert not rough.logarithmic and rough.low == 0 and rough.high >= 0.5


def test_shares_and_values_undo_each_other_and_unknown_stays_unknown():
    for scale in (defect_scale(1e-12), defect_scale(1e-4), linear_scale(3, 47)):
        shares = np.linspace(0, 1, 11)
        assert np.allclose(scale.shares(scale.values(shares)), shares, atol=1e-12)
        assert np.isnan(scale.shares(np.array([np.nan]))).all()
        assert scale.shares(np.array([0.0, 1e9])).tolist() == [0, 1]

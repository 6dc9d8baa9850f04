"""A study of small designs, made in some ten milliseconds each."""

import pytest


def small_study(**keys) -> dict:
    """A plan of cones in closed form; `keys` replace or add parts of it."""
    return {"base": {"closed_form": {"kind": "cones", "creases": 4, "samples": 12, "sector": 90}},
            "vary": {"closed_form.slope": [0.5, 1.0], "closed_form.width": [4, 6, 8]}, **keys}


@pytest.fixture
def study() -> dict:
    return small_study()

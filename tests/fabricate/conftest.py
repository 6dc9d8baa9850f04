"""Developments that overlap themselves, laid out on sheets once for all tests."""

import pytest

import plisse
from plisse.fabricate import sheets
from plisse.shipped import find_design


@pytest.fixture(scope="session")
def spiral():
    """Fig. 27, a development that winds over itself."""
    return plisse.design(find_design("fig27")).structure


@pytest.fixture(scope="session")
def ring():
    """Fig. 19, a closed structure whose development winds over itself twice."""
    return plisse.design(find_design("fig19")).structure


@pytest.fixture(scope="session")
def plans(spiral, ring):
    """Both on sheets of a laser cutter."""
    return {"fig27": sheets(spiral, material=(600.0, 300.0)), "fig19": sheets(ring, material=(600.0, 300.0))}

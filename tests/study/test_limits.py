"""Limits of single designs, in the process that makes them."""

import os
import signal
import sys
import threading
import time

import pytest

from plisse.study.isolated import Workshop
from plisse.study.plan import Limits
from plisse.study.plan import read_plan
from plisse.study.samples import samples

CURVED = {"curve": {"kind": "arc", "radius": 100, "angle": 90},
          "pattern": {"theta": 20, "creases": 40, "width": 1, "amplitude": 1, "samples": 2000}}


@pytest.fixture(scope="module")
def small():
    from tests.study.conftest import small_study

    return samples(read_plan(small_study()))[0].recipe


@pytest.fixture
def workshop():
    workshop = Workshop()
    yield workshop
    workshop.close()


def test_limits_of_time_and_memory_are_outcomes_with_reasons_and_the_rest_goes_on(workshop, small):
    assert workshop.made(small, Limits()).status == "exact"
    if sys.platform == "linux":  # elsewhere memory is only looked at twenty times a second
        outcome = workshop.made(CURVED, Limits(memory=0.02))
        assert outcome.status == "memory" and "more than 0.02 GiB" in outcome.reasons[0]
        assert not workshop.is_usable

"""Limits of single designs, in the process that makes them."""

import sys
import threading
import time

import psutil
import pytest

from plisse.study.isolated import Workshop
from plisse.study.plan import Limits, read_plan
from plisse.study.samples import samples

LARGE = {"curve": {"kind": "arc", "radius": 100, "angle": 90},
         "pattern": {"theta": 20, "creases": 40, "width": 1, "amplitude": 1, "samples": 2000}}


@pytest.fixture
def workshop():
    workshop = Workshop()
    yield workshop
    workshop.close()


@pytest.fixture
def small(study):
    return samples(read_plan(study))[0].recipe


def test_too_much_memory_and_an_impossible_recipe_are_outcomes_with_their_reason(workshop, small):
    assert workshop.made(small, Limits()).status == "exact"
    assert "kind" in workshop.made({"closed_form": {"kind": "none"}}, Limits()).reasons[0]
    if sys.platform == "linux":  # elsewhere memory is only looked at, twenty times a second
        outcome = workshop.made(LARGE, Limits(memory=0.05, seconds=30))
        assert outcome.status == "memory" and "more than 0.05 GiB" in outcome.reasons[0]
        assert not workshop.is_usable


def test_too_much_time_ends_the_process(workshop):
    outcome = workshop.made(LARGE, Limits(seconds=0.01))
    assert outcome.status == "timeout" and "more than 0.01 seconds" in outcome.reasons[0]
    assert not workshop.is_usable


def test_a_process_that_is_gone_before_it_has_started_is_worth_another_attempt(workshop, small):
    psutil.Process(workshop.pid).kill()
    outcome = workshop.made(small, Limits())
    assert outcome.status == "died" and "does not start: it ended with code" in outcome.reasons[0]


def test_a_process_killed_from_outside_is_worth_another_attempt(workshop, small):
    workshop.made(small, Limits())
    found = []
    thread = threading.Thread(target=lambda: found.append(workshop.made(LARGE, Limits())))
    thread.start()
    time.sleep(0.5)
    psutil.Process(workshop.pid).kill()
    thread.join()
    assert found[0].status == "died" and "ended with code" in found[0].reasons[0]

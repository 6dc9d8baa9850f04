"""Designs that are handed out together."""

from concurrent.futures import Future
from itertools import pairwise

import pytest

from plisse.study.batch import TOGETHER, Post, how_many
from plisse.study.crew import crew
from plisse.study.plan import Limits


def test_designs_go_alone_until_they_are_known_to_be_quick():
    assert how_many([], waiting=1000, workers=2) == 1
    assert how_many([2 * TOGETHER], waiting=1000, workers=2) == 1
    assert how_many([TOGETHER / 10] * 7 + [TOGETHER], waiting=1000, workers=2) == 1  # the slowest of them counts
    assert how_many([TOGETHER / 10] * 8, waiting=1000, workers=2) == 10


def test_the_last_designs_are_shared_among_all_workers():
    handed = []
    while sum(handed) < 100:
        handed.append(how_many([0.01], waiting=100 - sum(handed), workers=4))
    assert all(after <= before for before, after in pairwise(handed))
    assert handed[:1] == [12] and handed[-4:] == [1] * 4


@pytest.mark.parametrize("recipe, status", [({"closed_form": {"kind": "cones", "creases": 4, "samples": 12}}, "exact"),
                                            ({"closed_form": {"kind": "none"}}, "invalid")])
def test_every_outcome_of_a_batch_comes_before_its_end_in_the_order_of_the_designs(recipe, status):
    with crew(workers=1) as running:
        with Post(running.client, Limits(), False) as post:
            batch, came = post.send([(f"{k}", recipe) for k in range(5)]), []
            while not batch.future.done():
                came += [(key, outcome.status) for key, outcome in post.outcomes(0.5)]
            came += [(key, outcome.status) for key, outcome in post.outcomes(0.0)]
        assert came == [(f"{k}", status) for k in range(5)] and list(batch.left) == [key for key, _ in came]


class Listener:
    """A client that only knows who listens."""

    status, topics = "running", ()

    def subscribe_topic(self, topic, handler):
        self.topics = {*self.topics, topic}

    def unsubscribe_topic(self, topic):
        self.topics = {*self.topics} - {topic}

    def submit(self, *_, **__):
        return Future()


def test_nobody_listens_any_more_when_all_batches_are_done():
    client = Listener()
    with Post(client, Limits(), False) as post:
        for _ in range(2):
            post.send([("key", {})])
        assert len(client.topics) == 1
    assert not client.topics
    client.status = "closed"  # and a client that is gone is told nothing
    with Post(client, Limits(), False) as post:
        post.send([("key", {})])
    assert client.topics


def test_what_breaks_while_the_scheduler_is_there_keeps_its_own_error():
    with crew(workers=1) as running, pytest.raises(BrokenPipeError), running.reached("nothing is kept"):
        raise BrokenPipeError

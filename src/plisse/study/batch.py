"""Designs handed to a worker together, for handing out costs as much as a small design; outcomes come one by one."""

from collections.abc import Collection, Iterator
from contextlib import suppress
from queue import Empty, SimpleQueue
from typing import Any
from uuid import uuid4

import msgspec

from plisse.study.isolated import made
from plisse.study.outcome import Outcome
from plisse.study.plan import Limits

__all__ = ["Batch", "Post", "how_many"]

TOGETHER = 0.5  # seconds that the designs of a batch may take in all
BATCH_ENDED = None  # a letter without outcome: there is something to look at
SHARES = 2  # batches at least for every worker, as long as designs wait: all shall end together


class Batch:
    """Designs (key, recipe) at a worker; `left` are those without outcome, the first of them is under way."""

    def __init__(self, designs: list[tuple[str, dict]], future: Any):
        self.left, self.future = dict(designs), future


class Post:
    """Batches go to the workers of a Dask client, and outcomes come back under a topic of our own, within `with`."""

    def __init__(self, client: Any, limits: Limits, forecast: bool):
        self._client, self._terms = client, (limits, forecast)
        self._topic, self._letters = f"plisse-{uuid4().hex}", SimpleQueue[tuple[float, list] | None]()
        self._sent = 0

    def __enter__(self) -> "Post":
        return self

    def __exit__(self, *error: object) -> None:
        if self._sent and self._client.status == "running":
            self._client.unsubscribe_topic(self._topic)

    def send(self, designs: list[tuple[str, dict]]) -> Batch:
        """Hand designs to the next worker that is free."""
        self._sent += 1
        self._client.subscribe_topic(self._topic, self._letters.put)  # again: a scheduler may have been away
        future = self._client.submit(made_in_turn, designs, *self._terms, self._topic, pure=False,
                                     key=f"{self._topic}-{self._sent}")
        future.add_done_callback(lambda future: self._letters.put(BATCH_ENDED))
        return Batch(designs, future)

    def outcomes(self, seconds: float) -> Iterator[tuple[str, Outcome]]:
        """All outcomes that have come; waits some seconds at most, until there is one or a batch has ended."""
        with suppress(Empty):
            letter = self._letters.get(timeout=seconds)
            while True:
                if letter is not BATCH_ENDED:
                    key, outcome = letter[1]
                    yield key, msgspec.msgpack.decode(outcome, type=Outcome)
                letter = self._letters.get_nowait()


def how_many(recent: Collection[float], waiting: int, workers: int) -> int:
    """How many designs to hand out together where recent ones took so many seconds: one, as long as nothing is known."""
    quick = int(TOGETHER / max(recent)) if recent else 1
    return max(1, min(quick, waiting // (SHARES * workers)))


def made_in_turn(designs: list[tuple[str, dict]], limits: Limits, forecast: bool, topic: str) -> None:
    """Make designs one after another, in a worker, and send each outcome as soon as it is known."""
    from distributed import get_worker

    worker = get_worker()
    for key, recipe in designs:
        worker.log_event(topic, (key, msgspec.msgpack.encode(made(recipe, limits, forecast))))

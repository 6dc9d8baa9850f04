"""Designs handed out to workers, and outcomes taken in, until none is left."""

from collections import Counter, deque
from collections.abc import Callable
from time import monotonic

from msgspec.structs import replace

from plisse.errors import PlisseError
from plisse.study.batch import Batch, Post, how_many
from plisse.study.crew import Crew
from plisse.study.outcome import DIED, Outcome
from plisse.study.plan import Limits
from plisse.study.store import Store

__all__ = ["sweep"]

ATTEMPTS = 3
RECENT = 8  # designs whose seconds say how long the next ones may take
LOOK_EVERY, NO_WORKER = 0.5, 0.05  # seconds between looks at what happens besides

Progress = Callable[[str, float], None]


def sweep(crew: Crew, store: Store, limits: Limits, *, forecast: bool = False, progress: Progress | None = None) -> None:
    """Make all designs that wait in the store; every outcome is committed as soon as it is known.

    A design whose worker dies is tried again, three times in all. Raises PlisseError where workers have no plisse
    or the scheduler goes away.
    """
    with crew.reached(f"what is done is kept in {store.directory}"), Post(crew.client, limits, forecast) as post:
        work = _Work(crew, store, post)
        while not work.is_over:
            crew.tend()
            work.hand_out()
            ended = [batch for batch in work.batches if batch.future.done()]  # now: all their outcomes have come
            patience = 0.0 if ended else LOOK_EVERY if work.batches else NO_WORKER
            for key, outcome in post.outcomes(patience):
                work.take_in(key, outcome)
            for batch in ended:
                work.end(batch)
            if progress:
                progress(crew.missing() or work.said, work.done / max(work.total, 1))


class _Work:
    """Designs that wait, batches at the workers, and how far it is."""

    def __init__(self, crew: Crew, store: Store, post: Post):
        self._crew, self._store, self._post = crew, store, post
        self._waiting = store.waiting()[::-1]
        self.total, self.done = len(self._waiting), 0
        self.batches: list[Batch] = []
        self._lost, self._recent = Counter[str](), deque[float](maxlen=RECENT)
        self._start: float | None = None  # when the first design that is done was begun: workers take a while to start

    @property
    def is_over(self) -> bool:
        return not self._waiting and not self.batches

    @property
    def said(self) -> str:
        return _said(self.done, self.total, 0.0 if self._start is None else monotonic() - self._start)

    def hand_out(self) -> None:
        """Give every worker that is free a batch."""
        while self._waiting and sum(not batch.future.done() for batch in self.batches) < self._crew.capacity:
            count = how_many(self._recent, len(self._waiting), self._crew.capacity)
            self.batches.append(self._post.send([self._waiting.pop() for _ in range(count)]))
            self._begin(self.batches[-1])

    def take_in(self, key: str, outcome: Outcome) -> None:
        """Keep an outcome, or let its design wait for another attempt."""
        batch = next((batch for batch in self.batches if key in batch.left), None)
        if batch is None:
            return  # of a worker that was given up
        recipe = batch.left.pop(key)
        self._lost[key] += outcome.status == DIED
        if outcome.status == DIED and self._lost[key] < ATTEMPTS:
            self._waiting.append((key, recipe))
        else:
            self._store.done(key, _given_up(outcome) if outcome.status == DIED else outcome)
            self._recent.append(outcome.seconds)
            self._start = self._start or monotonic() - outcome.seconds
            self.done += 1
        self._begin(batch)

    def end(self, batch: Batch) -> None:
        """Let what a batch leaves behind wait again; the design that was under way has had an attempt."""
        if batch.left:
            first, *rest = batch.left.items()
            self._waiting += rest[::-1]
            batch.left = dict([first])
            self.take_in(first[0], Outcome(status=DIED, reasons=[_loss(batch.future)]))
        self.batches.remove(batch)

    def _begin(self, batch: Batch) -> None:
        if batch.left:
            self._store.begun(next(iter(batch.left)))


def _loss(future) -> str:
    """Why a batch has ended before its last outcome."""
    error = future.exception() if future.status == "error" else None
    if isinstance(error, ModuleNotFoundError):
        raise PlisseError(f"a worker has no {error.name}; install plisse[sweep] where the workers run")
    return f"its worker was lost ({type(error).__name__ if error else future.status})"


def _given_up(outcome: Outcome) -> Outcome:
    return replace(outcome, status="failed", reasons=[f"{reason}, {ATTEMPTS} times in a row" for reason in outcome.reasons])


def _said(done: int, total: int, seconds: float) -> str:
    """How far it is, how fast, and how long it will take."""
    if not done:
        return f"0 of {total} designs"
    left = (total - done) * seconds / done
    pace = f"{done / seconds:.2g} per second" if done > seconds else f"{seconds / done:.2g} s each"
    return f"{done} of {total} designs, {pace}, {_duration(left)} left"


def _duration(seconds: float) -> str:
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02} min" if hours else f"{minutes} min {rest:02} s" if minutes else f"{rest} s"

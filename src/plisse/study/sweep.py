"""Designs handed out to workers, and outcomes taken in, until none is left."""

from collections import Counter
from collections.abc import Callable
from time import monotonic, sleep

from plisse.errors import PlisseError
from plisse.study.crew import Crew
from plisse.study.isolated import made
from plisse.study.outcome import DIED, Outcome
from plisse.study.plan import Limits
from plisse.study.store import Store

__all__ = ["sweep"]

ATTEMPTS = 3
LOOK_EVERY, NO_WORKER = 0.5, 0.05  # seconds between looks at what happens besides

Progress = Callable[[str, float], None]


def sweep(crew: Crew, store: Store, limits: Limits, *, forecast: bool = False, progress: Progress | None = None) -> None:
    """Make all designs that wait in the store; every outcome is committed as soon as it is known.

    A design whose worker dies is tried again, three times in all. Raises PlisseError where workers have no plisse.
    """
    waiting = store.waiting()[::-1]
    total, done, lost = len(waiting), 0, Counter[str]()
    start: float | None = None  # when the first design that is done was begun: workers take a while to start
    running: dict = {}

    def hand_out() -> None:
        while waiting and len(running) < crew.capacity:
            key, recipe = waiting.pop()
            store.begun(key)
            future = crew.client.submit(made, recipe, limits, forecast, pure=False, key=f"{key}-{total}-{lost[key]}")
            running[future] = key, recipe

    while waiting or running:
        crew.tend()
        hand_out()
        for future in _finished(crew.client, list(running)):
            key, recipe = running.pop(future)
            outcome = _outcome(future)
            del future  # not later: Dask tells the scheduler, and what is said next waits for 10 ms
            lost[key] += outcome.status == DIED
            if outcome.status == DIED and lost[key] < ATTEMPTS:
                waiting.append((key, recipe))
                continue
            hand_out()  # nobody shall wait for the disk
            store.done(key, _given_up(outcome) if outcome.status == DIED else outcome)
            done += 1
            start = start or monotonic() - outcome.seconds
        if progress:
            said = _said(done, total, 0.0 if start is None else monotonic() - start)
            progress(crew.missing() or said, done / max(total, 1))


def _finished(client, futures: list) -> list:
    """Those that are done; waits a moment for the first."""
    from distributed import wait

    if not futures:
        sleep(NO_WORKER)
        return []
    try:
        with client.as_current():
            return list(wait(futures, timeout=LOOK_EVERY, return_when="FIRST_COMPLETED").done)
    except TimeoutError:
        return []


def _outcome(future) -> Outcome:
    if future.status == "finished":
        return future.result()
    error = future.exception() if future.status == "error" else None
    if isinstance(error, ModuleNotFoundError):
        raise PlisseError(f"a worker has no {error.name}; install plisse[sweep] where the workers run")
    return Outcome(status=DIED, reasons=[f"its worker was lost ({type(error).__name__ if error else future.status})"])


def _given_up(outcome: Outcome) -> Outcome:
    from msgspec.structs import replace

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

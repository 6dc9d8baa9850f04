"""The process in which designs are made, one after another: `python -m plisse.study.child`.

Jobs come pickled on stdin and answers go pickled to stdout. It ends with the process that started it, and by itself when
there is nothing to do.
"""

import os
import pickle
import queue
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from time import perf_counter

from plisse.errors import Infeasible, InvalidDesign, PlisseError, TooLarge
from plisse.study.outcome import Outcome

__all__ = ["IDLE_SECONDS", "READY", "attempted"]

IDLE_SECONDS = 120.0
READY = "ready"
# made before the clock of the first design runs, and before memory is bounded: libraries want theirs once
WARMING_UP = {"curve": {"kind": "arc", "radius": 100, "angle": 60},
              "pattern": {"creases": 3, "width": 5, "amplitude": 3, "samples": 12}}


def attempted(recipe: dict, memory: int, forecast: bool = False) -> Outcome:
    """The outcome of a recipe in this process, with at most `memory` more bytes; nothing is raised."""
    start = perf_counter()
    try:
        with _bounded(memory):
            outcome = _made(recipe, forecast)
    except PlisseError as error:
        outcome = Outcome(status=_status(error, recipe), reasons=[str(error)])
    except MemoryError:
        outcome = Outcome(status="memory", reasons=[f"it needs more than {memory / 2**30:.3g} GiB of memory; raise "
                                                    "limits.memory, or lower pattern.samples or pattern.creases"])
    except Exception as error:  # one broken design is a row, not the end of a study
        outcome = Outcome(status="failed", reasons=[f"{type(error).__name__}: {' '.join(str(error).split())}"])
    from msgspec.structs import replace

    return replace(outcome, seconds=perf_counter() - start)


def _status(error: PlisseError, recipe: dict) -> str:
    """What a refusal makes of a design: invalid is a mistake of the recipe, all that another worker may do better is not."""
    if isinstance(error, TooLarge):
        return "memory"
    if isinstance(error, Infeasible):
        return "infeasible"
    from plisse.study.samples import mesh_files

    there = all(os.access(file, os.R_OK) for file in mesh_files(recipe).values())
    return "invalid" if isinstance(error, InvalidDesign) and there else "failed"


def _made(recipe: dict, forecast: bool) -> Outcome:
    from plisse.draw.thumbnail import thumbnail
    from plisse.pipeline import design
    from plisse.study.numbers import numbers

    result = design(recipe)
    found = numbers(result.report) | (_foretold(result.design) if forecast else {})
    picture = None if result.structure is None else thumbnail(result.structure)
    return Outcome(status=result.status, reasons=list(result.report.reasons), numbers=found, picture=picture)


def _foretold(recipe) -> dict:
    """What can be said before solving: whether the design is hopeful, and its smallest ruling angle."""
    from math import degrees

    from plisse.errors import Infeasible
    from plisse.layout.guiding import guiding
    from plisse.solve.forecast import forecast

    if getattr(recipe, "curve", None) is None or recipe.pattern is None:
        return {}
    try:
        guide = guiding(recipe.curve, recipe.pattern)
    except Infeasible:
        return {"hopeful": False}
    ahead = forecast(guide.pattern, guide.amplitude, recipe.solve.principal)
    return {"hopeful": ahead.is_hopeful, "min_ruling_deg": degrees(ahead.ruling_angles.min())}


@contextmanager
def _bounded(memory: int) -> Iterator[None]:
    """At most so many more bytes of address space meanwhile, where the system can; elsewhere the parent watches."""
    if sys.platform != "linux":
        yield
        return
    import resource

    import psutil

    before = resource.getrlimit(resource.RLIMIT_AS)
    resource.setrlimit(resource.RLIMIT_AS, (psutil.Process().memory_info().vms + memory, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, before)


def main() -> None:
    """Work off jobs until there are none for a while, or nobody who asks."""
    answers = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # what libraries print must not come between the answers
    jobs: queue.SimpleQueue = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(jobs,), daemon=True).start()
    _made(WARMING_UP, False)
    message: object = READY
    with suppress(queue.Empty):
        while True:
            pickle.dump(message, answers)
            answers.flush()
            message = attempted(*jobs.get(timeout=IDLE_SECONDS))
    os._exit(0)  # at once: the listening thread waits for jobs


def _listen(jobs: queue.SimpleQueue) -> None:
    with os.fdopen(os.dup(0), "rb") as stream:
        try:
            while True:
                jobs.put(pickle.load(stream))
        except (EOFError, OSError, pickle.UnpicklingError):
            os._exit(0)  # whoever asked is gone


if __name__ == "__main__":
    main()

"""How many threads linear algebra may use: one unless said otherwise, because in narrow bands a second one only waits."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache

__all__ = ["bind_threads", "bounded", "child_environment"]

LIBRARIES = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS")
CHOSEN = "PLISSE_THREADS"


def bind_threads(count: int | None = None) -> None:
    """Bound the threads of this process, before NumPy is imported, and of all that it starts.

    Without a count what the environment says stays, and is one where it says nothing.
    """
    for name in LIBRARIES:
        if count is None:
            os.environ.setdefault(name, "1")
        else:
            os.environ[name] = str(count)
    if count is not None:
        os.environ[CHOSEN] = str(count)


def child_environment() -> dict[str, str]:
    """The environment of a process that solves designs beside others: one thread, or as many as were asked for."""
    return {**os.environ, **dict.fromkeys(LIBRARIES, os.environ.get(CHOSEN, "1"))}


@contextmanager
def bounded() -> Iterator[None]:
    """Within it (or a function it decorates) linear algebra keeps to the threads that the environment names, or to one.

    For notebooks and scripts, which import NumPy before anybody could say how many threads it may use.
    """
    count = next((int(value) for name in LIBRARIES if (value := os.environ.get(name, "")).isdigit()), 1)
    with _libraries().limit(limits=count, user_api="blas"):
        yield


@lru_cache(maxsize=1)
def _libraries():
    import scipy.linalg  # noqa: F401  SciPy brings its own
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()

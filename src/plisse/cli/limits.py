"""What a command may use of the machine: `--threads` and `--memory`, shared by all commands that solve."""

from __future__ import annotations

from typing import Annotated

from cyclopts import Parameter

__all__ = ["Memory", "Threads", "bound"]

Threads = Annotated[int | None, Parameter(
    help="Threads for linear algebra, in every process; one if left out, which is fastest for nearly all designs.")]
Memory = Annotated[float | None, Parameter(
    help="Refuse designs that need more memory than so many GB; what the machine has free if left out.")]


def bound(threads: int | None, memory: float | None = None) -> None:
    """Set both limits for this process and those it starts, before NumPy is imported; raises PlisseError for none at all."""
    import os

    from plisse.errors import PlisseError
    from plisse.memory import CHOSEN
    from plisse.threads import bind_threads

    if threads is not None and threads < 1:
        raise PlisseError(f"--threads is {threads}; give a number from 1")
    if memory is not None and not 0 < memory < float("inf"):
        raise PlisseError(f"--memory is {memory:g}; give GB above 0")
    bind_threads(threads)
    if memory is not None:
        os.environ[CHOSEN] = str(memory)

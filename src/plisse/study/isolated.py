"""One design in a process of its own, with limits of time and memory; the process is kept for the next design."""

import os
import pickle
import queue
import socket
import subprocess
import sys
import tempfile
import threading
from collections import deque
from contextlib import suppress
from time import monotonic
from typing import IO

from msgspec.structs import replace

from plisse.study.child import READY
from plisse.study.outcome import DIED, Outcome
from plisse.study.plan import Limits
from plisse.threads import child_environment

__all__ = ["Workshop", "last_words", "made", "prepare", "process_options"]

LOOK_EVERY = 0.05  # seconds between looks at a process's memory
START_SECONDS = 120.0
SLACK = 1.05  # where the system bounds memory itself, that answers first
SMALLER = "lower pattern.samples or pattern.creases"
_idle: deque["Workshop"] = deque()


def made(recipe: dict, limits: Limits, forecast: bool = False) -> Outcome:
    """The outcome of a recipe within limits; whatever happens comes back as a status with its reason."""
    workshop = _ready()
    outcome = workshop.made(recipe, limits, forecast)
    if workshop.is_usable:
        _idle.append(workshop)
    return replace(outcome, worker=f"{socket.gethostname()}:{os.getpid()}")


def prepare() -> None:
    """Start a process for designs before the first one comes."""
    _idle.append(Workshop())


def _ready() -> "Workshop":
    while _idle:
        workshop = _idle.pop()
        if workshop.is_usable:
            return workshop
        workshop.close()
    return Workshop()


def process_options() -> dict:
    """How processes are started: few threads for linear algebra, out of reach of the terminal's Ctrl-C."""
    options: dict = {"env": child_environment()}
    if sys.platform == "win32":
        return options | {"creationflags": subprocess.CREATE_NEW_PROCESS_GROUP}
    return options | {"start_new_session": True}


def last_words(errors: IO[bytes]) -> str:
    """The last line that a process has written, empty where it has written nothing."""
    errors.seek(0)
    lines = errors.read()[-2000:].decode(errors="replace").strip().splitlines()
    return lines[-1].strip() if lines else ""


class Workshop:
    """A process that makes designs, and what is needed to end it in time."""

    def __init__(self) -> None:
        self._errors = tempfile.TemporaryFile()  # noqa: SIM115  lives as long as the process
        self._process = subprocess.Popen([sys.executable, "-m", "plisse.study.child"], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=self._errors, **process_options())
        self._answers: queue.SimpleQueue = queue.SimpleQueue()
        self._listener = threading.Thread(target=self._listen, daemon=True)
        self._listener.start()
        self._waiting_for_start = True

    @property
    def pid(self) -> int:
        """The number of the process."""
        return self._process.pid

    @property
    def is_usable(self) -> bool:
        """Whether the process lives."""
        return self._process.poll() is None

    def made(self, recipe: dict, limits: Limits, forecast: bool = False) -> Outcome:
        """The outcome of a recipe; the process is ended where it takes too long or too much."""
        if self._waiting_for_start:
            self._waiting_for_start = False
            if (answer := self._answered(START_SECONDS)) != READY:
                ended = "" if answer is None else ": it ended"
                return self._ended(DIED, f"the process for designs does not start{ended}")
        try:
            assert self._process.stdin is not None
            pickle.dump((recipe, limits.bytes, forecast), self._process.stdin)
            self._process.stdin.flush()
        except OSError:
            return self._ended(DIED, "the process for designs ended")
        outcome, peak = self._watched(limits)
        if outcome.status == "memory":
            self.close()  # what it holds may be in pieces
        return replace(outcome, memory_mb=peak / 2**20)

    def close(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.wait()
        self._listener.join()
        self._errors.close()
        with suppress(OSError):  # what was written and not read
            self._process.__exit__(None, None, None)

    def _watched(self, limits: Limits) -> tuple[Outcome, int]:
        """The outcome, and the largest memory in bytes that was seen."""
        import psutil

        process, start = psutil.Process(self._process.pid), monotonic()
        before = peak = self._memory(process)
        while True:
            left = start + limits.seconds - monotonic()
            answer = self._answered(min(LOOK_EVERY, max(left, 0.0)))
            if isinstance(answer, Outcome):
                return answer, max(peak, self._memory(process))
            if answer is not None or not self.is_usable:
                return self._ended(DIED, "its process ended"), peak
            peak = max(peak, self._memory(process))
            if left <= 0:
                return self._ended("timeout", f"it takes more than {limits.seconds:g} seconds; raise limits.seconds, "
                                              f"or {SMALLER}", seconds=limits.seconds), peak
            if peak - before > SLACK * limits.bytes:
                return self._ended("memory", f"it needs more than {limits.memory:.3g} GiB of memory; raise limits.memory, "
                                             f"or {SMALLER}", seconds=monotonic() - start), peak

    def _memory(self, process) -> int:
        import psutil

        try:
            return process.memory_info().rss
        except psutil.Error:
            return 0

    def _ended(self, status: str, reason: str, seconds: float = 0.0) -> Outcome:
        if status == DIED:
            with suppress(subprocess.TimeoutExpired):
                reason += f" with code {self._process.wait(timeout=2)}"
            if said := last_words(self._errors):
                reason += f": {said}"
        self.close()
        return Outcome(status=status, reasons=[reason], seconds=seconds)

    def _answered(self, seconds: float) -> object | None:
        """The next answer, None if there is none in time, False when there will be none any more."""
        try:
            return self._answers.get(timeout=seconds) if seconds > 0 else self._answers.get_nowait()
        except queue.Empty:
            return None

    def _listen(self) -> None:
        assert self._process.stdout is not None
        try:
            while True:
                self._answers.put(pickle.load(self._process.stdout))
        except (EOFError, OSError, pickle.UnpicklingError):
            self._answers.put(False)

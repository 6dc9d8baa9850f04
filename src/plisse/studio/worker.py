"""Requests of one client, answered outside of the server's process: the newest wins, a crash ends one request only."""

from __future__ import annotations

import contextlib
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable
from time import monotonic

from plisse.studio.child import Answer, Failure, Stage
from plisse.studio.requests import Request
from plisse.threads import child_environment

__all__ = ["Process", "Spare", "Worker"]

PATIENCE = 2.0  # seconds that a stale request may still take before its process is ended
START = 60.0
LATER = 3.0  # seconds after a spare process was taken until the next one is started
COMMAND = "from plisse.studio.child import main; main(patient={})"

Deliver = Callable[[Request, Answer | Failure | Stage], None]


class Worker:
    """A thread that hands requests to a process and delivers its answers.

    Of every lane only the newest request is kept; the running one is dropped when one that outdates it comes, at once or,
    where it is brief, when it takes long, and its process is ended where it does not listen. `deliver` is called from the
    thread, never for requests that were dropped.
    """

    def __init__(self, deliver: Deliver, start: Callable[[], Process] | None = None):
        self._deliver, self._start = deliver, start or Process
        self._waiting: dict[str, tuple[int, Request]] = {}
        self._changed = threading.Condition()
        self._count = 0
        self._closed = False
        self._process: Process | None = None
        self._thread = threading.Thread(target=self._work, name="plisse-studio-worker", daemon=True)
        self._thread.start()

    def ask(self, request: Request) -> None:
        """Ask for something; older questions that it outdates are forgotten."""
        with self._changed:
            self._count += 1
            for lane in request.outdates:
                self._waiting.pop(lane, None)
            self._waiting[request.lane] = (self._count, request)
            self._changed.notify()

    @property
    def pid(self) -> int | None:
        """Number of the process, None while there is none."""
        process = self._process
        return None if process is None else process.pid

    def close(self) -> None:
        """End the process and the thread; nothing is delivered any more."""
        with self._changed:
            self._closed = True
            self._waiting.clear()
            self._changed.notify()
        process = self._process
        if process is not None:
            process.end()
        self._thread.join(timeout=5)
        if self._process is not None and self._process is not process:
            self._process.end()  # the thread was just starting it

    def _work(self) -> None:
        while (entry := self._next()) is not None:
            number, request = entry
            outcome = self._outcome(number, request)
            if outcome is not None and not self._closed and (request.is_brief or not self._is_stale(request)):
                self._deliver(request, outcome)

    def _next(self) -> tuple[int, Request] | None:
        """The request that has waited longest; blocks until there is one, None when closed."""
        with self._changed:
            self._changed.wait_for(lambda: self._waiting or self._closed)
            if self._closed:
                return None
            return self._waiting.pop(next(iter(self._waiting)))

    def _is_stale(self, request: Request) -> bool:
        with self._changed:
            return any(request.lane in newer.outdates for _, newer in self._waiting.values())

    def _outcome(self, number: int, request: Request) -> Answer | Failure | None:
        """What the request came to; None where it was dropped."""
        if self._process is not None and not self._process.is_alive:
            self._process.end()
            self._process = None
        if self._process is None:
            try:
                self._process = self._start()
            except OSError as error:
                return Failure(number, f"no process can be started ({error.strerror}); close other programs and try again")
        process, begun, told = self._process, monotonic(), False
        process.send(number, request)
        while True:
            message = process.received(0.02)
            if isinstance(message, Stage) and message.number == number and not self._is_stale(request):
                self._deliver(request, message)
            elif isinstance(message, Answer | Failure) and message.number == number:
                return None if isinstance(message, Answer) and message.value is None else message
            if self._closed:
                return None
            if message is None and not process.is_alive:
                self._process = None
                return Failure(number, f"solving ended its process (code {process.end()}); take the last step back, or try "
                                       "something smaller")
            seconds, is_stale = monotonic() - begun, self._is_stale(request)
            grace = PATIENCE if request.is_brief else 0.0
            if is_stale and seconds > grace and not told:
                process.send(number, None)
                told = True
            if seconds > (grace + PATIENCE if is_stale else request.limit + START * process.is_new):
                process.end()
                self._process = None
                return None if is_stale else Failure(
                    number, f"this took longer than {request.limit:.0f} seconds and was ended; try something smaller")


class Process:
    """A process that answers, and the thread that listens to it; patient ones let others go first."""

    def __init__(self, patient: bool = False):
        self._popen = subprocess.Popen([sys.executable, "-c", COMMAND.format(patient)], stdin=subprocess.PIPE,
                                       stdout=subprocess.PIPE, env=child_environment())
        self._messages: queue.SimpleQueue = queue.SimpleQueue()
        self._ended = threading.Event()
        self.is_new = True
        threading.Thread(target=self._listen, name="plisse-studio-listener", daemon=True).start()

    @property
    def pid(self) -> int:
        return self._popen.pid

    @property
    def is_alive(self) -> bool:
        """Whether answers may still come."""
        return not self._ended.is_set()

    def send(self, number: int, request: Request | None) -> None:
        """Hand over a request, or None to drop the one of that number."""
        assert self._popen.stdin is not None
        try:
            pickle.dump((number, request), self._popen.stdin, protocol=5)
            self._popen.stdin.flush()
        except (OSError, ValueError):
            self._ended.set()

    def received(self, seconds: float) -> Answer | Failure | Stage | None:
        """The next message, None where there is none in time."""
        try:
            message = self._messages.get(timeout=seconds)
        except queue.Empty:
            return None
        self.is_new = False
        return message

    def end(self) -> int:
        """End the process; its exit code."""
        self._popen.kill()
        code = self._popen.wait()
        for stream in (self._popen.stdin, self._popen.stdout):
            assert stream is not None
            with contextlib.suppress(OSError):
                stream.close()
        return code

    def _listen(self) -> None:
        try:
            while True:
                self._messages.put(pickle.load(self._popen.stdout))  # type: ignore[arg-type]
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            self._ended.set()


class Spare:
    """A process that is started before somebody needs it, because that takes longer than most of what it is asked for."""

    def __init__(self):
        self._changed = threading.Lock()
        self._process: Process | None = Process()
        self._closed = False
        self._later: threading.Timer | None = None

    def take(self) -> Process:
        """The process that is ready, or else a new one; the next one is started a little later."""
        with self._changed:
            process, self._process = self._process, None
            if not self._closed and (self._later is None or not self._later.is_alive()):
                self._later = threading.Timer(LATER, self._refill)
                self._later.daemon = True
                self._later.start()
        if process is not None and process.is_alive:
            return process
        if process is not None:
            process.end()
        return Process()

    def close(self) -> None:
        """End the process; there will be no next one."""
        with self._changed:
            self._closed = True
            process, self._process = self._process, None
        if self._later is not None:
            self._later.cancel()
        if process is not None:
            process.end()

    def _refill(self) -> None:
        with self._changed:
            if not self._closed and self._process is None:
                self._process = Process()

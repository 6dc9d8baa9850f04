"""The process behind a client: answers one request after the other until its input ends.

Requests and answers are pickled over the standard streams, between processes of one program only.
"""

import os
import pickle
import queue
import signal
import sys
import threading
import traceback
from dataclasses import dataclass
from typing import Any, BinaryIO

from plisse.errors import PlisseError
from plisse.studio.bench import Bench

__all__ = ["Answer", "Failure", "Stage", "main"]

UNFORESEEN = "solving ended with an error that plisse did not foresee"


@dataclass(frozen=True)
class Stage:
    """Work on a request has come so far."""

    number: int
    name: str
    fraction: float


@dataclass(frozen=True, eq=False)
class Answer:
    """What a request came to, after so many seconds; None for a request that was dropped."""

    number: int
    value: Any
    seconds: float = 0.0


@dataclass(frozen=True)
class Failure:
    """Why a request came to nothing, in a sentence."""

    number: int
    sentence: str


class Dropped(BaseException):
    """A newer request has come; nothing between here and the loop may take this for a failure."""


class Child:
    """Requests from one stream, answered on the other."""

    def __init__(self, requests: BinaryIO, answers: BinaryIO):
        self._requests, self._answers = requests, answers
        self._waiting: queue.SimpleQueue = queue.SimpleQueue()
        self._dropped = 0
        self._bench = Bench()

    def run(self) -> None:
        """Answer until there are no more requests."""
        threading.Thread(target=self._listen, daemon=True).start()
        while (entry := self._waiting.get()) is not None:
            self._send(self._answer(*entry))

    def _listen(self) -> None:
        try:
            while True:
                number, request = pickle.load(self._requests)
                if request is None:
                    self._dropped = number
                else:
                    self._waiting.put((number, request))
        except (EOFError, OSError, pickle.UnpicklingError):  # the input ended, maybe in the middle of a request
            pass
        finally:
            self._dropped = sys.maxsize
            self._waiting.put(None)

    def _answer(self, number: int, request) -> Answer | Failure:
        from time import perf_counter

        def progress(stage: str, fraction: float) -> None:
            if number <= self._dropped:
                raise Dropped
            self._send(Stage(number, stage, fraction))

        begun = perf_counter()
        try:
            return Answer(number, request.run(self._bench, progress), perf_counter() - begun)
        except Dropped:
            return Answer(number, None)
        except PlisseError as error:
            return Failure(number, str(error))
        except MemoryError:
            return Failure(number, "this design needs more memory than there is; lower pattern.samples or pattern.creases")
        except Exception as error:
            traceback.print_exc()
            return Failure(number, f"{UNFORESEEN} ({type(error).__name__}); take the last step back")

    def _send(self, message: Answer | Failure | Stage) -> None:
        pickle.dump(message, self._answers, protocol=5)
        self._answers.flush()


def main(patient: bool = False) -> None:
    """Serve on the standard streams; what libraries print goes to the standard error. Patient ones leave others the core."""
    if patient and hasattr(os, "nice"):
        os.nice(10)
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    Child(sys.stdin.buffer, answers).run()

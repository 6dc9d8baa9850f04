"""Seconds per stage, and progress as stages begin."""

import time
from collections.abc import Callable

__all__ = ["Stopwatch"]


class Stopwatch:
    """Measures named stages one after the other and reports each as it begins."""

    def __init__(self, progress: Callable[[str, float], None] | None = None):
        self._progress = progress
        self._begun = self._stage_begun = time.perf_counter()
        self._stage = ""
        self.seconds: dict[str, float] = {}

    def start(self, stage: str, fraction: float) -> None:
        """Ends the running stage and begins another."""
        self._end_stage()
        self._stage = stage
        if self._progress is not None:
            self._progress(stage, fraction)

    def stop(self) -> dict[str, float]:
        """Ends the running stage; seconds per stage and in `total`."""
        self._end_stage()
        self._stage = ""
        if self._progress is not None:
            self._progress("done", 1.0)
        return {**self.seconds, "total": time.perf_counter() - self._begun}

    def _end_stage(self) -> None:
        now = time.perf_counter()
        if self._stage:
            self.seconds[self._stage] = self.seconds.get(self._stage, 0.0) + now - self._stage_begun
        self._stage_begun = now

"""What is waited for: the newest solve, when it is late, a while without changes, and the end of controls."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Iterable
from typing import Any

from plisse.studio.requests import Solve

__all__ = ["Later", "Waiting", "put_away"]

LATE = 0.4  # seconds after which a solve is said to be under way
READ = 5.0  # seconds after which a browser has read what was said of a control


class Later:
    """One action that is to come after some seconds; a new one takes the place of that before."""

    def __init__(self, loop: asyncio.AbstractEventLoop, seconds: float):
        self._loop, self._seconds = loop, seconds
        self._timer: asyncio.TimerHandle | None = None

    def begin(self, action: Callable[[], None]) -> None:
        """Do something when the seconds are over."""
        self.cancel()
        self._timer = self._loop.call_later(self._seconds, action)

    def cancel(self) -> None:
        """Do nothing."""
        if self._timer is not None:
            self._timer.cancel()
            self._timer = None


class Waiting:
    """The solve that was asked for last; `say` is called in the event loop when nothing comes of it for a while."""

    def __init__(self, loop: asyncio.AbstractEventLoop, say: Callable[[], None]):
        self._late, self._say = Later(loop, LATE), say
        self._asked: Solve | None = None
        self.is_late = False

    @property
    def is_over(self) -> bool:
        """Whether nothing is waited for."""
        return self._asked is None

    def begin(self, request: Solve) -> None:
        """Wait for a solve, instead of those before."""
        is_first, self._asked = self.is_over, request
        if is_first:
            self._late.begin(self._grow_late)

    def end(self, request: Solve) -> None:
        """Stop waiting for a solve, and go on waiting where a newer one was asked for."""
        self.cancel()
        self.is_late = False
        if request is self._asked:
            self._asked = None
        elif self._asked is not None:
            self._late.begin(self._grow_late)

    def cancel(self) -> None:
        """Say nothing any more."""
        self._late.cancel()

    def _grow_late(self) -> None:
        self.is_late = True
        self._say()


def put_away(controls: Iterable[Any]) -> None:
    """Hide controls of the page, and remove them later.

    A browser reads what was said of a control after its removal, where both come in one frame, and complains.
    """
    for control in controls:
        control.visible = False
        asyncio.get_running_loop().call_later(READ, _remove, control)


def _remove(control: Any) -> None:
    if not control._impl.removed:  # as all are when the tab is closed
        control.remove()

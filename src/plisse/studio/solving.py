"""Solving a design while it changes: a draft at once where the whole takes longer, the whole when the hand rests."""

from __future__ import annotations

import asyncio
from collections.abc import Callable

from plisse.recipe import Recipe
from plisse.studio.child import Answer, Failure
from plisse.studio.pace import Pace
from plisse.studio.requests import Request, Solve
from plisse.studio.waiting import Later, Waiting

__all__ = ["REST", "Solving"]

REST = 0.08  # seconds without a change before a full answer is asked for


class Solving:
    """The solves that are asked for; `say` is called in the event loop when nothing comes of them for a while."""

    def __init__(self, loop: asyncio.AbstractEventLoop, ask: Callable[[Request], None], say: Callable[[], None]):
        self._ask, self._pace = ask, Pace()
        self._rest, self._waiting = Later(loop, REST), Waiting(loop, say)

    @property
    def is_over(self) -> bool:
        """Whether nothing is waited for."""
        return self._waiting.is_over

    @property
    def is_slow(self) -> bool:
        """Whether solves take so long that their stages are worth saying."""
        return self._waiting.is_late or not self._pace.is_fast

    def begin(self, recipe: Recipe, *, framed: bool, colour: str, at_once: bool = False) -> None:
        """Ask for a recipe instead of that before; `at_once` asks for the whole without waiting for a rest."""
        self._rest.cancel()
        draft, waits = self._pace.draft(recipe), self._pace.waits(recipe)
        if draft is not None:
            self.ask(Solve(draft, drafted=True, colour=colour))
        whole = Solve(recipe, framed=framed, colour=colour, quick=not waits)
        if at_once or not waits:
            self.ask(whole)
        else:
            self._rest.begin(lambda: self.ask(whole))

    def ask(self, request: Solve) -> None:
        """Ask for a solve, and wait for it."""
        self._waiting.begin(request)
        self._ask(request)

    def end(self, request: Solve, message: Answer | Failure) -> None:
        """Take note that a solve has come to an end, and how long it took."""
        self._waiting.end(request)
        if isinstance(message, Answer):
            self._pace.learn(message.value, message.seconds)

    def cancel(self) -> None:
        """Ask for nothing and say nothing any more."""
        self._rest.cancel()
        self._waiting.cancel()

"""One browser tab: its design, its processes, its scene and its panels. All of it runs in the server's event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from plisse.errors import PlisseError
from plisse.io.designs import read_design
from plisse.recipe import Recipe
from plisse.shipped import shipped_design
from plisse.studio.child import Answer, Failure, Stage
from plisse.studio.dress import Dress
from plisse.studio.errands import Errands
from plisse.studio.handles import Handles, control_points_of
from plisse.studio.model import Desk
from plisse.studio.panels import Panels
from plisse.studio.requests import Colour, Found, Pose, Request, Solid, Solve
from plisse.studio.scene import Scene
from plisse.studio.solving import Solving
from plisse.studio.standing import BEGUN, Standing
from plisse.studio.uploads import Uploads
from plisse.studio.waiting import Later
from plisse.studio.worker import Process, Worker
from plisse.transform.collisions import FreeRange

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Tab"]

LONGER = 2.0  # seconds without a change before what takes longer is asked for


class Tab:
    """Everything behind a tab; `close` ends its processes and removes its files."""

    def __init__(self, client: ClientHandle, recipe: Recipe, title: str, *,
                 loop: asyncio.AbstractEventLoop, start: Callable[[], Process] | None = None):
        self.client, self._loop = client, loop
        self.desk = Desk(recipe, title)
        self.standing = Standing()
        self.is_open = True
        self._framed = False
        self._solving, self._longer = Solving(loop, self.ask, self._say_late), Later(loop, LONGER)
        self.free: FreeRange | None = None
        self._hands = Worker(self.deliver, start)
        self._uploads = Uploads(client)
        self.errands = Errands(self)
        self.scene = Scene(client, loop)
        self.dress = Dress(self.scene, self.ask, lambda tint: self.panels.show_scale(tint))
        self.handles = Handles(client, lambda index, place: self.panels.point_moved(index, place),
                               lambda index: self.panels.point_chosen(index))
        self.panels = Panels(self)
        self._solve(at_once=True)

    @property
    def found(self) -> Found | None:
        """What was solved last; None where the newest design broke down."""
        return self.standing.found

    def act(self, action: Callable[[], object], *, framed: bool = True) -> None:
        """Do something with the design and show what it comes to, where it is not `framed` from the best side.

        What is refused is said in a sentence.
        """
        before = self.desk.step
        try:
            action()
        except PlisseError as error:
            self.refuse(str(error))
            return self.panels.refresh()
        if self.desk.step is not before:
            self._framed = self._framed and framed
            self._solve()
        self.forget_refusal()
        return self.panels.refresh()

    def change(self, changes: dict) -> None:
        """Change keys of the design, as `plisse.Session.update` does."""
        self.act(lambda: self.desk.change(changes))

    def open_shipped(self, name: str) -> None:
        """Open a design of the gallery."""
        self.act(lambda: self.desk.open(read_design(shipped_design(name)), name), framed=False)

    def read(self, text: str, title: str = "") -> None:
        """Open a design from its text."""
        self.act(lambda: self.desk.read(text, title), framed=False)

    def pose(self, percent: float) -> None:
        """Show a state of the motion."""
        self.dress.pose(percent)
        self._put_on()
        self.panels.show_chosen()

    def paint(self, name: str) -> None:
        """Lay a colour map over the structure as it was designed, or none for the empty name."""
        self.dress.paint(name)
        self._put_on()
        self.panels.refresh()

    def solidify(self, kind: str, length: float) -> None:
        """Show plates or an offset instead of the structure, or the structure itself for the empty kind."""
        self.dress.solidify(kind, length)
        self._put_on()
        self.panels.refresh()

    def thicken(self, length: float) -> None:
        """Show plates or an offset, where they are chosen, of another thickness or distance."""
        if self.dress.chosen.solid[0]:
            self.dress.thicken(length)
            self._put_on()

    def ask(self, request: Request) -> None:
        """Ask the process that has the result of what is on screen."""
        self._hands.ask(request)

    def say(self) -> None:
        """Say how it is with the design and with what is on screen."""
        self.panels.say(self.standing.status(self.scene.is_pale, self.dress.chosen.percent, self.free))

    def refuse(self, sentence: str) -> None:
        """Say that something was not done; what is on screen stays."""
        self.standing.refusal = sentence
        self.say()

    def forget_refusal(self) -> None:
        """Say no more what was refused last, for something newer was done, or said beside a box."""
        if self.standing.refusal:
            self.standing.refusal = ""
            self.say()

    def say_search(self, step: tuple[str, float] | None) -> None:
        """Say how far a search for layouts has come; None where it has come to its end."""
        self.standing.search = step
        self.say()

    def show_reach(self, free: FreeRange, offsets: tuple[float, float]) -> None:
        """Show how far the structure moves and can be offset."""
        self.free = free
        self.panels.show_reach(free, offsets)
        self.say()

    def show_handles(self) -> None:
        """Put the handles where the control points are."""
        self.handles.show(control_points_of(self.desk.recipe), self.scene.extent[1], self.panels.handles_wanted)

    def deliver(self, request: Request, message: Answer | Failure | Stage) -> None:
        """Take in a message from a process; may be called from any thread."""
        self._loop.call_soon_threadsafe(self._receive, request, message)

    def close(self) -> None:
        """End the processes and remove the files."""
        self.is_open = False
        for stop in (self._solving.cancel, self._longer.cancel, self.scene.close):
            self._loop.call_soon_threadsafe(stop)
        self._hands.close()
        self.errands.close()
        self.desk.close()

    def _solve(self, at_once: bool = False) -> None:
        """Ask for the design on the desk."""
        self._longer.cancel()
        self.dress.carry()
        self._solving.begin(self.desk.solvable, framed=not self._framed, colour=self.dress.chosen.colour, at_once=at_once)

    def _say_late(self) -> None:
        if self.is_open:
            self._say_stage(BEGUN)

    def _say_stage(self, step: tuple[str, float]) -> None:
        self.standing.stage = step
        self.say()

    def _receive(self, request: Request, message: Answer | Failure | Stage) -> None:
        if not self.is_open:
            return None
        if not isinstance(request, Solve | Pose | Solid | Colour):
            return self.errands.receive(request, message)
        if isinstance(message, Stage):
            if isinstance(request, Solve) and self._solving.is_slow:
                self._say_stage((message.name, message.fraction))
            return None
        if isinstance(request, Solve):
            self._solving.end(request, message)
            return self._end_solve(request, message)
        if not self.dress.awaits(request):
            return None
        if isinstance(message, Failure):
            return self._go_back(request, message.sentence)
        return self.dress.take_in(request, message.value)

    def _end_solve(self, request: Solve, message: Answer | Failure) -> None:
        """Show a solve; one of a design that is not wanted any more only while the design is pulled, as a draft."""
        is_final = not request.drafted and request.recipe == self.desk.solvable
        if isinstance(message, Failure):
            return self._break_down(message.sentence) if is_final else None
        if is_final:
            self._show(request, message.value)
            self.dress.complete(message.value, request)
            if message.value.report.principal:
                self._longer.begin(self.errands.measure_reach)
        elif request.is_brief:
            self._show(request, replace(message.value, drafted=True))
        else:
            return None
        return self.panels.refresh()

    def _break_down(self, sentence: str) -> None:
        """Say why there is no structure; what was on screen before is pale."""
        self.dress.pale()
        self.free = None
        self.standing.break_down(sentence)
        self.say()
        self.panels.forget_reach()
        self.panels.refresh()

    def _go_back(self, request: Pose | Solid | Colour, sentence: str) -> None:
        """Go back to what is on screen, and say why where it was asked for and not carried over from another design."""
        self.dress.go_back()
        if isinstance(request, Solid):
            self.panels.fit(self.scene.extent[1])
        if self.dress.is_carried:
            self.say()
        else:
            self.refuse(sentence)
        self.panels.refresh()

    def _show(self, request: Solve, found: Found) -> None:
        self.free = None
        self.standing.find(found, self.desk.step.title)
        self.dress.put_on_new(found, request)
        if not self.scene.is_pale:
            self.standing.seen = found
        if request.framed and found.folded is not None:
            self._framed = True
            self.scene.frame()
            self.panels.fit(self.scene.extent[1])
        elif not self.handles.is_pulled:
            self.scene.follow()
        self.show_handles()
        self.say()
        self.panels.forget_reach()

    def _put_on(self) -> None:
        """Show the structure as it is chosen, and say what holds for it, and no more what was refused before."""
        self.dress.put_on(self.found, self.desk.solvable)
        self.standing.refusal = ""
        self.say()

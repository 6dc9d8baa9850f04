"""One browser tab: its design, its processes, its scene and its panels. All of it runs in the server's event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from plisse.errors import PlisseError
from plisse.io.designs import read_design
from plisse.recipe import Recipe
from plisse.shipped import shipped_design
from plisse.studio.child import Answer, Failure, Stage
from plisse.studio.errands import Errands
from plisse.studio.handles import Handles, control_points_of
from plisse.studio.model import Desk
from plisse.studio.pace import Pace
from plisse.studio.panels import Panels
from plisse.studio.requests import Colour, Found, Pose, Request, Solid, Solve
from plisse.studio.scene import Scene
from plisse.studio.status import broken, refused, remark, solved, working
from plisse.studio.uploads import Uploads
from plisse.studio.waiting import Later, Waiting
from plisse.studio.worker import Process, Worker
from plisse.transform.collisions import DESIGNED, FreeRange

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Tab"]

REST, LONGER = 0.08, 2.0  # seconds without a change before a full answer, and before what takes longer, is asked for


class Tab:
    """Everything behind a tab; `close` ends its processes and removes its files."""

    def __init__(self, client: ClientHandle, recipe: Recipe, title: str, *,
                 loop: asyncio.AbstractEventLoop, start: Callable[[], Process] | None = None):
        self.client, self._loop = client, loop
        self.desk, self._pace = Desk(recipe, title), Pace()
        self.found: Found | None = None
        self.colour = ""
        self.solid: tuple[str, float] = "", 0.0
        self.percent = DESIGNED
        self._asked: Request | None = None  # for a pose, a solid or colours
        self._held = self.percent, self.solid  # what is on screen
        self.is_open = True
        self._framed = False
        self._refusal = ""  # what stands above the status, empty for nothing
        self._rest, self._longer = Later(loop, REST), Later(loop, LONGER)
        self.free: FreeRange | None = None
        self._waiting = Waiting(loop, self._say_late)
        self._hands = Worker(self.deliver, start)
        self._uploads = Uploads(client)
        self.errands = Errands(self)
        self.scene = Scene(client)
        self.handles = Handles(client, self._point_moved, lambda index: self.panels.point_chosen(index))
        self.panels = Panels(self)
        self._solve(at_once=True)

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
            self._refusal = ""
            self._framed = self._framed and framed
            self._solve()
        elif self._refusal:
            self.say_found()
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
        self.percent = percent
        self._dress()
        self._say_pose()

    def paint(self, name: str) -> None:
        """Lay a colour map over the structure as it was designed, or none for the empty name."""
        self.colour = name
        self._stand_still()

    def solidify(self, kind: str, length: float) -> None:
        """Show plates or an offset instead of the structure, or the structure itself for the empty kind."""
        self.solid = kind, length
        self._stand_still()

    def ask(self, request: Request) -> None:
        """Ask the process that has the result of what is on screen."""
        self._hands.ask(request)

    def refuse(self, sentence: str) -> None:
        """Say that something was not done; what is on screen stays."""
        self._refusal = sentence
        self.panels.say(refused(sentence, self.found, self.desk.step.title))

    def say_found(self) -> None:
        """Say what is on screen."""
        self._refusal = ""
        if self.found is not None:
            self.panels.say(solved(self.found, self.desk.step.title, remark(self.scene.is_pale, self.percent, self.free)))

    def show_reach(self, free: FreeRange, offsets: tuple[float, float]) -> None:
        """Show how far the structure moves and can be offset."""
        self.free = free
        self.panels.show_reach(free, offsets)
        self._say_pose()

    def show_handles(self) -> None:
        """Put the handles where the control points are."""
        self.handles.show(control_points_of(self.desk.recipe), self.scene.extent[1], self.panels.handles_wanted)

    def deliver(self, request: Request, message: Answer | Failure | Stage) -> None:
        """Take in a message from a process; may be called from any thread."""
        self._loop.call_soon_threadsafe(self._receive, request, message)

    def close(self) -> None:
        """End the processes and remove the files."""
        self.is_open = False
        for stop in (self._rest.cancel, self._longer.cancel, self._waiting.cancel, self.scene.close):
            self._loop.call_soon_threadsafe(stop)
        self._hands.close()
        self.errands.close()
        self.desk.close()

    def _solve(self, at_once: bool = False) -> None:
        """Ask for the design on the desk: a draft while it changes where the whole would take too long."""
        recipe = self.desk.solvable
        self._rest.cancel()
        self._longer.cancel()
        draft, waits = self._pace.draft(recipe), self._pace.waits(recipe)
        if draft is not None:
            self._ask_solve(Solve(draft, drafted=True, colour=self.colour))
        whole = Solve(recipe, framed=not self._framed, colour=self.colour, quick=not waits)
        if at_once or not waits:
            self._ask_solve(whole)
        else:
            self._rest.begin(lambda: self._ask_solve(whole))

    def _ask_solve(self, request: Solve) -> None:
        """Ask for a solve, and say so where nothing comes of it for a while."""
        self._waiting.begin(request)
        self._hands.ask(request)

    def _say_late(self) -> None:
        if self.is_open:
            self.panels.say(working("solving", 0.0, self.found))

    def _say_pose(self) -> None:
        """Say again what is on screen, where nothing else is to be said."""
        if self._waiting.is_over and not self._refusal:
            self.say_found()

    def _point_moved(self, index: int, position: np.ndarray) -> None:
        points = control_points_of(self.desk.recipe)
        if points is not None and index < len(points):
            points[index] = self.panels.rounded(position)
            self.change({"curve.points": points.tolist()})

    def _receive(self, request: Request, message: Answer | Failure | Stage) -> None:
        if not self.is_open:
            return None
        if not isinstance(request, Solve | Pose | Solid | Colour):
            return self.errands.receive(request, message)
        if isinstance(message, Stage):
            if isinstance(request, Solve) and (self._waiting.is_late or not self._pace.is_fast):
                self.panels.say(working(message.name, message.fraction, self.found))
            return None
        if isinstance(request, Solve):
            self._waiting.end(request)
            return self._end_solve(request, message)
        if request is not self._asked:
            return None
        if isinstance(message, Failure):
            return self._break(request, message.sentence)
        return self._take_in(request, message.value)

    def _end_solve(self, request: Solve, message: Answer | Failure) -> None:
        """Show a solve; one of a design that is not wanted any more only while the design is pulled, as a draft."""
        is_final = not request.drafted and request.recipe == self.desk.solvable
        if isinstance(message, Failure):
            return self._break_down(message.sentence) if is_final else None
        self._pace.learn(message.value, message.seconds)
        if is_final:
            self._show(request, message.value)
            self._finish(request, message.value)
        elif request.is_brief:
            self._show(request, replace(message.value, drafted=True))
        return None

    def _take_in(self, request: Request, value: Any) -> None:
        """Show the structure as it was asked for last."""
        self._hold()
        if self._refusal:
            self.say_found()
        if isinstance(request, Colour):
            self.scene.tint(value)
            self.panels.show_scale(value)
        else:
            self.scene.pose(value)

    def _hold(self) -> None:
        """Remember what is on screen, for what is refused goes back to it."""
        self._asked, self._held = None, (self.percent, self.solid)

    def _break_down(self, sentence: str) -> None:
        """Say why there is no structure; what was on screen before is pale."""
        self.scene.pale()
        self.panels.say(broken(sentence, self.found if self.scene.is_pale else None))
        self.found = self._asked = None

    def _break(self, request: Request, sentence: str) -> None:
        """Go back to what is on screen, and say why."""
        self._asked = None
        if isinstance(request, Colour):
            self._to_paper()
        else:
            self.percent, self.solid = self._held
        self.refuse(sentence)
        self.panels.refresh()

    def _to_paper(self) -> None:
        self.colour = ""
        self.panels.show_paper()
        self._dress()

    def _show(self, request: Solve, found: Found) -> None:
        self.found, self.free = found, None
        self.percent = DESIGNED
        self._asked, self._held = None, (DESIGNED, ("", 0.0))
        is_bare_surface = request.framed and found.reference is not None
        if found.folded is None and not is_bare_surface:
            self.scene.pale()
        else:
            self.scene.show(found)
        if found.tint is not None and not self.solid[0]:
            self.scene.tint(found.tint)
        self.panels.show_scale(None if self.solid[0] else found.tint)
        if request.framed and found.folded is not None:
            self._framed = True
            self.scene.frame()
            self.panels.fit(self.scene.extent[1])
        elif not self.handles.is_pulled:
            self.scene.follow()
        self.show_handles()
        if self._refusal:
            self.refuse(self._refusal)  # which came while this was solved
        else:
            self.say_found()
        self.panels.forget_reach()
        self.panels.refresh()

    def _finish(self, request: Solve, found: Found) -> None:
        """Show what is on screen in full as it is chosen, and measure what takes longer."""
        if self.solid[0] or self.colour != request.colour:
            self._dress()
        elif self.colour and found.tint is None:
            self._to_paper()
        if found.report.principal:
            self._longer.begin(self.errands.measure_reach)

    def _stand_still(self) -> None:
        """Go back to the structure as it was designed, and show it as it is chosen."""
        if self.percent != DESIGNED:
            self.percent = DESIGNED
            self.panels.refresh()
        self._dress()

    def _dress(self) -> None:
        """Show the structure as it is chosen: in a state of its motion, as plates or an offset, in colours, or as paper."""
        if self.found is None or self.found.folded is None:
            pass  # what is pale stays as it is
        elif self.percent != DESIGNED:
            self._wear(Pose(self.desk.solvable, self.percent))
        elif self.solid[0]:
            self._wear(Solid(self.desk.solvable, *self.solid))
        elif self.colour:
            return self._wear(Colour(self.desk.solvable, self.colour))
        else:
            self.scene.show(self.found)
            self._hold()
        return self.panels.show_scale(None)

    def _wear(self, request: Pose | Solid | Colour) -> None:
        self._asked = request
        self._hands.ask(request)

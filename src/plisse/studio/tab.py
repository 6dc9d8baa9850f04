"""One browser tab: its design, its processes, its scene and its panels. All of it runs in the server's event loop."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from plisse.errors import PlisseError
from plisse.io.designs import read_design
from plisse.recipe import Recipe, SurfaceDesign
from plisse.shipped import shipped_design
from plisse.studio.child import Answer, Failure, Stage
from plisse.studio.downloads import file_name
from plisse.studio.handles import Handles, control_points_of
from plisse.studio.model import Desk
from plisse.studio.pace import Pace
from plisse.studio.panels import Panels
from plisse.studio.requests import (
    Candidates,
    Colour,
    Fetch,
    Found,
    Mesh,
    Pose,
    Reach,
    Request,
    Solid,
    Solve,
    Take,
)
from plisse.studio.scene import Scene
from plisse.studio.status import failed, solved, working
from plisse.studio.uploads import limit_uploads
from plisse.studio.worker import Worker

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Tab"]

REST, LONGER = 0.08, 1.0  # seconds without a change before a full answer, and before what takes longer, is asked for


class Tab:
    """Everything behind a tab; `close` ends its processes and removes its files."""

    def __init__(self, client: ClientHandle, recipe: Recipe, title: str, *,
                 loop: asyncio.AbstractEventLoop):
        self.client, self._loop = client, loop
        self.desk, self._pace = Desk(recipe, title), Pace()
        self.found: Found | None = None
        self.colour = ""
        self.solid: tuple[str, float] = "", 0.0
        self.percent = 100.0
        self.is_open = True
        self._framed = False
        self._rest: asyncio.TimerHandle | None = None
        self._waiting_for_result: list[Callable] = []
        self._hands = Worker(self._deliver)
        self._helper: Worker | None = None
        limit_uploads(client)
        self.scene = Scene(client)
        self.handles = Handles(client, self._point_moved, lambda index: self.panels.point_chosen(index))
        self.panels = Panels(self)
        self._solve(at_once=True)

    def act(self, action: Callable[[], object]) -> None:
        """Do something with the design and show what it comes to; what is refused is said in a sentence."""
        before = self.desk.step
        try:
            action()
        except PlisseError as error:
            self.panels.say(failed(str(error)))
            return self.panels.refresh()
        if self.desk.step is not before:
            self._solve()
        return self.panels.refresh()

    def change(self, changes: dict) -> None:
        """Change keys of the design, as `plisse.Session.update` does."""
        self.act(lambda: self.desk.change(changes))

    def open_shipped(self, name: str) -> None:
        """Open a design of the gallery."""
        self._framed = False
        self.act(lambda: self.desk.open(read_design(shipped_design(name)), name))

    def read(self, text: str, title: str = "") -> None:
        """Open a design from its text."""
        self._framed = False
        self.act(lambda: self.desk.read(text, title))

    def upload_mesh(self, name: str, content: bytes) -> None:
        """Check an uploaded mesh and, if it is a surface, lay pleats over it."""
        def put() -> None:
            shown = self.desk.shelf.put(name, content)
            self._aside.ask(Mesh(self.desk.shelf.path(shown), shown))

        self.act(put)

    def pose(self, percent: float) -> None:
        """Show a state of the motion."""
        self.percent = percent
        if percent == 100.0:
            self.scene.redraw()
        else:
            self._hands.ask(Pose(self.desk.solvable, percent))

    def paint(self, name: str) -> None:
        """Lay a colour map over the structure, or none for the empty name."""
        self.colour = name
        self._dress()

    def solidify(self, kind: str, length: float) -> None:
        """Show plates or an offset instead of the structure, or the structure itself for the empty kind."""
        self.solid = kind, length
        self._dress()

    def take(self, kind: str) -> None:
        """Make a file of what is on screen and hand it over."""
        title = self.desk.step.title
        self.with_result(lambda result: self._aside.ask(Take(result, title, kind)))
        self.panels.note(f"making {file_name(title, kind)} …")

    def lay_out(self, count: int) -> None:
        """Search for layouts over the surface."""
        recipe = self.desk.solvable
        if isinstance(recipe, SurfaceDesign):
            self._aside.ask(Candidates(recipe, count))

    def with_result(self, use: Callable) -> None:
        """Call `use` with the whole result of what is on screen, once it is there."""
        self._waiting_for_result.append(use)
        self._hands.ask(Fetch(self.desk.solvable))

    def close(self) -> None:
        """End the processes and remove the files."""
        self.is_open = False
        if self._rest is not None:
            self._loop.call_soon_threadsafe(self._rest.cancel)
        self._hands.close()
        if self._helper is not None:
            self._helper.close()
        self.desk.close()

    @property
    def _aside(self) -> Worker:
        """The process for what takes longer, so that it is in nobody's way."""
        if self._helper is None:
            self._helper = Worker(self._deliver)
        return self._helper

    def _solve(self, at_once: bool = False) -> None:
        """Ask for the design on the desk: a draft while it changes where the whole would take too long."""
        recipe = self.desk.solvable
        self._later(None)
        draft = self._pace.draft(recipe)
        if draft is not None:
            self._hands.ask(Solve(draft, drafted=True))
        if at_once or not self._pace.waits(recipe):
            self._hands.ask(Solve(recipe, framed=not self._framed))
        else:
            self._later(lambda: self._hands.ask(Solve(recipe, framed=not self._framed)))

    def _later(self, action: Callable | None, seconds: float = REST) -> None:
        if self._rest is not None:
            self._rest.cancel()
        self._rest = None if action is None else self._loop.call_later(seconds, action)

    def _point_moved(self, index: int, position: np.ndarray) -> None:
        points = control_points_of(self.desk.recipe)
        if points is not None and index < len(points):
            points[index] = self.panels.rounded(position)
            self.change({"curve.points": points.tolist()})

    def _deliver(self, request: Request, message: Answer | Failure | Stage) -> None:
        self._loop.call_soon_threadsafe(self._receive, request, message)

    def _receive(self, request: Request, message: Answer | Failure | Stage) -> None:
        if isinstance(message, Stage):
            if isinstance(request, Candidates) or (isinstance(request, Solve) and not self._pace.is_fast):
                self.panels.say(working(message.name, message.fraction, self.found))
        elif isinstance(message, Failure):
            self.panels.say(failed(message.sentence))
            if isinstance(request, Fetch):
                self._waiting_for_result.clear()
        else:
            self._take_in(request, message)

    def _take_in(self, request: Request, answer: Answer) -> None:
        value = answer.value
        if isinstance(request, Solve):
            self._show(request, value, answer.seconds)
        elif isinstance(request, Pose | Solid):
            if self.solid[0] if isinstance(request, Solid) else request.percent == self.percent:
                self.scene.pose(value)
        elif isinstance(request, Colour) and self.colour == request.name:
            self.scene.tint(value)
            self.panels.show_scale(value)
        elif isinstance(request, Fetch):
            waiting, self._waiting_for_result = self._waiting_for_result, []
            for use in waiting:
                use(value)
        elif isinstance(request, Reach):
            self.panels.show_reach(*value)
        elif isinstance(request, Take):
            self.client.send_file_download(file_name(request.title, request.kind), value, save_immediately=True)
            self.panels.note(f"{file_name(request.title, request.kind)} is in your downloads")
        elif isinstance(request, Mesh):
            self.read(f'[surface]\nfile = "{request.name}"\n', request.name.rpartition(".")[0])
        elif isinstance(request, Candidates):
            self.panels.show_candidates(*value)

    def _show(self, request: Solve, found: Found, seconds: float) -> None:
        if not request.drafted:
            self._pace.learn(found, seconds)
        self.found = found
        self.percent = 100.0
        self.scene.show(found)
        if request.framed and found.folded is not None:
            self._framed = True
            self.scene.frame()
        self.show_handles()
        self.panels.say(solved(found, self.desk.step.title))
        self.panels.refresh()
        if not request.drafted:
            if self.solid[0] or self.colour:
                self._dress()
            if found.report.principal:
                self._later(lambda: self.with_result(self._measure_reach), LONGER)

    def _measure_reach(self, result) -> None:
        if result.structure is not None:
            self._aside.ask(Reach(result.structure))

    def show_handles(self) -> None:
        """Put the handles where the control points are."""
        self.handles.show(control_points_of(self.desk.recipe), self.scene.extent[1], self.panels.handles_wanted)

    def _dress(self) -> None:
        """Ask for what the structure is shown as, where that is not plain paper."""
        if self.solid[0]:
            self._hands.ask(Solid(self.desk.solvable, *self.solid))
        elif self.colour:
            self._hands.ask(Colour(self.desk.solvable, self.colour))
        else:
            self.panels.show_scale(None)
            self.scene.redraw()

"""What takes longer: files to take away, layouts, uploaded meshes, the free range; in a process of its own."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from plisse.errors import PlisseError
from plisse.recipe import Recipe, SurfaceDesign
from plisse.result import Result
from plisse.studio.child import Answer, Failure, Stage
from plisse.studio.downloads import KINDS, Order, file_name
from plisse.studio.requests import Candidates, Fetch, Mesh, Reach, Request, Take
from plisse.studio.surface_panel import shape_of
from plisse.studio.worker import Process, Worker

if TYPE_CHECKING:
    from plisse.studio.tab import Tab

__all__ = ["Errands"]


class Errands:
    """Errands of one tab; they are in nobody's way, and what they bring goes to its panels."""

    def __init__(self, tab: Tab):
        self._tab = tab
        self._helper: Worker | None = None
        self._waiting: list[Callable[[Result], None]] = []
        self._measured: Recipe | None = None

    def take(self, kind: str, **manner: Any) -> None:
        """Make a file of what is on screen, in a manner as `Order` has it; raises PlisseError for kinds that are none."""
        if kind not in KINDS:
            raise PlisseError(f"there are no files of the kind {kind}; choose one of the list")
        title = self._tab.desk.step.title
        self._with_result(lambda result: self._ask(Take(Order(result, title, **manner), kind)))
        self._tab.panels.note(f"making {file_name(title, kind)} …")

    def lay_out(self, count: int) -> None:
        """Search for layouts over the surface."""
        recipe = self._tab.desk.solvable
        if isinstance(recipe, SurfaceDesign):
            self._tab.forget_refusal()
            self._ask(Candidates(recipe, count))

    def upload_mesh(self, name: str, content: bytes) -> None:
        """Check a mesh and, if it is a surface, lay pleats over it; raises InvalidMesh for what is none at first sight."""
        shelf = self._tab.desk.shelf
        shown = shelf.put(name, content)
        self._ask(Mesh(shelf.path(shown), shown))

    def measure_reach(self) -> None:
        """Find the free range of the motion and of offsets."""
        self._measured = self._tab.desk.solvable
        self._with_result(lambda result: None if result.structure is None else self._ask(Reach(result.structure)))

    def receive(self, request: Request, message: Answer | Failure | Stage) -> None:
        """Take in what became of an errand."""
        if isinstance(request, Candidates):
            self._tab.say_search((message.name, message.fraction) if isinstance(message, Stage) else None)
        if isinstance(message, Answer):
            self._take_in(request, message.value)
        elif isinstance(message, Failure):
            if isinstance(request, Fetch):
                self._waiting.clear()
            self._tab.refuse(message.sentence)

    def close(self) -> None:
        """End the process."""
        if self._helper is not None:
            self._helper.close()

    def _take_in(self, request: Request, value: Any) -> None:
        tab = self._tab
        if isinstance(request, Fetch):
            waiting, self._waiting = self._waiting, []
            for use in waiting:
                use(value)
        elif isinstance(request, Take):
            name = file_name(request.order.title, request.kind)
            tab.client.send_file_download(name, value, save_immediately=True)
            tab.panels.note(f"{name} is in your downloads")
        elif isinstance(request, Reach):
            if self._measured == tab.desk.solvable:
                tab.show_reach(*value)
        elif isinstance(request, Mesh):
            tab.read(f'[surface]\nfile = "{request.name}"\n', request.name.rpartition(".")[0])
        elif isinstance(request, Candidates) and shape_of(request.recipe) == shape_of(tab.desk.solvable):
            tab.panels.show_candidates(value)

    def _ask(self, request: Request) -> None:
        if self._helper is None:
            self._helper = Worker(self._tab.deliver, lambda: Process(patient=True))
        self._helper.ask(request)

    def _with_result(self, use: Callable[[Result], None]) -> None:
        """Call `use` with the whole result of what is on screen, once it is there."""
        self._waiting.append(use)
        self._tab.ask(Fetch(self._tab.desk.solvable))

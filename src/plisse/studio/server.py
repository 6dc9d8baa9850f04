"""The studio's server: viser behind a gate, one design per browser tab."""

from __future__ import annotations

import contextlib
import io
from collections.abc import Iterator
from http import HTTPStatus
from typing import TYPE_CHECKING

from plisse.errors import PlisseError
from plisse.extras import optional
from plisse.recipe import Recipe
from plisse.studio.gate import Gate
from plisse.studio.inside import forbid_sharing
from plisse.studio.page import with_additions
from plisse.studio.tab import Tab
from plisse.studio.worker import Spare

if TYPE_CHECKING:
    from viser import ClientHandle, ViserServer

__all__ = ["Studio"]

HEADERS = {"X-Frame-Options": "DENY", "Referrer-Policy": "no-referrer", "X-Content-Type-Options": "nosniff",
           "Cross-Origin-Resource-Policy": "same-origin"}


class Studio:
    """A running server; every tab that connects starts with the same design and goes its own way.

    Raises MissingExtra without viser, PlisseError where the server does not start.
    """

    def __init__(self, recipe: Recipe, title: str, gate: Gate, port: int = 8080):
        viser = optional("viser", extra="studio", purpose="designs in a browser")
        self.tabs: dict[int, Tab] = {}
        self._first = recipe, title
        with _guarded(gate), contextlib.redirect_stdout(io.StringIO()):
            self._server: ViserServer = viser.ViserServer(gate.host, port, label="plisse studio", verbose=False)
        self._spare = Spare()
        forbid_sharing(self._server)
        self._server.gui.configure_theme(control_width="large", show_logo=False, show_share_button=False)
        self._server.scene.world_axes.visible = False
        self._server.scene.configure_default_lights(False)
        self._server.scene.configure_environment_map(None)
        self._server.on_client_connect(self._welcome)
        self._server.on_client_disconnect(self._take_leave)

    @property
    def port(self) -> int:
        """The port in use: the wanted one, or the next that was free."""
        return self._server.get_port()

    def wait(self) -> None:
        """Serve until interrupted."""
        self._server.sleep_forever()

    def close(self) -> None:
        """End the server and everything behind its tabs."""
        with contextlib.redirect_stdout(io.StringIO()):
            self._server.stop()
        for tab in list(self.tabs.values()):
            tab.close()
        self.tabs.clear()
        self._spare.close()

    async def _welcome(self, client: ClientHandle) -> None:
        self.tabs[client.client_id] = Tab(client, *self._first, loop=self._server.get_event_loop(),
                                          start=self._spare.take)

    async def _take_leave(self, client: ClientHandle) -> None:
        tab = self.tabs.pop(client.client_id, None)
        if tab is not None:
            await self._server.get_event_loop().run_in_executor(None, tab.close)


def _amend(response) -> None:
    """Add the studio's headers to a response, and to the page what viser's lacks."""
    for name, value in HEADERS.items():
        response.headers[name] = value
    if response.headers.get("Content-Type", "").startswith("text/html"):
        response.body = with_additions(response.body, response.headers.get("Content-Encoding", "identity"))
        del response.headers["Content-Length"]
        response.headers["Content-Length"] = str(len(response.body))


@contextlib.contextmanager
def _guarded(gate: Gate) -> Iterator[None]:
    """Within this, servers ask the gate before anything else: viser has no place for it.

    Raises PlisseError where the server that was started does not know the gate.
    """
    import websockets.asyncio.server as websockets

    plain, asked = websockets.serve, []

    def serve(handler, host, port, *, process_request, **options):
        asked.append(port)

        def checked(connection, request):
            try:
                refusal = gate.refusal(request.path, request.headers)
            except LookupError:
                refusal = "A header is given twice."
            if refusal is not None:
                return connection.respond(HTTPStatus.FORBIDDEN, refusal + "\n")
            response = process_request(connection, request)
            if response is not None:
                _amend(response)
                if gate.is_given(request.path):
                    response.headers["Set-Cookie"] = gate.cookie
            return response

        return plain(handler, host, port, process_request=checked, **options)

    websockets.serve = serve  # type: ignore[assignment,misc]
    try:
        yield
    finally:
        websockets.serve = plain  # type: ignore[misc]
    if not asked:
        raise PlisseError("this version of viser starts its server in another way than plisse knows, so the studio would be "
                          "unguarded; install viser 1.1")

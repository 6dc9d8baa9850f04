"""What of viser's inside the studio uses, all in one place: pyproject holds viser to versions that have it.

Private names are used below. Besides, `server` puts the gate before the `websockets` server that viser starts, and `page`
looks for the controls by the marks that viser's page gives them.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from viser import ClientHandle, GuiSliderHandle, ViserServer

__all__ = ["Transfers", "forbid_sharing", "set_marks"]


def forbid_sharing(server: ViserServer) -> None:
    """No browser may ask viser for a public address of this server any more."""
    from viser import _messages as messages

    server._websock_server.unregister_handler(messages.ShareUrlRequest)


def set_marks(slider: GuiSliderHandle, marks: list[tuple[float, str]]) -> None:
    """Put other marks, values with their words, below a slider."""
    from viser._messages import GuiSliderMark

    slider._marks = tuple(GuiSliderMark(value, label) for value, label in marks)


class Transfers:
    """Files that come from a client: `start(message)` and `part(message)` are asked before viser takes anything."""

    def __init__(self, client: ClientHandle, start: Callable[[Any], bool], part: Callable[[Any], bool]):
        from viser import _messages as messages

        self._gui, self._acknowledgement = client.gui, messages.FileTransferPartAck
        connection = client._websock_connection
        for kind, allowed, take in (
                (messages.FileTransferStartUpload, start, self._gui._handle_file_transfer_start),
                (messages.FileTransferPart, part, self._gui._handle_file_transfer_part)):
            connection.unregister_handler(kind)
            connection.register_handler(kind, _if_allowed(allowed, take))

    def is_under_way(self, transfer: str) -> bool:
        """Whether more of a file is to come."""
        return transfer in self._gui._current_file_upload_states

    def drop(self, transfer: str) -> None:
        """Forget what came of a file."""
        self._gui._current_file_upload_states.pop(transfer, None)

    def end(self, start: Any) -> None:
        """Tell the client that the file that it announced with `start` is done with, so that its button is free again."""
        size = start.size_bytes
        self._gui._websock_interface.queue_message(
            self._acknowledgement(start.source_component_uuid, start.transfer_uuid, size, size))


def _if_allowed(allowed: Callable[[Any], bool], take: Callable[[Any, Any], None]):
    def handle(client_id, message) -> None:
        if allowed(message):
            take(client_id, message)

    return handle

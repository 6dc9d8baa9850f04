"""Limits on what a browser may send: how large, how many at a time, in how many seconds."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from plisse.studio.shelf import LARGEST_MESH

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["limit_uploads"]

AT_ONCE = 2
SECONDS = 120.0


def limit_uploads(client: ClientHandle) -> None:
    """Refuse transfers from a client that are too large, too slow or too many; viser itself has no limits."""
    from viser import _messages as messages

    gui, connection = client.gui, client._websock_connection
    begun: dict[str, tuple[float, int]] = {}
    connection.unregister_handler(messages.FileTransferStartUpload)
    connection.unregister_handler(messages.FileTransferPart)

    def drop(transfer: str) -> None:
        begun.pop(transfer, None)
        gui._current_file_upload_states.pop(transfer, None)

    def start(client_id, message) -> None:
        now = time.monotonic()
        for transfer in [name for name, (since, _) in begun.items() if now - since > SECONDS]:
            drop(transfer)
        if 0 <= message.size_bytes <= LARGEST_MESH and 0 <= message.part_count <= LARGEST_MESH and len(begun) < AT_ONCE:
            begun[message.transfer_uuid] = now, 0
            gui._handle_file_transfer_start(client_id, message)
            if message.part_count == 0:
                drop(message.transfer_uuid)
        else:
            words = f"At most {LARGEST_MESH // 1_000_000} MB and {AT_ONCE} files at a time."
            client.add_notification("Upload refused", words, color="red")

    def part(client_id, message) -> None:
        if message.transfer_uuid not in begun:
            return
        since, size = begun[message.transfer_uuid]
        size += len(message.content)
        if size > LARGEST_MESH or time.monotonic() - since > SECONDS:
            drop(message.transfer_uuid)
            return
        begun[message.transfer_uuid] = since, size
        gui._handle_file_transfer_part(client_id, message)
        if message.transfer_uuid not in gui._current_file_upload_states:
            begun.pop(message.transfer_uuid, None)

    connection.register_handler(messages.FileTransferStartUpload, start)
    connection.register_handler(messages.FileTransferPart, part)

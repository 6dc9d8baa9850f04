"""Limits on what a browser may send: how large, how many at a time, in how many seconds."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Any

from plisse.studio.inside import Transfers
from plisse.studio.shelf import LARGEST_MESH

if TYPE_CHECKING:
    from viser import ClientHandle

__all__ = ["Uploads"]

AT_ONCE = 2
SECONDS = 120.0


class Uploads:
    """Refuses transfers from a client that are too large, too slow or too many; viser itself has no limits."""

    def __init__(self, client: ClientHandle):
        self._client = client
        self._begun: dict[str, tuple[float, int, Any]] = {}
        self._transfers = Transfers(client, self._start, self._part)

    def _start(self, message) -> bool:
        now = time.monotonic()
        for transfer in [name for name, (since, *_) in self._begun.items()
                         if now - since > SECONDS or not self._transfers.is_under_way(name)]:
            self._drop(transfer)
        if 0 <= message.size_bytes <= LARGEST_MESH and 0 <= message.part_count <= LARGEST_MESH \
                and len(self._begun) < AT_ONCE:
            if message.part_count > 0:
                self._begun[message.transfer_uuid] = now, 0, message
            return True
        self._transfers.end(message)
        words = f"At most {LARGEST_MESH // 1_000_000} MB and {AT_ONCE} files at a time."
        self._client.add_notification("Upload refused", words, color="red")
        return False

    def _part(self, message) -> bool:
        if message.transfer_uuid not in self._begun:
            return False
        since, size, start = self._begun[message.transfer_uuid]
        size += len(message.content)
        if size > LARGEST_MESH or time.monotonic() - since > SECONDS:
            self._drop(message.transfer_uuid)
            self._transfers.end(start)
            return False
        self._begun[message.transfer_uuid] = since, size, start
        return True

    def _drop(self, transfer: str) -> None:
        self._begun.pop(transfer, None)
        self._transfers.drop(transfer)

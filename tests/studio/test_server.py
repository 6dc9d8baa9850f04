"""The server lets in whom the gate lets in, shares nothing with the internet and takes no more than it should."""

import asyncio
import gzip
import http.client
from types import SimpleNamespace

import pytest

from plisse.io.designs import design_from_dict

websockets = pytest.importorskip("websockets", reason="viser is not installed: pip install plisse[studio]")
viser = pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")

from viser import _messages as messages  # noqa: E402

from plisse.studio.gate import Gate  # noqa: E402
from plisse.studio.page import with_additions  # noqa: E402
from plisse.studio.server import Studio  # noqa: E402
from plisse.studio.shelf import LARGEST_MESH  # noqa: E402
from plisse.studio.uploads import AT_ONCE, Uploads  # noqa: E402

RECIPE = design_from_dict({"closed_form": {"kind": "cones", "creases": 4, "samples": 11}})


@pytest.fixture(scope="module")
def running():
    studio = Studio(RECIPE, "cones", Gate("127.0.0.1"), port=0)
    yield studio
    studio.close()


@pytest.fixture(scope="module")
def guarded():
    studio = Studio(RECIPE, "cones", Gate("127.0.0.1", "secret"), port=0)
    yield studio
    studio.close()


def get(port, path="/", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=10)
    connection.request("GET", path, headers={"Host": f"localhost:{port}", **headers})
    response = connection.getresponse()
    body = response.read()
    connection.close()
    return response, body


async def knock(port, **options):
    async with websockets.connect(f"ws://127.0.0.1:{port}", subprotocols=[f"viser-v{viser.__version__}"], **options):
        return "in"


def test_the_page_is_served_with_the_studios_additions(running):
    response, body = get(running.port, **{"Accept-Encoding": "identity"})
    assert response.status == 200
    assert b"aria-label" in body
    assert response.headers["X-Frame-Options"] == "DENY"
    packed, again = get(running.port, **{"Accept-Encoding": "gzip"})
    assert packed.headers["Content-Encoding"] == "gzip"
    assert gzip.decompress(again) == body


@pytest.mark.parametrize("headers", [{"Host": "evil.example"}, {"Origin": "http://evil.example"}, {"Origin": "null"}])
@pytest.mark.parametrize("path", ["/", "/index.html", "/../../etc/passwd", "/assets/x.js"])
def test_foreign_hosts_and_origins_get_nothing(running, headers, path):
    response, body = get(running.port, path, **headers)
    assert response.status == 403
    assert b"<html" not in body


@pytest.mark.parametrize("path", ["/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/..\\..\\etc\\passwd"])
def test_no_file_outside_the_page_is_served(running, path):
    response, body = get(running.port, path)
    assert response.status == 404
    assert b"root:" not in body


def test_the_socket_is_guarded_too(running):
    port = running.port
    for origin in ("http://evil.example", "null", f"http://localhost:{port + 1}"):
        with pytest.raises(websockets.InvalidStatus, match="403"):
            asyncio.run(knock(port, origin=origin))
    assert asyncio.run(knock(port, origin=f"http://127.0.0.1:{port}")) == "in"


def test_without_the_token_nobody_gets_in(guarded):
    port = guarded.port
    assert get(port)[0].status == 403
    with pytest.raises(websockets.InvalidStatus, match="403"):
        asyncio.run(knock(port, origin=f"http://127.0.0.1:{port}"))
    response, _ = get(port, "/?token=secret")
    assert response.status == 200
    kept = response.headers["Set-Cookie"].partition(";")[0]
    assert get(port, Cookie=kept)[0].status == 200
    assert asyncio.run(knock(port, additional_headers={"Cookie": kept})) == "in"


def test_nobody_can_ask_for_a_public_address(running):
    assert messages.ShareUrlRequest not in running._server._websock_server._incoming_handlers


def test_a_page_without_a_head_stays_as_it_is():
    assert with_additions(b"<p>no head</p>", "identity") == b"<p>no head</p>"


class Transfers:
    """The part of a client that takes files, without a browser."""

    def __init__(self):
        self.handlers, self.taken, self.refused, self.ended = {}, [], [], []
        self.gui = SimpleNamespace(_current_file_upload_states={}, _handle_file_transfer_start=self._begin,
                                   _handle_file_transfer_part=self._take,
                                   _websock_interface=SimpleNamespace(queue_message=self.ended.append))
        self._websock_connection = SimpleNamespace(unregister_handler=lambda kind: None,
                                                   register_handler=self.handlers.__setitem__)
        self.uploads = Uploads(self)

    def _begin(self, client, message):
        self.gui._current_file_upload_states[message.transfer_uuid] = message

    def _take(self, client, message):
        self.taken.append(len(message.content))

    def add_notification(self, title, words, color):
        self.refused.append(title)

    def start(self, name, size, parts=2):
        begin = messages.FileTransferStartUpload("button", name, "a.obj", "", parts, size)
        self.handlers[messages.FileTransferStartUpload](0, begin)

    def part(self, name, content):
        self.handlers[messages.FileTransferPart](0, messages.FileTransferPart("button", name, 0, content))


def test_uploads_are_limited_in_size_even_where_it_was_declared_wrongly():
    client = Transfers()
    client.start("large", LARGEST_MESH + 1)
    assert client.refused
    assert [(end.transfer_uuid, end.transferred_bytes) for end in client.ended] == [("large", LARGEST_MESH + 1)]
    client.part("large", b"x")
    assert client.taken == []
    client.start("liar", 10)
    for _ in range(3):
        client.part("liar", bytes(LARGEST_MESH // 2))
    assert client.taken == [LARGEST_MESH // 2] * 2
    assert client.ended[-1].transferred_bytes == client.ended[-1].total_bytes  # the button is free again
    assert "liar" not in client.gui._current_file_upload_states


def test_only_a_few_files_come_at_a_time_and_slow_ones_are_dropped(monkeypatch):
    client = Transfers()
    for k in range(AT_ONCE + 1):
        client.start(f"file {k}", 100)
    assert len(client.refused) == 1
    monkeypatch.setattr("time.monotonic", lambda: 1e9)
    client.part("file 0", b"late")
    assert client.taken == []
    client.start("another", 100)
    assert len(client.refused) == 1

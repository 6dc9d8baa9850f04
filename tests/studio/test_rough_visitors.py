"""Visitors who come and go, and send what nobody should: the server says nothing, keeps nothing and goes on."""

import gc
import itertools
import signal
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import pytest

from plisse.io.designs import design_from_dict

sync = pytest.importorskip("websockets.sync.client", reason="viser is not installed: pip install plisse[studio]")
viser = pytest.importorskip("viser", reason="viser is not installed: pip install plisse[studio]")

import msgspec  # noqa: E402
from viser import _messages as messages  # noqa: E402

from plisse.studio.gate import Gate  # noqa: E402
from plisse.studio.handles import MOST_POINTS  # noqa: E402
from plisse.studio.server import Studio  # noqa: E402

WAVE = design_from_dict({"curve": {"kind": "spline", "points": [[0, 0, 0], [40, 18, 8], [80, 18, 14], [120, 0, 16]]},
                         "pattern": {"theta": 40, "creases": 5, "width": 5, "amplitude": 3, "samples": 21}})
PATTERN = "[pattern]\ncreases = 5\nwidth = 5\namplitude = 3\n"
SADDLE = "[surface]\nheight = '0.0008*x*x - 0.0006*y*y'\nx = [-60, 60]\ny = [-40, 40]\n"
CAMERA = messages.ViewerCameraMessage((1, 0, 0, 0), (0, 0, 100), 1.0, 0.1, 1e4, 600, 800, (0, 0, 0), (0, 1, 0))
HEIGHTS = itertools.count(CAMERA.image_height + 1)


@pytest.fixture(scope="module")
def running():
    """A studio that leaves no process."""
    before = children()
    studio = Studio(WAVE, "a wave", Gate("127.0.0.1"), port=0)
    yield studio
    studio.close()
    until(lambda: children() <= before)


@pytest.fixture
def studio(running, capfd, caplog):
    """The studio, which keeps no tab and prints nothing that went wrong."""
    yield running
    until(lambda: not running.tabs)
    gc.collect()  # asyncio tells of exceptions that nobody asked for when they go
    assert [record for record in caplog.records if record.levelname == "ERROR"] == []
    said = capfd.readouterr()
    assert "Traceback" not in said.out + said.err
    assert "rror" not in said.err


@contextmanager
def visit(studio):
    """Somebody's connection, and the tab behind it: that whose window is as high as no other one."""
    height = next(HEIGHTS)

    def own():
        return next((tab for tab in list(studio.tabs.values()) if tab.client.camera.image_height == height), None)

    with knock(studio.port) as connection:
        send(connection, replace(CAMERA, image_height=height))
        until(own)
        yield connection, own()


def knock(port):
    return sync.connect(f"ws://127.0.0.1:{port}", origin=f"http://127.0.0.1:{port}", max_size=None,
                        subprotocols=[f"viser-v{viser.__version__}"], compression=None)


def send(connection, message):
    connection.send(msgspec.msgpack.encode(message.as_serializable_dict()))


def control(tab, label):
    """The control of a label, the last one that was made."""
    handles = reversed(list(tab.client.gui._gui_input_handle_from_uuid.values()))
    return next((handle for handle in handles if getattr(handle._impl.props, "label", None) == label), None)


def give(connection, tab, label, value):
    """Set a control, as its browser does."""
    send(connection, messages.GuiUpdateMessage(control(tab, label)._impl.uuid, {"value": value}))


def children(pid="self"):
    """The processes that one has started and that still run."""
    found = Path(f"/proc/{pid}/task").glob("*/children")
    return {pid for file in found for pid in file.read_text().split()}


def runs(pid):
    """Whether a process runs: one that ended and that nobody asked about does not."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def until(condition, seconds=40):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "this did not happen in time"
        time.sleep(0.02)


def test_twenty_tabs_are_opened_and_closed_at_once(studio):
    for _ in range(20):
        with knock(studio.port) as connection:
            send(connection, CAMERA)
    with visit(studio) as (_, tab):
        until(lambda: tab.found is not None)
        until(lambda: list(studio.tabs.values()) == [tab])


def test_a_tab_is_closed_in_the_middle_of_an_upload(studio):
    with visit(studio) as (connection, tab):
        button = control(tab, "Upload a mesh …")._impl.uuid
        send(connection, messages.FileTransferStartUpload(button, "half", "roof.obj", "", 4, 2_000_000))
        send(connection, messages.FileTransferPart(button, "half", 0, b"v 0 0 0\n" * 60_000))
        until(lambda: tab.client.gui._current_file_upload_states)
        gui = tab.client.gui
    until(lambda: not studio.tabs and not gui._current_file_upload_states)


@pytest.mark.parametrize("text", [
    "# " + "x" * 1_100_000,
    "[pattern]\nwidth = nan\n", "[curve]\nkind = 'arc'\nradius = inf\n" + PATTERN,
    "[curve]\nkind = 'arc'\nradius = 1e9\n[pattern]\ncreases = 1000\nwidth = 1e-9\namplitude = 1e9\nsamples = 20000\n",
    "[curve]\nkind = 'spline'\npoints = [[0, 0, 0], [nan, 1, 1], [2, inf, 0]]\n" + PATTERN,
    "a = " + "[" * 5000, "\x00", "", "𝔘 = 1",
], ids=["long", "nan", "inf", "huge", "points", "deep", "zero", "empty", "letters"])
def test_texts_that_are_no_designs_are_refused_in_a_sentence(studio, text):
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        give(connection, tab, "design (TOML)", text)
        give(connection, tab, "Read the text above", True)
        until(lambda: "not done" in tab.panels._status.content)
        give(connection, tab, "creases", 6)
        until(lambda: tab.found is not None and tab.found.report.design.get("pattern", {}).get("creases") == 6)


def test_a_design_of_a_megabyte_is_read(studio):
    points = ", ".join(f"[{k / 100}, {(k % 7) / 1000}, 0.0]" for k in range(30_000))
    text = f"[curve]\nkind = 'points'\nsmooth = 5\npoints = [{points}]\n[pattern]\ncreases = 5\nwidth = 1\namplitude = 0.5\n"
    assert 600_000 < len(text) < 1_000_000
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        give(connection, tab, "design (TOML)", text)
        give(connection, tab, "Read the text above", True)
        until(lambda: tab.desk.can_undo)


@pytest.mark.parametrize("value", [float("nan"), float("inf"), -1e300, 1e308])
def test_numbers_that_are_none_are_refused_and_the_control_goes_back(studio, value):
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        for label in ("inclination θ (°)", "width (mm)", "amplitude (mm)"):
            give(connection, tab, label, value)
        give(connection, tab, "coordinates (mm)", [value, 0.0, 0.0])
        time.sleep(0.5)
        assert control(tab, "inclination θ (°)").value == 40
        assert control(tab, "width (mm)").value == 5
        assert tab.desk.recipe == WAVE
        give(connection, tab, "creases", 6)
        until(lambda: tab.found is not None and tab.found.report.design["pattern"]["creases"] == 6)


def test_what_is_refused_while_something_is_solved_is_still_said_when_it_is_there(studio):
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        give(connection, tab, "inclination θ (°)", 41)
        give(connection, tab, "inclination θ (°)", 95)
        until(lambda: tab.found.report.design["pattern"]["theta"] == 41)
        until(lambda: "“inclination θ” is 95" in tab.panels._status.content)
        give(connection, tab, "inclination θ (°)", 42)
        until(lambda: "not done" not in tab.panels._status.content)


def test_points_are_added_until_there_are_as_many_as_can_be_pulled(studio):
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        for k in range(200):
            give(connection, tab, "point", min(4 + k, MOST_POINTS))
            give(connection, tab, "points", "add")
        until(lambda: f"at most {MOST_POINTS} control points" in tab.panels._status.content)
        assert len(tab.desk.recipe.curve.points) == MOST_POINTS
        give(connection, tab, "points", "remove")
        until(lambda: len(tab.desk.recipe.curve.points) == MOST_POINTS - 1)


def test_one_place_is_halved_until_points_are_the_same(studio):
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        for _ in range(60):
            give(connection, tab, "points", "add")
        until(lambda: "control point 1 and control point 2 are the same point" in tab.panels._status.content)
        assert len(tab.desk.recipe.curve.points) < 60


def test_the_gallery_is_opened_and_chosen_from_during_a_search(studio):
    with visit(studio) as (connection, tab):
        until(lambda: tab.found is not None)
        give(connection, tab, "design (TOML)", SADDLE)
        give(connection, tab, "Read the text above", True)
        until(lambda: tab.desk.can_undo)
        give(connection, tab, "Search for layouts", True)
        give(connection, tab, "Gallery …", True)
        give(connection, tab, "Gallery …", True)
        until(lambda: control(tab, "Open fig16") is not None)
        give(connection, tab, "Open fig16", True)
        until(lambda: tab.desk.step.title == "fig16")
        until(lambda: tab.found is not None and tab.found.report.design == tab.desk.recipe.to_dict())


@pytest.fixture
def command():
    """`plisse studio` as a process of its own."""
    words = [sys.executable, "-c", "from plisse.cli import main; main()", "studio", "fig01d", "--no-browser", "--port", "0"]
    process = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    yield process
    process.kill()
    process.communicate(timeout=30)


@pytest.mark.parametrize("ending", ["SIGINT", "SIGKILL"])
def test_a_studio_that_ends_while_somebody_is_there_leaves_no_process(command, ending):
    port = int(command.stdout.readline().strip().rstrip("/").rpartition(":")[2])
    with knock(port) as connection:
        send(connection, CAMERA)
        until(lambda: len(children(command.pid)) >= 2)
        started = children(command.pid)
        command.send_signal(getattr(signal, ending))
        assert command.wait(timeout=30) == (0 if ending == "SIGINT" else -signal.SIGKILL)
    until(lambda: not any(runs(pid) for pid in started))
    assert "Traceback" not in command.stderr.read()

"""plisse studio: what it refuses before it starts."""

import sys

import pytest

from plisse.cli import main


def test_ports_that_are_none_are_refused(capsys):
    pytest.importorskip("viser")
    assert main(["studio", "--port", "70000", "--no-browser"]) == 1
    assert "no port" in capsys.readouterr().err


def test_unknown_designs_are_refused_with_a_suggestion(capsys):
    pytest.importorskip("viser")
    assert main(["studio", "fig1d", "--no-browser"]) == 1
    assert "fig01d" in capsys.readouterr().err


def test_without_viser_it_says_what_to_install(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "viser", None)
    assert main(["studio", "--no-browser"]) == 1
    assert "plisse[studio]" in capsys.readouterr().err


@pytest.mark.parametrize(("host", "token"), [("127.0.0.1", False), ("0.0.0.0", True)])
def test_other_interfaces_need_a_token_and_say_so(monkeypatch, capsys, host, token):
    import plisse.studio.server as server

    made = []

    class Fake:
        port = 8080

        def __init__(self, recipe, title, gate, port):
            made.append(gate)

        def wait(self):
            raise KeyboardInterrupt

        def close(self):
            made.append("closed")

    pytest.importorskip("viser")
    monkeypatch.setattr(server, "Studio", Fake)
    assert main(["studio", "--host", host, "--no-browser"]) == 0
    said = capsys.readouterr().out
    assert (made[0].token is not None) == token == ("?token=" in said) == ("other machines" in said)
    assert made[-1] == "closed"

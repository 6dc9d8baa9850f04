"""Threads of linear algebra are bounded in one place, for a command and for all processes that it starts."""

import os
import subprocess
import sys

import pytest

from plisse.cli import main
from plisse.threads import CHOSEN, LIBRARIES, bind_threads, child_environment


@pytest.fixture(autouse=True)
def _environment(monkeypatch):
    for name in (*LIBRARIES, CHOSEN):
        monkeypatch.setenv(name, "7")  # so that all of them are put back
        monkeypatch.delenv(name)


def test_one_thread_unless_the_environment_says_otherwise(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    bind_threads()
    assert [os.environ[name] for name in LIBRARIES] == ["1", "1", "3"]


def test_processes_beside_others_get_one_thread_each(monkeypatch):
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    assert {child_environment()[name] for name in LIBRARIES} == {"1"}


def test_a_number_that_was_asked_for_holds_for_all_processes():
    bind_threads(2)
    assert {os.environ[name] for name in LIBRARIES} == {"2"}
    assert {child_environment()[name] for name in LIBRARIES} == {"2"}


@pytest.mark.parametrize("command", [["make", "fig10"], ["table", "fig26"], ["study", "a.toml"], ["studio"]])
def test_no_threads_at_all_are_refused(command, capsys):
    assert main([*command, "--threads", "0"]) == 1
    assert capsys.readouterr().err == "plisse: --threads is 0; give a number from 1\n"


def test_no_memory_at_all_is_refused(capsys):
    assert main(["make", "fig10", "--memory", "-1"]) == 1
    assert capsys.readouterr().err == "plisse: --memory is -1; give GB above 0\n"


def test_designs_made_in_a_script_keep_to_one_thread_and_give_the_others_back():
    script = """
import numpy, scipy.linalg, plisse
from threadpoolctl import threadpool_info
threads = lambda: {entry["num_threads"] for entry in threadpool_info() if entry["user_api"] == "blas"}
before, seen = threads(), []
plisse.design({"closed_form": {"kind": "miura"}}, progress=lambda stage, fraction: seen.append(threads()))
assert all(during == {1} for during in seen), seen
assert threads() == before
"""
    unbound = {name: value for name, value in os.environ.items() if name not in LIBRARIES}
    subprocess.run([sys.executable, "-c", script], check=True, env=unbound)

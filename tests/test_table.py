"""Fig. 21 again: the columns of the contract, and rows that are what a design gives."""

import json

import pytest

import plisse
from plisse.cli import main
from plisse.cli.console import show_table
from plisse.shipped import shipped_design
from plisse.table import PRINTED, Row, as_json, as_markdown, table, totals

KEYS = {"name", "vertices", "faces", "iterations", "seconds", "planarity_max", "planarity_mean", "angle_max", "angle_mean",
        "status", "paper_seconds"}
PAPER = {"paper_vertices", "paper_faces", "paper_iterations", "paper_planarity_max", "paper_planarity_mean",
         "paper_angle_max", "paper_angle_mean", "note"}


def test_a_row_is_what_the_design_gives(capsys):
    assert main(["table", "fig26", "--json"]) == 0
    row, = json.loads(capsys.readouterr().out)
    assert set(row) == KEYS | PAPER
    report = plisse.design(str(shipped_design("fig26"))).report
    assert (row["vertices"], row["faces"], row["status"]) == (report.vertices, report.faces, "exact")
    assert row["planarity_max"] == report.planarity.max
    assert row["seconds"] > 0
    assert row["paper_seconds"] == PRINTED["fig26"].seconds


def test_the_printed_seconds_are_those_of_the_paper():
    assert sum(row.seconds for row in PRINTED.values()) == pytest.approx(144.4, abs=0.1)


def test_totals_stand_below_the_markdown_table():
    rows = table(["fig26"])
    lines = as_markdown(rows).splitlines()
    assert len(lines) == 4
    assert f"{totals(rows)[1]:.1f}" in lines[-1]


def test_examples_named_twice_are_solved_once_and_one_form_is_printed(capsys):
    assert main(["table", "fig26", "fig26", "--json", "--quiet"]) == 0
    assert len(json.loads(capsys.readouterr().out)) == 1
    assert main(["table", "fig26", "--json", "--markdown"]) == 1
    assert "--json and --markdown exclude each other" in capsys.readouterr().err
    assert main(["table", ""]) == 1
    assert "plisse: '' is no example of Fig. 21" in capsys.readouterr().err


def test_an_example_that_the_paper_does_not_list_is_one_sentence(capsys):
    assert main(["table", "fig99"]) == 1
    assert "no example of Fig. 21" in capsys.readouterr().err


def row(name, **facts):
    """A row of the size that the paper printed; `facts` replace parts of it."""
    printed = PRINTED[name]
    return Row(**{"name": name, "vertices": printed.vertices, "faces": printed.faces, "iterations": 10, "seconds": 0.01,
                  "planarity_max": 1e-15, "planarity_mean": 1e-16, "angle_max": 1e-14, "angle_mean": 1e-15,
                  "status": "exact", "paper_seconds": printed.seconds, **facts})


def test_a_size_that_the_paper_does_not_have_is_noted():
    same, other = as_json([row("fig27"), row("fig26", vertices=726)])
    assert same["note"] is None and other["note"] == "the paper printed 320 vertices and 600 faces"
    assert same["paper_angle_max"] == 7.2e-4 and other["paper_vertices"] == 320 and other["paper_angle_max"] is None


def test_the_table_fits_eighty_columns(monkeypatch, capsys):
    monkeypatch.setenv("COLUMNS", "80")
    show_table([row(name, status="approximate", vertices=12903) for name in PRINTED])
    lines = capsys.readouterr().out.splitlines()
    assert max(map(len, lines)) <= 80
    assert sum(line.rstrip().endswith("approximate") for line in lines) == len(PRINTED)
    assert any("times as fast as the paper" in line for line in lines)

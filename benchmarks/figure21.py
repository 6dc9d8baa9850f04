"""Fig. 21 of the paper, computed anew: seconds of optimisation beside the printed ones: `python benchmarks/figure21.py`."""

import msgspec
import numpy as np

import plisse
from cases import shipped
from clocks import alone, staged
from plisse.table import PRINTED, Row, as_markdown, table, totals
from plots import COLOURS, logarithmic, panels
from systems import one_factorisation

TITLE = "The examples of the paper"
QUICK = ("fig01a", "fig26")


def measured(quick: bool = False) -> dict:
    """Rows as of `plisse table`, the processor seconds of a second solve, and one factorisation for each."""
    plisse.design(shipped("fig10"))  # imports
    rows = [_row(name) for name in (QUICK if quick else PRINTED)]
    ours, theirs = totals([row_of(row) for row in rows])
    cpu = sum(row["cpu"] for row in rows)
    return {"rows": rows, "seconds": ours, "cpu": cpu, "paper_seconds": theirs, "ratio": theirs / ours,
            "exact": sum(row["status"] == "exact" for row in rows)}


def _row(name: str) -> dict:
    row, = table([name])
    result, spans = staged(shipped(name))
    principal = result.report.design.get("solve", {}).get("principal", False)
    limit = one_factorisation(result.structure, principal)
    return {**msgspec.to_builtins(row), "cpu": spans["solve"]["cpu"], "limit": limit}


def row_of(row: dict) -> Row:
    """The row of `plisse table` in what was measured."""
    return Row(**{key: row[key] for key in Row.__struct_fields__})


def markdown(found: dict) -> str:
    """What `plisse table --markdown` prints for these rows."""
    return as_markdown(row_of(row) for row in found["rows"])


def headline(found: dict) -> str:
    """One sentence."""
    return (f"The {len(found['rows'])} examples of the paper's Fig. 21 take {found['seconds']:.2f} s of optimisation "
            f"together ({found['cpu']:.2f} processor seconds); the paper printed {found['paper_seconds']:.1f} s, "
            f"{found['ratio']:.0f} times as long, on a machine of 2019 and to planarity of 1e-5 to 1e-3 and angles of 1e-3 "
            f"to 1e-1. {found['exact']} of them come out exact here, below 1e-9.")


def lines(found: dict) -> list[str]:
    """Markdown."""
    out = ["Seconds of optimisation only, as in the paper, on the wall clock; *processor s* is of a second solve, "
           "*one factorisation* the limit for any Newton method. Defects stand in [the table](table.md).", "",
           "| figure | vertices | paper s | here s | processor s | one factorisation s | paper / here | status |",
           "|---|--:|--:|--:|--:|--:|--:|---|"]
    for row in found["rows"]:
        ratio = row["paper_seconds"] / row["seconds"]
        out.append(f"| {row['name']} | {row['vertices']} | {row['paper_seconds']:g} | {row['seconds']:.3f} | "
                   f"{row['cpu']:.3f} | {row['limit']:.4f} | {ratio:.0f} | {row['status']} |")
    return [*out, f"| all | | {found['paper_seconds']:.1f} | {found['seconds']:.2f} | | | {found['ratio']:.0f} | |"]


def draw(found: dict):
    """Seconds of the paper, here, and of one factorisation."""
    rows = found["rows"]
    figure, (axes,) = panels(1, height=1.2 + 0.26 * len(rows))
    at = np.arange(len(rows))[::-1]
    series = (("paper, 2019", "paper_seconds", "s", COLOURS[1]), ("here", "seconds", "o", COLOURS[0]),
              ("one factorisation", "limit", "|", COLOURS[6]))
    axes.hlines(at, [row["limit"] for row in rows], [row["paper_seconds"] for row in rows], color="#cccccc", linewidth=1)
    for label, key, marker, colour in series:
        axes.plot([row[key] for row in rows], at, marker, color=colour, label=label, markersize=9 if marker == "|" else 6)
    logarithmic(axes)
    axes.set_yticks(at, [row["name"] for row in rows])
    axes.set_xlabel("seconds of optimisation")
    figure.legend(loc="outside upper center", ncols=3, frameon=False)
    return figure


if __name__ == "__main__":
    alone(measured)

"""What people see: progress on stderr while it runs, a summary on stdout at the end."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

if TYPE_CHECKING:
    from plisse.result import Interval, Report
    from plisse.table import Row

__all__ = ["list_designs", "progress", "show_check", "show_table", "summarise"]

STYLES = {"exact": "bold green", "approximate": "bold yellow", "infeasible": "bold red"}


@contextmanager
def progress(quiet: bool) -> Iterator[Callable[[str, float], None]]:
    """A callback (stage, fraction done) that draws a bar on a terminal and does nothing elsewhere."""
    console = Console(stderr=True)
    if quiet or not console.is_terminal:
        yield lambda stage, fraction: None
        return
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description}"), BarColumn(40), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True) as bars:
        task = bars.add_task("starting", total=1.0)
        yield lambda stage, fraction: bars.update(task, description=stage, completed=fraction)


def summarise(report: Report, directory: Path, *, title: str) -> None:
    """Print status, numbers, reasons and files of a finished design."""
    rows = _measures(report)
    rows += _over_surface(report)
    if report.crease_deviation is not None:
        rows.append(("distance from guides", f"max {report.crease_deviation.max:.2f}   "
                                             f"mean {report.crease_deviation.mean:.2f} amplitudes"))
    if report.development is not None:
        width, height = report.development.size_mm
        pieces = report.development.pieces
        note = f" in {pieces} pieces" * (pieces > 1) + ", overlaps itself" * report.development.overlaps
        rows.append(("sheet", f"{width:.1f} × {height:.1f} mm{note}"))
    rows.append(("seconds", f"{report.seconds.get('total', 0.0):.2f}"))
    rows.append(("files", str(directory)))
    _panel(title, report.status, rows, report.reasons + report.warnings)


def _over_surface(report: Report) -> list[tuple[str, str]]:
    """How a structure lies over its reference surface."""
    rows = []
    if report.coverage is not None:
        counts = ((report.seams, "seam"), (report.holes or 0, "hole"))
        apart = [f"{count} {name}{'s' * (count > 1)}" for count, name in counts if count]
        rows.append(("surface covered", "   ".join([f"{100 * report.coverage:.1f} %", *apart])))
    if report.deviation is not None:
        rows.append(("mid-surface off by", f"max {report.deviation.max_amplitudes:.2f}   "
                                           f"mean {report.deviation.mean_amplitudes:.2f} amplitudes"))
    return rows


def show_table(rows: list[Row]) -> None:
    """Print the examples of Fig. 21 with the paper's numbers beside ours, in 80 columns."""
    from plisse.table import PRINTED, note, totals

    shown = Table(box=box.SIMPLE, show_edge=False, padding=0, title="Fig. 21: ours beside the paper's", title_justify="left")
    for name in ("figure", "V", "F", "steps", "seconds", "paper", "planarity", "paper", "angle\ndefect", "paper", "status"):
        shown.add_column(name, justify="left" if name in ("figure", "status") else "right", no_wrap=True)
    for row in rows:
        printed = PRINTED[row.name]
        powers = (row.planarity_max, printed.planarity_max, row.angle_max, printed.angle_max)
        shown.add_row(row.name, str(row.vertices), str(row.faces), str(row.iterations), f"{row.seconds:.3f}",
                      f"{row.paper_seconds:g}", *map(_power, powers), Text(row.status, STYLES[row.status]))
    ours, theirs = totals(rows)
    shown.add_section()
    shown.add_row("all", "", "", "", f"{ours:.2f}", f"{theirs:.1f}")
    console = Console()
    console.print(shown)
    console.print(f"V vertices, F faces; {theirs / ours:.0f} times as fast as the paper", highlight=False)
    for row in rows:
        if said := note(row):
            console.print(Text(f"· {row.name}: {said}"))


def _power(value: float | None) -> str:
    return "" if value is None else f"{value:.0e}"


def show_check(report: Report, *, title: str) -> None:
    """Print verdict, numbers and reasons of a checked mesh."""
    rows = _measures(report)
    rows.append(("principal (folds flat)", "yes" if report.principal else "no"))
    rows.append(("faces folded over", str(report.inverted_faces)))
    rows.append(("self-intersections", str(report.self_intersections)))
    _panel(title, report.status, rows, report.reasons)


def _measures(report: Report) -> list[tuple[str, str]]:
    rows = [("vertices, faces", f"{report.vertices:,}, {report.faces:,}")]
    for name in ("planarity", "angle_defect", "principal_defect"):
        spread = getattr(report, name)
        if spread is not None:
            rows.append((name.replace("_", " "), f"max {spread.max:.1e}   mean {spread.mean:.1e}"))
    if report.min_sector_angle_deg is not None:
        rows.append(("smallest sector angle", f"{report.min_sector_angle_deg:.1f}°"))
    if report.opening_angle_deg is not None:
        rows.append(("opening angles", _range(report.opening_angle_deg)))
    if report.edge_scales is not None:
        rows.append(("edge scales", f"{report.edge_scales.min:.3g} to {report.edge_scales.max:.3g}"))
    angles = [entry.inclination_deg for entry in report.strips if entry.inclination_deg is not None]
    if angles:
        from plisse.draw.strips import degrees_text

        low, high = min(angle.min for angle in angles), max(angle.max for angle in angles)
        rows.append(("strips to the surface", degrees_text(low, high, 2)))
    return rows


def list_designs(descriptions: dict[str, str]) -> None:
    """Print names and what they show, one a line."""
    table = Table(box=None, show_header=False, pad_edge=False)
    for name, text in descriptions.items():
        table.add_row(Text(name, style="bold"), Text(text))
    Console().print(table)


def _range(interval: Interval) -> str:
    return f"{interval.min:.1f}° to {interval.max:.1f}°"


def _panel(title: str, status: str, rows: list[tuple[str, str]], reasons: list[str]) -> None:
    console = Console(highlight=False)
    console.print(Text.assemble((title, "bold"), "  ", (status, STYLES.get(status, "bold"))))
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    for name, value in rows:
        table.add_row(Text(name, style="dim"), Text(value))
    console.print(table)
    for reason in reasons:
        console.print(Text(f"· {reason}"))

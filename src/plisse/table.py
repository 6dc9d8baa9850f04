"""Fig. 21 again: what the paper printed for its examples, beside what comes out here."""

from collections.abc import Callable, Iterable
from importlib.resources import files

import msgspec

from plisse.pipeline import design
from plisse.result import Report, Spread

__all__ = ["PRINTED", "Printed", "Row", "as_json", "as_markdown", "note", "table"]


class Printed(msgspec.Struct, frozen=True):
    """One line of Fig. 21: size, iterations, seconds, and the defects that can be read there."""

    vertices: int
    faces: int
    iterations: int
    seconds: float
    planarity_max: float | None = None
    planarity_mean: float | None = None
    angle_max: float | None = None
    angle_mean: float | None = None


PRINTED = {
    "fig01a": Printed(684, 600, 20, 1.8),
    "fig01c": Printed(1938, 1818, 20, 6.3, 5.9e-5, 7.4e-6, 1.4e-2, 2.5e-3),
    "fig01d": Printed(2904, 2651, 20, 12.0),
    "fig02": Printed(3600, 3479, 10, 5.4),
    "fig09": Printed(760, 720, 20, 2.2),
    "fig12": Printed(3600, 3540, 10, 8.7),
    "fig16": Printed(1700, 1600, 10, 2.7),
    "fig18": Printed(12740, 12332, 10, 51.0, 3.4e-3, 1.5e-3, 1.2e-1, 3.6e-2),
    "fig19": Printed(6800, 6400, 10, 10.0, 1.7e-3, 4.0e-4, 4.3e-2, 6.7e-3),
    "fig20a": Printed(2400, 2340, 10, 3.8, 3.4e-3, 1.0e-3, 2.8e-1, 5.9e-3),
    "fig20b": Printed(4800, 4720, 10, 10.1),
    "fig20c": Printed(2940, 2832, 10, 4.8),
    "fig22": Printed(3027, 2880, 20, 8.5),
    "fig24a": Printed(3200, 3000, 10, 5.3, 1.8e-4, 7.3e-6, 8.1e-2, 1.2e-2),
    "fig24b": Printed(1440, 1680, 10, 2.8),
    "fig26": Printed(320, 600, 10, 0.3),
    "fig27": Printed(2200, 1990, 20, 8.7, 2.5e-5, 3.6e-6, 7.2e-4, 7.8e-6),
}


class Row(msgspec.Struct, frozen=True, kw_only=True):
    """One example of Fig. 21 as it comes out here; `seconds` is optimisation only, as in the paper."""

    name: str
    vertices: int
    faces: int
    iterations: int
    seconds: float
    planarity_max: float
    planarity_mean: float
    angle_max: float
    angle_mean: float
    status: str
    paper_seconds: float


def table(names: Iterable[str] | None = None, *, progress: Callable[[str, float], None] | None = None) -> list[Row]:
    """Rows for examples of Fig. 21, all that are shipped unless `names` are given; each is solved anew.

    `progress(name, fraction)` hears which one is next.
    """
    shipped = [name for name in PRINTED if _file(name).is_file()] if names is None else list(names)
    rows = []
    for number, name in enumerate(shipped):
        if progress:
            progress(name, number / len(shipped))
        rows.append(_row(name, design(str(_file(name))).report))
    return rows


def as_markdown(rows: Iterable[Row]) -> str:
    """The table in Markdown, with the paper's numbers beside ours and the totals below."""
    rows = list(rows)
    lines = ["| figure | vertices | faces | steps | seconds | paper | planarity | paper | angle defect | paper | status |",
             "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|"]
    for row in rows:
        printed = PRINTED[row.name]
        cells = [row.name, str(row.vertices), str(row.faces), str(row.iterations), f"{row.seconds:.3f}",
                 f"{row.paper_seconds:g}", _power(row.planarity_max), _power(printed.planarity_max),
                 _power(row.angle_max), _power(printed.angle_max), row.status]
        lines.append("| " + " | ".join(cells) + " |")
    ours, theirs = totals(rows)
    lines.append(f"| all | | | | **{ours:.2f}** | **{theirs:.1f}** | | | | | 1 / {theirs / ours:.0f} |")
    return "\n".join(lines) + "\n"


def as_json(rows: Iterable[Row]) -> list[dict]:
    """Rows as objects, with everything that the paper printed for them under `paper_…` and a `note` on other sizes."""
    asdict = msgspec.structs.asdict
    return [{**asdict(row), **{f"paper_{key}": value for key, value in asdict(PRINTED[row.name]).items()}, "note": note(row)}
            for row in rows]


def note(row: Row) -> str | None:
    """Where the size is not the printed one, what the paper printed."""
    printed = PRINTED[row.name]
    if (row.vertices, row.faces) == (printed.vertices, printed.faces):
        return None
    return f"the paper printed {printed.vertices} vertices and {printed.faces} faces"


def totals(rows: Iterable[Row]) -> tuple[float, float]:
    """Seconds of optimisation of all rows, here and in the paper."""
    rows = list(rows)
    return sum(row.seconds for row in rows), sum(row.paper_seconds for row in rows)


def _row(name: str, report: Report) -> Row:
    none = Spread(0.0, 0.0)  # of designs that broke down: their status says so
    plan, angle = report.planarity or none, report.angle_defect or none
    return Row(name=name, vertices=report.vertices, faces=report.faces, iterations=report.iterations,
               seconds=report.seconds.get("solve", 0.0), planarity_max=plan.max, planarity_mean=plan.mean,
               angle_max=angle.max, angle_mean=angle.mean, status=report.status, paper_seconds=PRINTED[name].seconds)


def _power(value: float | None) -> str:
    return "" if value is None else f"{value:.0e}"


def _file(name: str):
    return files("plisse") / "gallery" / f"{name}.toml"

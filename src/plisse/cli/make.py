"""`plisse make`: from a design to its files."""

from __future__ import annotations

from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from plisse.cli.limits import Memory, Threads, bound

if TYPE_CHECKING:
    from plisse.result import Report, Result

__all__ = ["FILES", "make", "write_files"]

FILES = ("structure.fold", "structure.obj", "development.svg", "preview.png", "overlay.png", "family.png",
         "cutting-list.csv", "solids.stl", "report.json")


def make(
    design: str,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    set_: Annotated[tuple[str, ...], Parameter(name="--set", negative=())] = (),
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
    threads: Threads = None,
    memory: Memory = None,
) -> int:
    """Make a structure: folded and flat, with a picture and the report that proves it.

    Parameters
    ----------
    design
        A design file (TOML), or a name that `plisse gallery` lists.
    output
        Directory for the files; the design's name if left out.
    set_
        section.key=value overrides the design, for example pattern.theta=30; may be repeated.
    json
        Print the report as JSON instead of a summary.
    quiet
        Print nothing.
    """
    bound(threads, memory)
    from plisse.cli.console import progress, summarise
    from plisse.io.atomic import require_writable
    from plisse.io.designs import read_design
    from plisse.io.report import report_json
    from plisse.shipped import find_design

    path = find_design(design)
    recipe = read_design(path, set_)
    directory = Path(path.stem) if output is None else output
    require_writable(directory, FILES)
    from plisse.pipeline import design as solve

    with progress(quiet or json) as advance:
        result = solve(recipe, progress=advance)
        advance("writing files", 0.97)
        report = write_files(result, directory, title=path.stem)
    if json:
        print(report_json(report), end="")
    elif not quiet:
        summarise(report, directory, title=path.stem)
    return 0 if report.status == "exact" else 3


def write_files(result: Result, directory: Path, *, title: str) -> Report:
    """The report as written: `directory` gets all FILES that exist for the result, together or not at all."""
    from plisse.cli.strip_files import write_strip_files
    from plisse.draw.drawing import crease_pattern
    from plisse.draw.family import write_family
    from plisse.draw.overlay import write_overlay
    from plisse.draw.preview import write_preview
    from plisse.io.atomic import written_together
    from plisse.io.fold import write_fold
    from plisse.io.obj import write_obj
    from plisse.io.report import write_report
    from plisse.io.svg import write_svg

    start = perf_counter()
    structure, units = result.structure, result.report.units
    with written_together(directory, owned=FILES) as stage:
        if structure is not None:
            write_obj(structure, stage / "structure.obj", title=title, units=units)
        if result.arrangement is not None:
            write_strip_files(result, stage, title=title)
        elif structure is not None:
            write_preview(result, stage / "preview.png", title=title)
        if result.family:
            write_family(result.family, stage / "family.png", title=title)
        if structure is not None and result.overlay is not None:
            over = result.overlay
            write_overlay(structure, over.mesh, over.distances, stage / "overlay.png", amplitude=over.amplitude, title=title)
        if structure is not None and structure.development is not None:
            write_fold(structure, stage / "structure.fold", title=title, units=units)
            if result.arrangement is None:
                write_svg(crease_pattern(structure, units, title=title), stage / "development.svg")
        report = _with_seconds(result.report, perf_counter() - start)
        write_report(report, stage / "report.json")
    return report


def _with_seconds(report: Report, elapsed: float) -> Report:
    """The report with the time for files among its seconds, and in their total."""
    from msgspec.structs import replace

    stages = {stage: value for stage, value in report.seconds.items() if stage != "total"}
    total = report.seconds.get("total", sum(stages.values())) + elapsed
    return replace(report, seconds={**stages, "files": elapsed, "total": total})

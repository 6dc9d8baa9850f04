"""`plisse offset`: a principal structure at constant distance from another one."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

__all__ = ["offset"]


def offset(
    structure: Path,
    /,
    *,
    distance: float,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Offset a principal structure: the same faces at constant distance, edges parallel, principal again.

    A picture of the offset and its development is written beside.

    Parameters
    ----------
    structure
        A .fold or .obj file with a folded principal structure.
    distance
        Face to face, in the units of the file; positive on the side that faces are oriented to (the front of the
        sheet), negative on the other.
    output
        A .fold or .obj file; the structure's name with -offset.fold if left out.
    json
        Print the report on the offset as JSON instead of a summary.
    quiet
        Print nothing.
    """
    from plisse.assess import assess
    from plisse.cli.console import show_check
    from plisse.cli.targets import refuse_source, structure_writer
    from plisse.draw.preview import write_preview
    from plisse.io.atomic import require_writable, written_together
    from plisse.io.report import report_json
    from plisse.io.structures import read_model

    target = Path(f"{structure.stem}-offset.fold") if output is None else output
    write = structure_writer(target)
    refuse_source(target, structure)
    model = read_model(structure)
    moved = model.structure.offset(distance)
    report = assess(moved, principal=True, units=model.units)
    title = f"{model.title}, offset {distance:g} {model.units}"
    picture = target.with_suffix(".png").name
    require_writable(target.parent, [target.name, picture])
    with written_together(target.parent) as stage:
        write(moved, stage / target.name, title=title, units=model.units)
        write_preview(moved, stage / picture, title=title, units=model.units)
    if json:
        print(report_json(report), end="")
    elif not quiet:
        show_check(report, title=title)
    return 0 if report.status == "exact" else 3

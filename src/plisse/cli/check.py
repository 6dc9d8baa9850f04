"""`plisse check`: measures of any quad mesh."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

__all__ = ["check"]


def check(file: Path, /, *, json: Annotated[bool, Parameter(negative=())] = False) -> int:
    """Measure a FOLD, OBJ or 3DM quad mesh: is it an exact pleated structure?

    Parameters
    ----------
    file
        A .fold, .obj or .3dm file with one mesh of quads; `l` polylines mark the creases of an .obj file.
    json
        Print the numbers as JSON.
    """
    from plisse.assess import assess
    from plisse.cli.console import show_check
    from plisse.io.report import report_json
    from plisse.io.structures import read_structure

    report = assess(read_structure(file))
    if json:
        print(report_json(report), end="")
    else:
        show_check(report, title=file.name)
    return 0 if report.status == "exact" else 3

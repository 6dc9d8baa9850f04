"""`plisse check`: measures of any quad mesh."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

__all__ = ["check"]


def check(file: Path, /, *, json: Annotated[bool, Parameter(negative=())] = False) -> int:
    """Measure a FOLD or OBJ quad mesh: is it an exact pleated structure?

    Parameters
    ----------
    file
        A .fold file or an .obj file with quads; `l` polylines mark its creases.
    json
        Print the numbers as JSON.
    """
    from plisse.cli.console import show_findings
    from plisse.cli.findings import findings, findings_json, read_structure

    found = findings(read_structure(file))
    if json:
        print(findings_json(found), end="")
    else:
        show_findings(found, title=file.name)
    return 0 if found.status == "exact" else 3

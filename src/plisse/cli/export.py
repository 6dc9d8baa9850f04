"""`plisse export`: a structure in the format of another program."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

__all__ = ["export"]


def export(
    structure: Path,
    /,
    *,
    output: Annotated[tuple[Path, ...], Parameter(name=["--output", "-o"], negative=())],
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Write a structure for another program; the extension names the format.

    Folded and flat: .fold, .3dm. Folded: .obj, .ply, .stl, .3mf, .glb. The flat sheet at 1:1: .svg, .dxf, .pdf.

    Parameters
    ----------
    structure
        A .fold file, or an .obj or .3dm file with a quad mesh.
    output
        A file to write; may be repeated.
    quiet
        Print nothing.
    """
    from plisse.io.exports import export as write
    from plisse.io.structures import read_model

    write(read_model(structure), list(output))
    if not quiet:
        for path in output:
            print(path)
    return 0

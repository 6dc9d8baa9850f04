"""The files of strips that stand beside structure.obj and structure.fold."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plisse.result import Result

__all__ = ["write_strip_files"]


def write_strip_files(result: Result, directory: Path, *, title: str) -> None:
    """Write preview.png, development.svg, cutting-list.csv and, where strips are thick, solids.stl."""
    from plisse.draw.strips import cutting_drawing, write_strips_picture
    from plisse.io.strips import write_cutting_list, write_solids
    from plisse.io.svg import write_svg
    from plisse.transform.strip_solids import strip_solid

    arrangement, units = result.arrangement, result.report.units
    assert arrangement is not None
    write_strips_picture(arrangement, directory / "preview.png", surface=result.surface, title=title, units=units)
    write_svg(cutting_drawing(arrangement, units, title=title), directory / "development.svg")
    write_cutting_list(result.report.strips, directory / "cutting-list.csv")
    strips = result.design.strips
    assert strips is not None
    if strips.thickness is not None:
        solids = [strip_solid(strip, strips.thickness) for strip in arrangement.strips]
        write_solids(solids, directory / "solids.stl", units=units)

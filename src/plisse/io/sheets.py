"""Sheets in the formats that cutters and printers read, by extension; all files or none."""

import xml.etree.ElementTree as ET
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path

from plisse.draw.drawing import Drawing
from plisse.errors import PlisseError
from plisse.extras import optional
from plisse.io.atomic import numbered_files, require_writable, written, written_together
from plisse.io.dxf import write_dxf
from plisse.io.pdf import write_pdf
from plisse.io.svg import SVG, write_svg

__all__ = ["require_place", "write_sheets"]

TOGETHER: dict[str, tuple[Callable[[list[Drawing], Path], None], tuple[str, str, str]]] = {
    ".dxf": (write_dxf, ("ezdxf", "cad", "DXF files")),
    ".pdf": (write_pdf, ("reportlab", "pdf", "PDF files")),
}


def require_place(path: Path) -> None:
    """Nothing; raises PlisseError before any work where `path` cannot be written or its format is unknown.

    Without an extension it is a directory. Raises MissingExtra where the format needs a library that is not installed.
    """
    suffix = path.suffix.lower()
    if suffix in TOGETHER:
        module, extra, purpose = TOGETHER[suffix][1]
        optional(module, extra=extra, purpose=purpose)
    elif suffix not in ("", ".svg"):
        raise PlisseError(f"{path.name} is no kind of file that holds sheets; give .svg, .dxf, .pdf or a directory")
    if suffix == "":
        require_writable(path)
        return
    if not path.parent.is_dir():
        raise PlisseError(f"{path} cannot be written, because there is no directory {path.parent}; make it first")
    require_writable(path.parent, [path.name])


def write_sheets(drawings: list[Drawing], path: Path) -> list[Path]:
    """The files written: one .dxf with the sheets side by side, one .pdf with a page each, or one .svg each.

    Several .svg files are numbered: name-1.svg, name-2.svg, …; a directory gets sheet-1.svg, sheet-2.svg, …. Files of
    these names from an earlier run that this one does not write are removed, beside a name.svg only sheets of the
    same title. Raises PlisseError where the place cannot be written.
    """
    if path.suffix.lower() in TOGETHER:
        TOGETHER[path.suffix.lower()][0](drawings, path)
        return [path]
    if path.suffix == "":
        names = [f"sheet-{k}.svg" for k in range(1, len(drawings) + 1)]
        with written_together(path, owned=numbered_files(path, "sheet-", ".svg")) as stage:
            for drawing, name in zip(drawings, names, strict=True):
                write_svg(drawing, stage / name)
        return [path / name for name in names]
    paths = [path] if len(drawings) == 1 else [path.with_stem(f"{path.stem}-{k}") for k in range(1, len(drawings) + 1)]
    with ExitStack() as together:
        for drawing, place in zip(drawings, paths, strict=True):
            write_svg(drawing, together.enter_context(written(place)))
    for former in _former(path, drawings[0].title):
        if former not in paths:
            former.unlink()
    return paths


def _former(path: Path, title: str) -> list[Path]:
    """Sheets with the title of a drawing, but for what follows `sheet`, at `path` and numbered beside it."""
    design, sheet, _ = title.rpartition("sheet ")
    names = [path.name, *numbered_files(path.parent, f"{path.stem}-", path.suffix)]
    places = [path.with_name(name) for name in names if path.with_name(name).is_file()]
    return [place for place in places if sheet and _title(place).startswith(design + sheet)]


def _title(path: Path) -> str:
    """Title of an SVG file, empty where it has none or is none."""
    try:
        return ET.parse(path).findtext(f"{{{SVG}}}title", "")
    except ET.ParseError:
        return ""

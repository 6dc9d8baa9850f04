"""Everything a design can be taken away as: bytes under a file name that comes from its title."""

import re
import tempfile
from collections.abc import Callable
from pathlib import Path

from plisse.draw.colour_maps import deviation_of
from plisse.draw.preview import write_preview
from plisse.errors import PlisseError
from plisse.io.exports import BOTH, FLAT, FOLDED, export
from plisse.io.model import Model
from plisse.io.report import report_json
from plisse.result import Result
from plisse.studio.bench import required

__all__ = ["KINDS", "file_name", "made"]

Write = Callable[[Result, str, Path], None]


def file_name(title: str, kind: str) -> str:
    """A harmless file name from a title and a kind of KINDS."""
    stem = re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower()[:40].strip("-") or "design"
    return f"{stem}{KINDS[kind][0]}"


def made(result: Result, title: str, kind: str) -> bytes:
    """The bytes of one kind of KINDS; errors are those of the writers, MissingExtra where one needs a library."""
    with tempfile.TemporaryDirectory(prefix="plisse-studio-") as directory:
        path = Path(directory) / file_name(title, kind)
        KINDS[kind][1](result, title, path)
        return path.read_bytes()


def _export(result: Result, title: str, path: Path) -> None:
    export(Model(required(result), result.report.units, title), [path])


def _report(result: Result, title: str, path: Path) -> None:
    path.write_text(report_json(result.report), encoding="utf-8")


def _page(result: Result, title: str, path: Path) -> None:
    from plisse.io.page import report_page

    page = report_page(required(result), result.report, title=title, deviation=deviation_of(result))
    path.write_text(page, encoding="utf-8")


def _picture(result: Result, title: str, path: Path) -> None:
    from plisse.draw.picture import write_picture

    write_picture(required(result), path)


def _preview(result: Result, title: str, path: Path) -> None:
    required(result)
    write_preview(result, path, title=title)


def _sheets(result: Result, title: str, path: Path) -> None:
    from plisse.draw.sheets import sheet_drawings
    from plisse.io.sheets import write_sheets

    structure = required(result)
    if structure.development is None:
        raise PlisseError("the structure has no development, so there are no sheets to cut")
    write_sheets(sheet_drawings(structure.sheets(units=result.report.units), title=title), path)


def _motion(result: Result, title: str, path: Path) -> None:
    from plisse.io.glb import write_motion_glb

    percent = [200 * k / 40 for k in range(41)]
    write_motion_glb(required(result).flex(percent), path, title=title, units=result.report.units)


KINDS: dict[str, tuple[str, Write]] = {
    **{suffix[1:].upper(): (suffix, _export) for suffix in (*BOTH, *FOLDED)},
    **{f"flat sheet, {suffix[1:].upper()}": (f"-sheet{suffix}", _export) for suffix in FLAT},
    "pieces nested on sheets, PDF": ("-pieces.pdf", _sheets),
    "pieces nested on sheets, DXF": ("-pieces.dxf", _sheets),
    "motion, GLB": ("-motion.glb", _motion),
    "picture, PNG": (".png", _picture),
    "picture with the sheet, PNG": ("-preview.png", _preview),
    "report, JSON": ("-report.json", _report),
    "report page, HTML": ("-report.html", _page),
}

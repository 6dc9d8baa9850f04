"""Everything a design can be taken away as: bytes under a file name that comes from its title."""

import re
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plisse.draw.camera import Camera
from plisse.draw.colour_maps import ColourMap, colour_maps, deviation_of
from plisse.draw.preview import write_preview
from plisse.draw.runs import Run
from plisse.draw.thick import thick_sheet
from plisse.io.exports import BOTH, FLAT, FOLDED, export
from plisse.io.model import Model
from plisse.io.plate_solids import write_plate_solids
from plisse.io.plate_table import write_plates_csv
from plisse.io.report import report_json
from plisse.result import Result
from plisse.structure.pleated import PleatedStructure
from plisse.studio.bench import required
from plisse.transform.collisions import DESIGNED
from plisse.transform.flex import Motion

__all__ = ["KINDS", "MATERIAL", "Order", "file_name", "made"]

MATERIAL = (600.0, 300.0)
STATES, FRAMES = 41, 21
PIXELS = (1600, 1200)
PLATES = (".obj", ".stl", ".3mf", ".glb")


@dataclass(frozen=True, eq=False)
class Order:
    """A result with its title, and how files of it are to be made.

    `length` is the thickness of plates or the distance of the offset in model units, `camera` is where a picture is
    taken from, and it shows what is on screen: `solid` is "plates", "offset" or nothing, `colour` names a colour map or
    none, `percent` is the state of the motion. `material` is the size of sheets in mm.
    """

    result: Result
    title: str
    length: float = 1.0
    camera: Camera | None = None
    colour: str = ""
    material: tuple[float, float] = MATERIAL
    percent: float = DESIGNED
    solid: str = ""


Write = Callable[[Order, Path], None]


def file_name(title: str, kind: str) -> str:
    """A harmless file name from a title and a kind of KINDS."""
    stem = re.sub(r"[^A-Za-z0-9]+", "-", title).strip("-").lower()[:40].strip("-") or "design"
    return f"{stem}{KINDS[kind][0]}"


def made(order: Order, kind: str) -> bytes:
    """The bytes of one kind of KINDS; errors are those of the writers, MissingExtra where one needs a library."""
    required(order.result) if kind != REPORT else None
    with tempfile.TemporaryDirectory(prefix="plisse-studio-") as directory:
        path = Path(directory) / file_name(order.title, kind)
        KINDS[kind][1](order, path)
        return path.read_bytes()


def _model(order: Order) -> Model:
    return Model(required(order.result), order.result.report.units, order.title)


def _export(order: Order, path: Path) -> None:
    export(_model(order), [path])


def _offset(order: Order, path: Path) -> None:
    model, title = _model(order), f"{order.title}, offset {order.length:g} {order.result.report.units}"
    export(Model(model.structure.offset(order.length), model.units, title), [path])


def _plates(order: Order, path: Path) -> None:
    model = _model(order)
    write_plate_solids(model.structure.plates(order.length), path, title=f"plates of {order.title}", units=model.units)


def _plate_table(order: Order, path: Path) -> None:
    write_plates_csv(required(order.result).plates(order.length), path)


def _report(order: Order, path: Path) -> None:
    path.write_text(report_json(order.result.report), encoding="utf-8")


def _page(order: Order, path: Path) -> None:
    from plisse.io.page import report_page

    result = order.result
    page = report_page(required(result), result.report, title=order.title, deviation=deviation_of(result))
    path.write_text(page, encoding="utf-8")


def _picture(order: Order, path: Path) -> None:
    from plisse.draw.picture import Style, write_picture

    structure, colour, runs = _on_screen(order)
    write_picture(structure, path, camera=order.camera, style=Style(PIXELS, colour=colour), runs=runs)


def _on_screen(order: Order) -> tuple[PleatedStructure, ColourMap | None, list[Run] | None]:
    """What is seen, its colours and its lines; states of the motion, plates and offsets are paper."""
    structure = required(order.result)
    if order.percent != DESIGNED:
        return structure.flex(order.percent).structures[0], None, None
    if order.solid == "plates":
        thick = thick_sheet(structure.plates(order.length))
        return thick.structure, None, thick.runs
    if order.solid == "offset":
        return structure.offset(order.length), None, None
    return structure, colour_maps(structure, deviation_of(order.result)).get(order.colour), None


def _preview(order: Order, path: Path) -> None:
    write_preview(order.result, path, title=order.title)


def _sheets(order: Order, path: Path) -> None:
    from plisse.draw.sheets import sheet_drawings
    from plisse.io.exports import developed
    from plisse.io.sheets import write_sheets

    model = developed(_model(order))
    plan = model.structure.sheets(material=order.material, units=model.units)
    write_sheets(sheet_drawings(plan, title=order.title), path)


def _motion_fold(order: Order, path: Path) -> None:
    from plisse.io.motion import write_motion_fold

    write_motion_fold(_motion(order, STATES), path, title=order.title, units=order.result.report.units)


def _motion_glb(order: Order, path: Path) -> None:
    from plisse.io.glb import write_motion_glb

    write_motion_glb(_motion(order, STATES), path, title=order.title, units=order.result.report.units)


def _motion_gif(order: Order, path: Path) -> None:
    from plisse.draw.animation import write_gif

    write_gif(_motion(order, FRAMES), path)


def _motion(order: Order, states: int) -> Motion:
    """The whole motion, from flat to folded flat."""
    return required(order.result).flex(np.linspace(0, 200, states).tolist())


REPORT = "report, JSON"
KINDS: dict[str, tuple[str, Write]] = {
    **{suffix[1:].upper(): (suffix, _export) for suffix in (*BOTH, *FOLDED)},
    **{f"flat sheet, {suffix[1:].upper()}": (f"-sheet{suffix}", _export) for suffix in FLAT},
    "pieces nested on sheets, PDF": ("-pieces.pdf", _sheets),
    "pieces nested on sheets, DXF": ("-pieces.dxf", _sheets),
    "motion, FOLD": ("-motion.fold", _motion_fold),
    "motion, GLB": ("-motion.glb", _motion_glb),
    "motion, GIF": ("-motion.gif", _motion_gif),
    "offset, FOLD": ("-offset.fold", _offset),
    **{f"plates, {suffix[1:].upper()}": (f"-plates{suffix}", _plates) for suffix in PLATES},
    "plates, table (CSV)": ("-plates.csv", _plate_table),
    "picture, PNG": (".png", _picture),
    "picture with the sheet, PNG": ("-preview.png", _preview),
    REPORT: ("-report.json", _report),
    "report page, HTML": ("-report.html", _page),
}

"""`plisse plates`: solid plates of constant thickness for a principal structure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.draw.drawing import Drawing
    from plisse.io.model import Model
    from plisse.transform.hinged_range import HingedRange
    from plisse.transform.plates import Plates

__all__ = ["plates"]


def plates(
    structure: Path,
    /,
    *,
    thickness: float,
    gap: float = 0.0,
    side: Literal["inner", "outer", "both"] = "outer",
    hinged: Annotated[bool, Parameter(negative=())] = False,
    material: str | None = None,
    kerf: float = 0.0,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Make a solid plate on every face of a principal structure: mitred, or square on a film that still moves.

    A table (.csv and .json: outlines, bevels, neighbours), a picture and the film at 1:1 (.svg) are written beside.

    Parameters
    ----------
    structure
        A .fold or .obj file with a folded principal structure.
    thickness
        Thickness of the plates, in the units of the file.
    gap
        Distance of neighbouring plates in the plane of the faces, in the units of the file; hinged plates need one.
    side
        Where plates lie: outer is the side that faces are oriented to (the front of the sheet), inner the other, both
        half on each.
    hinged
        Cut plates square, for a film that carries them and is the hinge, instead of mitring them.
    material
        Width x height of a sheet in mm, for example 600x300: all plates laid out on such sheets too (-sheet-1.svg, …).
    kerf
        Width of the cut in mm; outlines on sheets grow by half of it.
    output
        plates.obj, .stl, .glb or .3mf, or a directory for one STL per plate and an OBJ of all; `plates` if left out.
    json
        Print the report as JSON instead of a summary.
    quiet
        Print nothing.
    """
    from plisse.cli.targets import refuse_source
    from plisse.errors import PlisseError
    from plisse.io.plate_solids import require_format
    from plisse.io.structures import read_model
    from plisse.transform.hinged_range import hinged_range

    target = Path("plates") if output is None else output
    if kerf and material is None:
        raise PlisseError("--kerf is for plates laid out on material; give --material, for example 600x300, or leave it out")
    if target.suffix and not target.is_dir():
        require_format(target)
    refuse_source(target, structure)
    model = read_model(structure)
    made = model.structure.plates(thickness, gap=gap, side=side, hinged=hinged)
    movement = hinged_range(made) if hinged else None
    nested = [] if material is None else _nested(made, model, material, kerf)
    report = _write(made, movement, model, target, nested)
    if json:
        import json as encoder

        print(encoder.dumps(report, indent=1))
    elif not quiet:
        _show(report, target)
    return 0


def _nested(made: Plates, model: Model, material: str, kerf: float) -> list[Drawing]:
    """Sheets of the material with the outlines of all plates."""
    from plisse.cli.sheets import material_size
    from plisse.draw.plate_sheets import plate_drawings
    from plisse.fabricate.plate_sheets import plate_sheets

    plan = plate_sheets(made, material=material_size(material), units=model.units, kerf=kerf)
    return plate_drawings(plan, title=f"plates of {model.title}")


def _write(made: Plates, movement: HingedRange | None, model: Model, target: Path, nested: list[Drawing]) -> dict:
    """The report without its table; all files are written, into the target or its directory, together or not at all."""
    from plisse.draw.plates import film, write_plates_picture
    from plisse.io.atomic import numbered_files, require_writable, written_together
    from plisse.io.plate_solids import write_plate_solids, write_solid_stl
    from plisse.io.plate_table import plates_document, write_plates_csv, write_plates_json
    from plisse.io.svg import write_svg
    from plisse.transform.solids import solids

    single = bool(target.suffix) and not target.is_dir()
    directory, stem = (target.parent, target.stem) if single else (target, "plates")
    names = [target.name if single else "plates.obj", *(stem + suffix for suffix in (".csv", ".json", ".png", ".svg"))]
    require_writable(directory, names)
    former = numbered_files(directory, f"{stem}-sheet-", ".svg")
    former += [] if single else numbered_files(target, "plate_", ".stl")
    title = f"plates of {model.title}"
    document = plates_document(made, movement, units=model.units, title=title)
    with written_together(directory, owned=former) as stage:
        write_plate_solids(made, stage / names[0], title=title, units=model.units)
        write_plates_csv(made, stage / names[1])
        write_plates_json(document, stage / names[2])
        write_plates_picture(made, stage / names[3], movement=movement, title=title, units=model.units)
        if made.structure.development is not None:
            write_svg(film(made, model.units, title=title), stage / names[4])
        for number, drawing in enumerate(nested, 1):
            write_svg(drawing, stage / f"{stem}-sheet-{number}.svg")
        for number, solid in enumerate([] if single else solids(made), 1):
            write_solid_stl(solid, stage / f"plate_{number:0{len(str(made.count))}d}.stl", model.units)
    return {key: value for key, value in document.items() if key != "table"}


def _show(report: dict, target: Path) -> None:
    from rich.console import Console

    console, units = Console(highlight=False), report["units"]
    way = "square on a film" if report["hinged"] else "mitred along the cone axes"
    lines = [f"{target}  {report['plates']:,} plates, {report['thickness']:g} {units} thick, {way}, gap {report['gap']:g}",
             f"area {report['total_area']:.6g} {units}², volume {report['total_volume']:.6g} {units}³"]
    if report["largest_thickness"] is not None:
        lines.append(f"plates may be up to {report['largest_thickness']:.5g} {units} thick")
    if report["hinged"]:
        low, high = report["free_range_percent"]
        bare_low, bare_high = report["free_range_of_faces_percent"]
        limit = report["largest_thickness_for_range_of_faces"]
        lines += [f"moves freely from {low:.4g} to {high:.4g} %",
                  f"bare faces do from {bare_low:.4g} to {bare_high:.4g} %, hinges follow with up to {limit:.3g} {units}"]
    lines += [f"· {note}" for note in [*report.get("reasons", []), *report["warnings"]]]
    for line in lines:
        console.print(line, soft_wrap=True)

"""`plisse strips`: rectifying strips along creases or guiding curves."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.io.model import Model
    from plisse.recipe import Design, Strips, SurfaceDesign
    from plisse.result import Result
    from plisse.transform.arrangement import Arrangement

__all__ = ["strips"]

CURVES = (".csv", ".txt", ".npy")
STRUCTURES = (".fold", ".obj", ".3dm", ".json")


def strips(
    source: str,
    /,
    *,
    width: float | None = None,
    thickness: float | None = None,
    side: Literal["both", "above", "below"] | None = None,
    crease: Annotated[tuple[int, ...], Parameter(negative=())] = (),
    closed: Annotated[bool, Parameter(negative=())] = False,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Strips that stand along creases or curves and unfold straight: cutting list, drawing, solids.

    Every strip is the discrete rectifying developable of its curve. Where its rulings meet within the width it is
    narrowed or shortened, and the report says so.

    Parameters
    ----------
    source
        A .fold or .obj file with a structure, a .csv, .txt or .npy file with a curve, or a design (TOML or gallery name)
        whose guiding curves are wanted.
    width
        Width of the strips, both sides of the curve together; needed unless the design gives it.
    thickness
        Thickness of solids, written as solids.stl.
    side
        On which side of their curves strips lie: both, above or below.
    crease
        Numbers of the creases (from 1) instead of all; may be repeated.
    closed
        The curve in the file is closed.
    output
        Directory for the files; the source's name with -strips if left out.
    json
        Print the report as JSON instead of a summary.
    quiet
        Print nothing.
    """
    from plisse.cli.console import summarise
    from plisse.cli.make import FILES, write_files
    from plisse.io.atomic import require_writable
    from plisse.io.report import report_json

    path = Path(source)
    directory = Path(f"{path.stem}-strips") if output is None else output
    require_writable(directory, FILES)
    _refuse_idle(path, crease, closed)
    if path.suffix.lower() in (*CURVES, *STRUCTURES):
        result, title = _from_file(path, _wanted(width, thickness, side), crease, closed)
    else:
        title = path.stem
        result = _from_design(source, width, thickness, side)
    if result.structure is None:
        from plisse.errors import Infeasible

        raise Infeasible(result.report.reasons[0])
    report = write_files(result, directory, title=title)
    if json:
        print(report_json(report), end="")
    elif not quiet:
        summarise(report, directory, title=title)
    return 0 if report.status == "exact" else 3


def _refuse_idle(path: Path, creases: tuple[int, ...], closed: bool) -> None:
    """Nothing; raises InvalidDesign for options that mean nothing for a source of this kind."""
    from plisse.errors import InvalidDesign

    if closed and path.suffix.lower() not in CURVES:
        raise InvalidDesign(f"--closed is for curves in files ({', '.join(CURVES)}), and {path.name} is none; leave it out")
    if creases and path.suffix.lower() not in STRUCTURES:
        raise InvalidDesign(f"--crease chooses creases of a structure in a file, and {path.name} is none; leave it out")


def _wanted(width: float | None, thickness: float | None, side: str | None) -> Strips:
    from plisse.errors import InvalidDesign
    from plisse.io.designs import section_from_options
    from plisse.io.strips_consistency import check_thickness

    if width is None:
        raise InvalidDesign("--width is missing; say how wide the strips shall be")
    wanted = section_from_options("strips", {"width": width, "thickness": thickness, "side": side})
    check_thickness(wanted)
    return wanted


def _from_file(path: Path, wanted: Strips, creases: tuple[int, ...], closed: bool) -> tuple[Result, str]:
    """Strips along the creases of a structure, or along the curve in a file, and their title."""
    from plisse.assess_strips import assess_strips
    from plisse.recipe import Design
    from plisse.result import Result
    from plisse.transform.arrangement import surface_of
    from plisse.transform.strip_solids import strip_solid

    found, model = _arrangement(path, wanted, creases, closed)
    units = "mm" if model is None else model.units
    if wanted.thickness is not None:
        for strip in found.strips:
            strip_solid(strip, wanted.thickness)
    design = Design(strips=wanted, units=units)  # type: ignore[arg-type]
    surface = None if model is None else surface_of(model.structure)
    result = Result(design, assess_strips(found, units), structure=found.structure, arrangement=found, surface=surface)
    return result, path.stem if model is None else model.title


def _arrangement(path: Path, wanted: Strips, creases: tuple[int, ...], closed: bool) -> tuple[Arrangement, Model | None]:
    from plisse.io.polylines import read_polyline
    from plisse.io.structures import read_model
    from plisse.transform.arrangement import Lane, arranged, strips_along_creases

    if path.suffix.lower() in CURVES:
        return arranged([Lane(read_polyline(path), closed=closed)], wanted.width, wanted.side), None
    model = read_model(path)
    chosen = [number - 1 for number in creases] or None
    return strips_along_creases(model.structure, wanted.width, side=wanted.side, creases=chosen), model


def _from_design(name: str, width: float | None, thickness: float | None, side: str | None) -> Result:
    """Strips along the guiding curves of a design."""
    from msgspec.structs import replace

    from plisse.errors import InvalidDesign
    from plisse.io.designs import read_design
    from plisse.pipeline import design
    from plisse.recipe import AsymptoticDesign
    from plisse.shipped import find_design

    recipe = read_design(find_design(name))
    if isinstance(recipe, AsymptoticDesign):
        raise InvalidDesign(f"{name} has pleats along asymptotic curves; make it, and give its structure.fold for strips "
                            "along its creases")
    if recipe.strips is None:
        return design(_with_strips(recipe, _wanted(width, thickness, side)))
    options = {"width": width, "thickness": thickness, "side": side}
    changes = {key: value for key, value in options.items() if value is not None}
    return design(replace(recipe, strips=replace(recipe.strips, **changes)))


def _with_strips(recipe: Design | SurfaceDesign, wanted: Strips) -> Design | SurfaceDesign:
    """The design with strips instead of pleats; over a surface inclination and spacing are those of the pattern."""
    from msgspec.structs import replace

    from plisse.recipe import SurfaceDesign, SurfacePattern

    if not isinstance(recipe, SurfaceDesign):
        return replace(recipe, strips=wanted, parallel=None)
    pattern = recipe.pattern
    wanted = replace(wanted, theta=pattern.theta, spacing=pattern.width)
    return replace(recipe, strips=wanted, pattern=SurfacePattern())

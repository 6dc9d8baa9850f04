"""`plisse parallel`: structures parallel to a structure, and folds replaced by three."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

if TYPE_CHECKING:
    from collections.abc import Callable

    from plisse.io.model import Model
    from plisse.recipe import Parallel
    from plisse.transform.variation import Member

__all__ = ["parallel"]


def parallel(
    structure: Path,
    /,
    *,
    lengths: str | None = None,
    widths: str | None = None,
    growth: float | None = None,
    move: Annotated[tuple[str, ...], Parameter(negative=())] = (),
    handles: Path | None = None,
    near: Path | None = None,
    least_scale: float = 0.05,
    refine_fold: Annotated[tuple[str, ...], Parameter(negative=())] = (),
    fraction: float = 1 / 3,
    at: float | None = None,
    rounds: int = 1,
    open_: Annotated[bool, Parameter(name="--open", negative=())] = False,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Change a structure so that all edges keep their directions: it stays exact, and principal if it is.

    A picture of the family side by side is written beside.

    Parameters
    ----------
    structure
        A .fold or .obj file with a folded structure.
    lengths
        Factors for the edges along the first crease: one, one per edge with commas, or a table 0:1,0.5:2,1:1 of
        positions and factors.
    widths
        Factors for the edges along the first zigzag of rulings, given in the same ways.
    growth
        Make a spiral that grows by this factor from one end of the creases to the other.
    move
        crease,point:dx,dy,dz moves a point (counted from 1), and the nearest parallel structure follows; may be repeated.
    handles
        A file of rows crease, point, x, y, z: where points shall go.
    near
        A .fold or .obj file with the same faces: the nearest parallel structure to its vertices.
    least_scale
        What is nearest has edges of at least this many times their length.
    refine_fold
        Number of a crease (from 1) to be replaced by three, or all; may be repeated.
    fraction
        Where new creases lie: this share of the strips' rulings away, where they are narrowest or at --at.
    at
        Percent of the crease's length where --fraction is measured.
    rounds
        How many times folds are replaced.
    open_
        Cut a closed structure open first.
    output
        A .fold or .obj file; the structure's name with -parallel.fold if left out.
    json
        Print the report as JSON instead of a summary.
    quiet
        Print nothing.
    """
    from plisse.cli.parallel_options import crease_numbers, parse_factors, parse_move, read_handles
    from plisse.cli.targets import refuse_source, structure_writer
    from plisse.io.designs import section_from_options
    from plisse.io.structures import read_model

    target = Path(f"{structure.stem}-parallel.fold") if output is None else output
    write = structure_writer(target)
    refuse_source(target, structure)
    _refuse_idle(refine_fold, rounds, fraction, at, least_scale, bool(move) or handles is not None or near is not None)
    moves = [parse_move(text) for text in move] + ([] if handles is None else read_handles(handles))
    recipe: Parallel = section_from_options("parallel", {
        "lengths": parse_factors(lengths, "--lengths"), "widths": parse_factors(widths, "--widths"), "growth": growth,
        "moves": moves or None, "least_scale": least_scale, "fraction": fraction, "at": at, "rounds": rounds,
        "refine": crease_numbers(refine_fold)})
    model = read_model(structure)
    family = _family(model, recipe, near, open_)
    return _finish(model, family, write, target, json, quiet)


def _refuse_idle(refine_fold: tuple[str, ...], rounds: int, fraction: float, at: float | None, least_scale: float,
                 nearest: bool) -> None:
    """Nothing; raises InvalidDesign for options without the one that they belong to."""
    from plisse.errors import InvalidDesign
    from plisse.recipe import Parallel

    usual = Parallel()
    given = {"--rounds": rounds != usual.rounds, "--fraction": fraction != usual.fraction, "--at": at is not None}
    if not refine_fold and any(given.values()):
        name = next(name for name, different in given.items() if different)
        raise InvalidDesign(f"{name} is for folds replaced by three; give --refine-fold too, or leave it out")
    if least_scale != usual.least_scale and not nearest:
        raise InvalidDesign("--least-scale is for nearest structures; give --move, --handles or --near too, or leave it out")


def _family(model: Model, recipe: Parallel, near: Path | None, open_: bool) -> tuple[Member, ...]:
    """The structure and what becomes of it."""
    from plisse.errors import InvalidDesign
    from plisse.io.structures import read_structure
    from plisse.solve.flatten import flatten
    from plisse.transform.parallel import cut_apart, parallel
    from plisse.transform.variation import Member, variations

    base = flatten(cut_apart(model.structure)) if open_ else model.structure
    if near is None:
        return variations(base, recipe)
    if not all(value is None for value in (recipe.lengths, recipe.widths, recipe.growth, recipe.moves)):
        raise InvalidDesign("--near is one way to a parallel structure, and another is given too; remove one")
    other = read_structure(near)
    if len(other.vertices) != len(base.vertices):
        raise InvalidDesign(f"{near.name} has {len(other.vertices)} vertices, but the structure has {len(base.vertices)}; "
                            "give a mesh with the same faces")
    found = parallel(base, positions=other.vertices, least_scale=recipe.least_scale)
    members = (Member("as given", base), Member(f"nearest to {near.stem}", found))
    return members if recipe.refine is None else members + variations(found, recipe)[1:]


def _finish(model: Model, family: tuple[Member, ...], write: Callable[..., None], target: Path, json: bool,
            quiet: bool) -> int:
    """Write the last of the family and the picture of all, and say how good it is."""
    from msgspec.structs import replace

    from plisse.assess import assess
    from plisse.cli.console import show_check
    from plisse.designs.varied import scales_between
    from plisse.draw.family import write_family
    from plisse.io.atomic import require_writable, written_together
    from plisse.io.report import report_json

    structure, picture = family[-1].structure, target.with_suffix(".png").name
    require_writable(target.parent, [target.name, picture])
    principal = assess(family[0].structure).principal
    report = replace(assess(structure, principal=principal, units=model.units),
                     edge_scales=scales_between(family[0].structure, family[1].structure))
    title = f"{model.title}, {family[-1].caption}"
    with written_together(target.parent) as stage:
        write(structure, stage / target.name, title=title, units=model.units)
        write_family(family, stage / picture, title=model.title)
    if json:
        print(report_json(report), end="")
    elif not quiet:
        show_check(report, title=str(target))
    return 0 if report.status == "exact" else 3

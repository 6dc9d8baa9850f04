"""`plisse report`: one page to show."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.io.model import Model

__all__ = ["report"]


def report(
    structure: Path,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Write one HTML page that shows and proves a structure: a turning view, the sheet, the numbers, the recipe.

    The page needs no network. A report.json beside the structure tells its recipe, history and warnings; without one the
    structure is measured anew. Where the file has no flat sheet and the structure lies flat, one is computed.

    Parameters
    ----------
    structure
        A .fold, .obj or .3dm file.
    output
        The page; report.html beside the structure if left out.
    quiet
        Print nothing.
    """
    from plisse.assess import assess, overlap_notes
    from plisse.designs.deviations import deviation_again
    from plisse.errors import PlisseError
    from plisse.io.atomic import require_writable, written
    from plisse.io.page import report_page
    from plisse.io.report import report_beside
    from plisse.io.structures import read_model

    target = structure.with_name("report.html") if output is None else output
    if target.suffix.lower() not in (".html", ".htm"):
        raise PlisseError(f"{target.name} is no page; give a name that ends in .html")
    model = read_model(structure)
    require_writable(target.parent, [target.name])
    topology = model.structure.topology
    found = report_beside(structure, topology.vertex_count, topology.face_count)
    model, notes = _with_sheet(model)
    deviation = None if found is None else deviation_again(model.structure, found)
    if found is None:
        from msgspec.structs import replace

        found = assess(model.structure, units=model.units)
        found = replace(found, warnings=[*overlap_notes(found), *notes])
    page = report_page(model.structure, found, title=model.title, deviation=deviation)
    with written(target) as aside:
        aside.write_text(page, encoding="utf-8", newline="\n")
    if not quiet:
        print(target)
    return 0


def _with_sheet(model: Model) -> tuple[Model, list[str]]:
    """The model with its flat sheet where it lies flat, else a sentence that says why it has none."""
    from plisse.errors import InvalidStructure
    from plisse.io.exports import developed

    if model.structure.development is not None:
        return model, []
    try:
        return developed(model), []
    except InvalidStructure as error:
        return model, [f"there is no flat sheet: {str(error).partition(';')[0]}"]

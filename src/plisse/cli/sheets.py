"""`plisse sheets`: the development as sheets to cut or to print."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.draw.smoothing import Smoother
    from plisse.fabricate import Sheets
    from plisse.io.model import Model

__all__ = ["material_size", "sheets"]

SMALL = 1.5
COARSEST = 0.1


def sheets(
    structure: Path,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"])],
    material: str | None = None,
    paper: str | None = None,
    scale: float | None = None,
    size: float | None = None,
    joint: Literal["tabs", "edges"] = "tabs",
    tab: float = 6.0,
    kerf: float = 0.0,
    margin: float = 5.0,
    spacing: float = 2.0,
    score: Literal["dashed", "perforated", "solid"] = "dashed",
    curves: Literal["polyline", "spline", "arc"] = "polyline",
    tolerance: float = 0.05,
    nest: Literal["quick", "dense"] = "quick",
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Cut the development into pieces that fit the material, nested on sheets, with numbers that say what joins what.

    Everything is at 1:1 in millimetres. Edges with the same number are joined; pieces never overlap.

    Parameters
    ----------
    structure
        A .fold file, or an .obj or .3dm file with a quad mesh.
    output
        A .pdf (a page per sheet), .dxf (sheets side by side), .svg (numbered, if there are several) or a directory.
    material
        Width x height of a sheet in mm, for example 600x300 (the default); the paper's size if only that is given.
    paper
        A4, A3 or Letter: larger sheets are tiled over several pages with registration marks.
    scale
        Paper per model: 0.5 makes it half as large.
    size
        Instead of a scale: the longest side of the folded structure in mm.
    joint
        Glue tabs beyond one of the two edges, or bare numbered edges.
    tab
        Depth of the tabs in mm.
    kerf
        Width of the cut in mm; outlines grow by half of it.
    margin
        Distance in mm from the edge of the sheet that stays free.
    spacing
        Distance in mm between pieces.
    score
        How folds are drawn: mountains dash-dotted and valleys dashed, perforated, or drawn through.
    curves
        What curves are made of.
    tolerance
        How far splines and arcs may lie from the exact line, in mm.
    nest
        Quick, or dense: tries for half a minute to save a sheet.
    quiet
        Print nothing.
    """
    from plisse.draw.pages import fits_page, printed_pages
    from plisse.draw.sheets import legend_of, sheet_drawings
    from plisse.draw.smoothing import Smoother
    from plisse.draw.strokes import MACHINE, PRINT
    from plisse.errors import PlisseError
    from plisse.fabricate import sheets as cut_up
    from plisse.fabricate.tiling import paper_size
    from plisse.io.exports import developed
    from plisse.io.sheets import require_place, write_sheets
    from plisse.io.structures import read_model

    if not tolerance > 0:
        raise PlisseError(f"--tolerance {tolerance:g} leaves no room for a curve; give a number of mm above 0")
    page = None if paper is None else paper_size(paper)
    sheet = material_size(material) if material is not None else page or (600.0, 300.0)
    require_place(output)
    model = developed(read_model(structure))
    plan = cut_up(model.structure, material=sheet, units=model.units, scale=_scale(model, scale, size), kerf=kerf,
                  joint=joint, tab=tab, margin=margin, spacing=spacing, nesting=nest)
    if curves != "polyline":
        _require_fine(tolerance, plan)
    printed = page is not None or output.suffix.lower() == ".pdf"
    smoother = Smoother(curves, tolerance)
    drawings = sheet_drawings(plan, title=model.title, score=score, smoother=smoother, strokes=PRINT if printed else MACHINE,
                              captioned=page is None or fits_page(sheet, page))
    small = sum(0 < text.height < SMALL for drawing in drawings for text in drawing.layer("text").texts)
    if page is not None:
        drawings = printed_pages(drawings, page, legend_of(drawings, score))
    files = write_sheets(drawings, output)
    if not quiet:
        _show(plan, smoother, files, len(drawings) if page else 0, small)
    return 0


def material_size(material: str) -> tuple[float, float]:
    """Width and height in mm from words such as 600x300; raises PlisseError for others."""
    from plisse.errors import PlisseError

    parts = material.lower().replace("×", "x").split("x")
    try:
        width, height = (float(part) for part in parts)
    except ValueError:
        raise PlisseError(f"--material {material!r} is no size; give width x height in mm, for example 600x300") from None
    return width, height


def _require_fine(tolerance: float, plan: Sheets) -> None:
    """Nothing; raises PlisseError for a tolerance of more than a tenth of the width of strips."""
    import numpy as np

    from plisse.errors import PlisseError

    edges = plan.paper.topology.edges
    most = COARSEST * float(np.median(plan.paper.edge_lengths[~edges.is_crease]))
    if tolerance > 1.06 * most:  # the sentence rounds to two digits
        raise PlisseError(f"--tolerance {tolerance:g} is more than a tenth of the width of strips; give up to {most:.2g} mm")


def _scale(model: Model, scale: float | None, size: float | None) -> float:
    """Paper per model from one of the two options."""
    import numpy as np

    from plisse.errors import PlisseError
    from plisse.recipe import MILLIMETRES

    if scale is not None and size is not None:
        raise PlisseError("--scale and --size say the same thing twice; give one of them")
    if size is None:
        return 1.0 if scale is None else scale
    if not size > 0:
        raise PlisseError(f"--size {size:g} is no length; give the longest side of the folded structure in mm")
    return size / (float(np.ptp(model.structure.vertices, axis=0).max()) * MILLIMETRES[model.units])


def _show(plan: Sheets, smoother: Smoother, files: list[Path], pages: int, small: int) -> None:
    print(f"{_counted(len(plan.pieces), 'piece')} on {_counted(plan.count, 'sheet')} of {plan.material[0]:g} × "
          f"{plan.material[1]:g} mm, {100 * plan.use:.0f} % used" + (f"; {_counted(pages, 'page')}" if pages else ""))
    if plan.joints:
        print(f"{_counted(len(plan.joints), 'joint')}, {_counted(plan.edge_count, 'numbered edge')}: "
              "join edges of the same number")
    if smoother.kind != "polyline":
        print(f"{smoother.kind}s deviate by {smoother.deviation:.3f} mm at most")
    if smoother.kept:
        print(f"· {_counted(smoother.kept, 'line')} of straight edges: no {smoother.kind} follows within "
              f"{smoother.tolerance:g} mm; raise --tolerance, or pattern.samples of the design")
    if small:
        print(f"· {_counted(small, 'number')} less than {SMALL:g} mm high, because there is no room for more; "
              "a larger scale or fewer samples help")
    for note in plan.notes:
        print(f"· {note}")
    for file in files:
        print(file)


def _counted(number: int, thing: str) -> str:
    return f"{number} {thing}" + ("" if number == 1 else "s")

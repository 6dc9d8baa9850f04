"""`plisse layout`: ways to pleat a surface, as a table and a picture, and the best one as a design to edit."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.geometry.graph import GraphSurface
    from plisse.geometry.parametric import ParametricSurface
    from plisse.recipe import SurfaceDesign
    from plisse.solve.whole_surface import Candidate, WholeSurface

__all__ = ["FILES", "design_text", "layout"]

FILES = ("candidates.png", "layout.toml")


def layout(
    file: str,
    /,
    *,
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    count: int = 20,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Lay out pleats over a surface: all candidates in a table and a picture, the best one as a design to edit.

    Parameters
    ----------
    file
        A mesh (.obj, .ply, .stl, .off, .glb), or a design with a surface section.
    output
        Directory for candidates.png and layout.toml; the file's name with -layout if left out.
    count
        How many layouts to try first; the best are then solved again in other ways, and listed as well. The search ends
        earlier where one covers everything.
    quiet
        Print nothing.
    """
    from plisse.cli.console import progress
    from plisse.designs.reconstruction import laid_out_over, reference_surface
    from plisse.draw.candidates import write_candidates
    from plisse.errors import PlisseError
    from plisse.geometry.graph import GraphSurface
    from plisse.geometry.parametric import ParametricSurface
    from plisse.io.atomic import require_writable, written_together

    if count < 1:
        raise PlisseError(f"--count {count} leaves nothing to try; give a number from 1")
    recipe = _recipe(file)
    directory = Path(f"{Path(file).stem}-layout") if output is None else output
    if (directory / "layout.toml").exists():
        raise PlisseError(f"{directory / 'layout.toml'} exists already; remove it or choose another directory with -o")
    require_writable(directory)
    mesh, surface = reference_surface(recipe.surface)
    if recipe.surface.is_guided or not isinstance(surface, GraphSurface | ParametricSurface):
        raise PlisseError(f"{file} has a guide or a point from which creases start, so layouts are not searched for; run "
                          "plisse make")
    with progress(quiet) as advance:
        found = laid_out_over(recipe, mesh, surface, count, advance)
    chosen = found.candidates.index(found.best)
    with written_together(directory, owned=FILES) as stage:
        write_candidates(found.candidates, chosen, mesh, surface, stage / "candidates.png", title=Path(file).name)
        text = design_text(recipe, found.best, surface, directory)
        (stage / "layout.toml").write_text(text, encoding="utf-8", newline="\n")
    if not quiet:
        _show(found, chosen, directory)
    return 0 if found.best.solved.is_sound else 3


def design_text(recipe: SurfaceDesign, candidate: Candidate, surface: GraphSurface | ParametricSurface,
                directory: Path) -> str:
    """The design of one candidate as TOML, with the mesh file as seen from `directory`."""
    from plisse.solve.candidate import centre_of

    section, pattern, sizes = recipe.surface, recipe.pattern, candidate.layout.sizes
    lines = [f"# {candidate.layout.label}: {100 * candidate.coverage:.1f} % covered, mean deviation "
             f"{candidate.mean_deviation:.2f} amplitudes", f"units = {json.dumps(recipe.units)}", "", "[surface]"]
    if section.file is not None:
        lines.append(f"file = {_quoted(_relative(Path(section.file), directory))}")
    elif section.radius is not None:
        lines += [f"radius = {_quoted(section.radius)}", f"x = {list(section.x)}"]
    else:
        lines += [f"height = {_quoted(section.height or '')}", f"x = {list(section.x)}", f"y = {list(section.y)}"]
    centre = section.centre if section.centre is not None else centre_of(candidate, surface)
    if centre is not None:
        lines.append(f"centre = {[float(value) for value in centre]}  # rows run around this point")
    lines.append(f"overhang = {'true' if section.overhang else 'false'}  # false prefers upright pleats, open by 15 degrees")
    lines += [f"side = \"{section.side}\""] if section.side != "below" else []
    lines += ["boundary = true"] if section.boundary else []
    if candidate.seams or section.seams is not None:
        lines.append(f"seams = {len(candidate.seams)}  # along which the sheet is cut apart")
    lines += ["", "[pattern]"]
    if centre is not None:
        lines += [f"width = {float(sizes.width)}  # of a strip", f"amplitude = {float(sizes.amplitude)}  # off the surface"]
    else:
        # sizes belong to the search: what was asked for leads to the same layout again
        lines += [f"{name} = {value}" for name in ("width", "amplitude") if (value := getattr(pattern, name)) is not None]
        lines.append(f"# this layout has width {sizes.width:.4g} and amplitude {sizes.amplitude:.4g}")
    lines.append(f"theta = {0.0 if pattern.theta is None else float(pattern.theta)}  # preferred inclination in degrees")
    return "\n".join(lines) + "\n"


def _recipe(file: str) -> SurfaceDesign:
    from plisse.errors import InvalidDesign
    from plisse.io.designs import read_design
    from plisse.recipe import Surface, SurfaceDesign
    from plisse.shipped import find_design, shipped_names

    if Path(file).suffix.lower() != ".toml" and file not in shipped_names():
        return SurfaceDesign(surface=Surface(file=file))
    recipe = read_design(find_design(file))
    if not isinstance(recipe, SurfaceDesign):
        raise InvalidDesign(f"{file} has no surface section that leaves a choice, so there is nothing to lay out; give a "
                            "mesh or such a design")
    return recipe


def _relative(file: Path, directory: Path) -> str:
    import os

    return Path(os.path.relpath(file, directory)).as_posix()


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _show(found: WholeSurface, chosen: int, directory: Path) -> None:
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=None, pad_edge=False, padding=(0, 1, 0, 0), header_style="dim")
    for name in ("", "layout", "status", "covered", "deviation", "sector", "opening", "θ"):
        table.add_column(name, justify="left" if name in ("layout", "status") else "right")
    for k, candidate in enumerate(found.candidates):
        style = "bold" if k == chosen else ""
        table.add_row(*(Text(part, style=style) for part in (str(k + 1), *_row(candidate))))
    console = Console(highlight=False)
    console.print(table)
    console.print(Text("deviation: mean, in amplitudes; sector and opening: smallest, in degrees", style="dim"))
    for note in found.notes:
        console.print(Text(f"· {note}"))
    console.print(Text(f"number {chosen + 1} is in {directory / 'layout.toml'}, all are in {directory / 'candidates.png'}"))


def _row(candidate: Candidate) -> tuple[str, ...]:
    import numpy as np

    low, high = np.degrees(_inclinations(candidate))
    status = "exact" if candidate.solved.is_sound else "irregular" if candidate.solved.is_exact else "not exact"
    sector, opening = np.degrees([candidate.least_sector, candidate.least_opening])
    apart = f", {len(candidate.seams)} seams" if candidate.seams else ""
    return (candidate.layout.label.removeprefix("rows ") + apart, status, f"{100 * candidate.coverage:.1f} %",
            f"{candidate.mean_deviation:.2f}", f"{sector:.0f}°", f"{opening:.0f}°", f"{low:.0f}° to {high:.0f}°")


def _inclinations(candidate: Candidate) -> tuple[float, float]:
    """Smallest and largest inclination as folded, in radians."""
    from plisse.measure.inclination import crease_inclinations

    part, net = candidate.solved.grid, candidate.layout.net
    normals, outward = (field.reshape(-1, 3)[part.used] for field in (net.normals, net.outward))
    found = crease_inclinations(part.topology, candidate.solved.vertices, normals, outward)
    return float(found.min()), float(found.max())

"""`plisse render`: a picture of a structure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.draw.colour_maps import ColourMap
    from plisse.structure.pleated import PleatedStructure

__all__ = ["parse_size", "render"]

SMALLEST, LARGEST, FRAMES, MOST_FRAMES = 64, 8000, 36, 360


def render(
    structure: Path,
    /,
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"])],
    view: str = "best",
    size: str | None = None,
    colour: Literal["paper", "planarity", "angle", "principal", "opening", "deviation"] = "paper",
    creases: bool = True,
    transparent: Annotated[bool, Parameter(negative=())] = False,
    ambient: bool | None = None,
    frames: int | None = None,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Draw a structure like photographed paper, or in the colours of a quality, as .png or as a turning .gif.

    Parameters
    ----------
    structure
        A .fold, .obj or .3dm file. A report.json beside it tells the surface or pattern for --colour deviation.
    output
        A .png file, or a .gif file for one turn around the z axis.
    view
        best (shows most of the folds), iso, top, front, side, or azimuth,elevation in degrees. A gif takes the elevation.
    size
        Width and height in pixels; 1600x1200 if left out, 720x540 for a gif.
    colour
        Paper, or a quality with its scale.
    creases
        Draw mountains red and valleys blue.
    transparent
        Leave the ground out (.png).
    ambient
        Cast rays for soft light in the folds and on the ground; done where plisse[render] is installed.
    frames
        Pictures in one turn of a .gif; 36 if left out.
    quiet
        Print nothing.
    """
    from plisse.draw.picture import Style, write_picture, write_turntable
    from plisse.draw.views import view_of
    from plisse.errors import InvalidDesign, PlisseError
    from plisse.io.atomic import require_writable, written
    from plisse.io.structures import read_structure

    turning = output.suffix.lower() == ".gif"
    if not turning and output.suffix.lower() != ".png":
        raise PlisseError(f"{output.name} is no picture that plisse draws; give a .png, or a .gif that turns")
    if turning and transparent:
        raise InvalidDesign("a .gif has no soft transparency; leave --transparent out or give a .png")
    if not turning and frames is not None:
        raise InvalidDesign("--frames is for a .gif that turns; leave it out or give a .gif")
    frames = FRAMES if frames is None else frames
    if not 2 <= frames <= MOST_FRAMES:
        raise InvalidDesign(f"--frames {frames} is outside 2 to {MOST_FRAMES}")
    pixels = parse_size(size or ("720x540" if turning else "1600x1200"))
    if ambient:
        from plisse.extras import optional

        optional("embreex", extra="render", purpose="pictures with cast rays")
    shown = read_structure(structure)
    camera = view_of(shown, view)
    require_writable(output.parent, [output.name])
    style = Style(pixels, creases, _colour_map(structure, shown, colour), transparent, ambient is not False)
    with written(output) as aside:
        if turning:
            write_turntable(shown, aside, elevation=camera.elevation_degrees, frames=frames, style=style)
        else:
            write_picture(shown, aside, camera=camera, style=style)
    if not quiet:
        print(output)
    return 0


def parse_size(text: str) -> tuple[int, int]:
    """Width and height from "1600x1200"; raises InvalidDesign for anything else."""
    from plisse.errors import InvalidDesign

    try:
        width, height = (int(part) for part in text.lower().replace("×", "x").split("x"))
        if not (SMALLEST <= width <= LARGEST and SMALLEST <= height <= LARGEST):
            raise ValueError
    except ValueError:
        raise InvalidDesign(f"--size {text} is not a width and a height in pixels from {SMALLEST} to {LARGEST}, for example "
                            "1600x1200") from None
    return width, height


def _colour_map(file: Path, structure: PleatedStructure, name: str) -> ColourMap | None:
    from plisse.designs.deviations import deviation_again
    from plisse.draw.colour_maps import colour_maps
    from plisse.errors import InvalidDesign
    from plisse.io.report import report_beside

    if name == "paper":
        return None
    deviation = None
    if name == "deviation":
        report = report_beside(file, structure.topology.vertex_count, structure.topology.face_count)
        deviation = None if report is None else deviation_again(structure, report)
    maps = colour_maps(structure, deviation)
    if name in maps:
        return maps[name]
    if name == "opening":
        raise InvalidDesign(f"{file.name} has no fold between two faces, so there is no opening angle to colour")
    raise InvalidDesign(f"nothing says what {file.name} should be near to; --colour deviation needs the report.json that "
                        "plisse make wrote beside it, for a design with a pattern or a surface")

"""`plisse flex`: the motion of a principal structure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

if TYPE_CHECKING:
    from plisse.transform.flex import Motion

__all__ = ["flex", "parse_percent"]

KINDS = (".fold", ".glb", ".gif", ".png")
MOST_STATES = 2000


def flex(
    structure: Path,
    /,
    *,
    percent: str = "0:100:30",
    output: Annotated[Path | None, Parameter(name=["--output", "-o"])] = None,
    picture: bool = True,
    json: Annotated[bool, Parameter(negative=())] = False,
    quiet: Annotated[bool, Parameter(negative=())] = False,
) -> int:
    """Fold and unfold a principal structure: exact states between the flat sheet and the flat-folded one.

    0 percent is flat, 100 the structure as it is, 200 folded flat; every tan(fold/2) is multiplied by
    tan(percent · 0.45°).

    Parameters
    ----------
    structure
        A .fold or .obj file with a folded principal structure.
    percent
        start:stop:count, a list with commas, or one number, between 0 and 200.
    output
        motion.fold, motion.glb (plays in any viewer), motion.gif, motion.png (the picture only), or a directory for one
        OBJ per state; the structure's name with -motion.fold if left out.
    picture
        Write a picture of five states beside.
    json
        Print what was found as JSON instead of a summary.
    quiet
        Print nothing.
    """
    from plisse.cli.targets import refuse_source
    from plisse.errors import PlisseError
    from plisse.io.structures import read_model

    states = parse_percent(percent)
    target = Path(f"{structure.stem}-motion.fold") if output is None else output
    if target.suffix and target.suffix.lower() not in KINDS and not target.is_dir():
        raise PlisseError(f"{target.name} ends in {target.suffix}, which motions are not written as; give "
                          f"{', '.join(KINDS)} or a directory")
    refuse_source(target, structure)
    model = read_model(structure)
    motion = model.structure.flex(states)
    files = _write(motion, target, model.title, model.units, picture)
    _show(motion, target, files, json, quiet)
    return 0


def parse_percent(text: str) -> list[float]:
    """Numbers from start:stop:count, a list with commas, or one number; raises InvalidDesign for anything else."""
    from plisse.errors import InvalidDesign

    parts = text.split(":")
    try:
        if len(parts) == 1:
            return [float(part) for part in text.split(",")]
        start, stop, count = float(parts[0]), float(parts[1]), int(parts[2])
        if len(parts) > 3 or not 2 <= count <= MOST_STATES:
            raise ValueError
    except (ValueError, IndexError):
        raise InvalidDesign(f"--percent {text} is not of the form start:stop:count (2 to {MOST_STATES} states), a list with "
                            "commas or one number, for example 0:100:30") from None
    return [start + (stop - start) * k / (count - 1) for k in range(count)]


def _write(motion: Motion, target: Path, title: str, units: str, picture: bool) -> list[str]:
    """Names of the files written, all together or none, into the target's directory or the target itself."""
    from plisse.draw.animation import write_gif
    from plisse.draw.motion import write_motion_strip
    from plisse.io.atomic import require_writable, written_together
    from plisse.io.glb import write_motion_glb
    from plisse.io.motion import frame_names, write_motion_fold, write_motion_objs

    kind = "" if target.is_dir() else target.suffix.lower()
    directory = target.parent if kind else target
    strip = target.with_suffix(".png").name if kind else "motion.png"
    names = list(dict.fromkeys([*([target.name] if kind else frame_names(motion)), *([strip] if picture else [])]))
    require_writable(directory, names)
    former = [] if kind else [file.name for file in target.glob("[0-9][0-9][0-9]*.obj")]
    with written_together(directory, owned=former) as stage:
        if kind == ".fold":
            write_motion_fold(motion, stage / target.name, title=title, units=units)
        elif kind == ".glb":
            write_motion_glb(motion, stage / target.name, title=title, units=units)
        elif kind == ".gif":
            write_gif(motion, stage / target.name)
        elif not kind:
            write_motion_objs(motion, stage, title=title, units=units)
        if strip in names:
            write_motion_strip(motion, stage / strip, title=title)
    return names


def _show(motion: Motion, target: Path, files: list[str], json: bool, quiet: bool) -> None:
    import json as encoder

    free = motion.free_range
    if json:
        print(encoder.dumps({"percent": motion.percent.tolist(), "free_percent": [free.low, free.high],
                             "collisions": list(free.collisions), "cut": motion.cut_place, "files": files}, indent=1))
        return
    if quiet:
        return
    from rich.console import Console

    console = Console(highlight=False)
    low, high = motion.percent.min(), motion.percent.max()
    console.print(f"{target}  {len(motion.percent)} states, {low:.4g} to {high:.4g} %", soft_wrap=True)
    console.print(f"free of collisions from {free.low:.4g} to {free.high:.4g} %", soft_wrap=True)
    notes = list(free.collisions)
    struck = sum(value not in free for value in motion.percent.tolist())
    if struck:
        notes.append(f"{struck} of the {len(motion.percent)} states lie outside the free range")
    if motion.cut_place:
        notes.append(f"the structure is closed, so it was cut open {motion.cut_place}")
    for note in notes:
        console.print(f"· {note}", soft_wrap=True)

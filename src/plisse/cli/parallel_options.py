"""What the options of `plisse parallel` say."""

from __future__ import annotations

from pathlib import Path

__all__ = ["crease_numbers", "parse_factors", "parse_move", "read_handles"]


def parse_factors(text: str | None, option: str) -> float | list | None:
    """One factor, a list, or a table of [position, factor] rows; raises InvalidDesign for anything else."""
    from plisse.errors import InvalidDesign

    if text is None:
        return None
    try:
        if ":" in text:
            return [[float(part) for part in row.split(":", 1)] for row in text.split(",")]
        values = [float(part) for part in text.split(",")]
    except ValueError:
        raise InvalidDesign(f"{option} {text} is neither a factor, nor factors with commas, nor a table like "
                            "0:1,0.5:2,1:1") from None
    return values[0] if len(values) == 1 else values


def parse_move(text: str) -> dict:
    """Crease, point and displacement of crease,point:dx,dy,dz; raises InvalidDesign for anything else."""
    from plisse.errors import InvalidDesign

    place, colon, by = text.partition(":")
    try:
        crease, point = (int(part) for part in place.split(","))
        x, y, z = (float(part) for part in by.split(","))
    except ValueError:
        colon = ""
    if not colon:
        raise InvalidDesign(f"--move {text} is not of the form crease,point:dx,dy,dz, for example 5,1:20,0,15")
    return {"crease": crease, "point": point, "by": [x, y, z]}


def read_handles(path: Path) -> list[dict]:
    """Moves to places from a file with rows crease, point, x, y, z; raises InvalidDesign for files that have none."""
    from plisse.errors import InvalidDesign

    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, UnicodeDecodeError):
        raise InvalidDesign(f"{path} cannot be read as text; give a file with rows crease, point, x, y, z") from None
    out = []
    for number, line in enumerate(lines, 1):
        try:
            crease, point, x, y, z = line.replace(";", ",").split(",")
            out.append({"crease": int(crease), "point": int(point), "to": [float(x), float(y), float(z)]})
        except ValueError:
            if number > 1 and line.strip():  # the first may be a header
                raise InvalidDesign(f"row {number} of {path.name} is not crease, point, x, y, z") from None
    if not out:
        raise InvalidDesign(f"{path.name} has no rows crease, point, x, y, z")
    return out


def crease_numbers(texts: tuple[str, ...]) -> list[int] | str | None:
    """Numbers of creases, or all; None for none. Raises InvalidDesign for words."""
    from plisse.errors import InvalidDesign

    if "all" in texts:
        return "all"
    try:
        return [int(text) for text in texts] or None
    except ValueError:
        raise InvalidDesign(f"--refine-fold {texts[-1]} is neither the number of a crease nor all") from None

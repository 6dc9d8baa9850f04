"""The best designs of a study by a criterion, and their files."""

import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from plisse.errors import InvalidDesign
from plisse.study.store import Row

__all__ = ["CRITERIA", "best", "write_best"]

OURS = re.compile(r"\d{2,}-[0-9a-f]{16}\.(toml|png)")


def _opening(numbers: dict) -> float | None:
    if numbers["min_opening_deg"] is None:
        return None
    return -min(numbers["min_opening_deg"], 180 - numbers["max_opening_deg"])


def _sheet_area(numbers: dict) -> float | None:
    return None if numbers["sheet_width_mm"] is None else numbers["sheet_width_mm"] * numbers["sheet_height_mm"]


def _regularity(numbers: dict) -> float | None:
    return None if numbers["min_sector_angle_deg"] is None else -numbers["min_sector_angle_deg"]


# smaller is better: the largest smallest angle, the smallest deviation, folds furthest from shut and from flat, least paper
CRITERIA: dict[str, Callable[[dict], float | None]] = {
    "regularity": _regularity, "deviation": lambda numbers: numbers["max_deviation"], "opening": _opening,
    "sheet_area": _sheet_area}


def best(rows: Iterable[Row], by: str, count: int | None = None) -> list[Row]:
    """Exact designs by a criterion, the best first; those to which it does not apply are left out.

    Raises InvalidDesign for a criterion that is not known.
    """
    if by not in CRITERIA:
        raise InvalidDesign(f"{by} is no criterion; those are {', '.join(CRITERIA)}")
    ranked = [(score, row) for row in rows if row.status == "exact" and (score := CRITERIA[by](row.numbers)) is not None]
    return [row for _, row in sorted(ranked, key=lambda pair: pair[0])][:count]


def write_best(rows: Sequence[Row], directory: Path, *, progress: Callable[[str, float], None] | None = None) -> list[Path]:
    """Paths of TOML files of designs, each beside a PNG of it made anew; those of an earlier choice are replaced.

    Other files in the directory stay as they are. Raises PlisseError where a file cannot be written.
    """
    from plisse.draw.preview import write_preview
    from plisse.io.atomic import require_writable, written_together
    from plisse.io.toml import write_toml
    from plisse.pipeline import design

    names = [f"{number:02}-{row.key}" for number, row in enumerate(rows, 1)]
    require_writable(directory, [f"{name}{suffix}" for name in names for suffix in (".toml", ".png")])
    found = directory.iterdir() if directory.is_dir() else ()
    earlier = [path.name for path in found if OURS.fullmatch(path.name) and path.is_file()]
    with written_together(directory, owned=earlier) as stage:
        for k, (name, row) in enumerate(zip(names, rows, strict=True)):
            if progress:
                progress(f"design {k + 1} of {len(rows)}", k / len(rows))
            write_toml(row.recipe, stage / f"{name}.toml", comment=described(row))
            result = design(row.recipe)
            if result.structure is not None:
                write_preview(result, stage / f"{name}.png", title=described(row))
    return [directory / f"{name}.toml" for name in names]


def described(row: Row) -> str:
    """The varied values of a design in one line: "theta = 30, width = 5"."""
    return ", ".join(f"{key.rpartition('.')[2]} = {_short(value)}" for key, value in row.parameters.items())


def _short(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float):
        return f"{value:.4g}"
    return str(value.get("kind", "…")) if isinstance(value, dict) else str(value)[:24]

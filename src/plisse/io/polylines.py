"""Polylines from .csv, .txt, .npy and .obj files."""

from pathlib import Path

import numpy as np

from plisse.errors import InvalidDesign

__all__ = ["read_polyline"]

READERS = ".csv, .txt, .npy or .obj"


def read_polyline(path: str | Path, least: int = 3) -> np.ndarray:
    """Points (N, 3) of the polyline in a file; a closed OBJ polyline does not repeat its first point.

    Raises InvalidDesign when the file is missing, of another type, or does not hold `least` rows of three numbers.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in (".csv", ".txt", ".npy", ".obj"):
        raise InvalidDesign(f"{path.name} is not a polyline file; give {READERS}")
    try:
        found = path.is_file()
    except OSError:
        found = False
    if not found:
        raise InvalidDesign(f"there is no curve file {str(path)[:200]}; give a path relative to the design")
    try:
        points = {".npy": _read_npy, ".obj": _read_obj}.get(suffix, _read_rows)(path)
    except (OSError, ValueError, UnicodeDecodeError, IndexError) as error:
        raise InvalidDesign(f"{path.name} does not hold a polyline ({error}); give rows of three numbers") from None
    if points.ndim != 2 or points.shape[1] != 3 or len(points) < least:
        raise InvalidDesign(f"{path.name} holds an array of shape {points.shape}; give at least {least} rows of x, y, z")
    if not np.isfinite(points).all():
        raise InvalidDesign(f"point {int(np.argmin(np.isfinite(points).all(axis=1))) + 1} of {path.name} is not finite")
    return points.astype(float)


def _read_npy(path: Path) -> np.ndarray:
    try:
        array = np.load(path, allow_pickle=False)
    except ValueError:
        raise ValueError("it is no array of numbers") from None
    if not isinstance(array, np.ndarray) or array.dtype.kind not in "fiu":
        raise ValueError("its numbers are not real")
    return array.astype(float)


def _read_rows(path: Path) -> np.ndarray:
    """Rows of numbers separated by commas, semicolons or blanks; a header line of words is skipped."""
    rows: list[list[float]] = []
    for number, line in enumerate(path.read_text(encoding="utf-8-sig").splitlines(), 1):
        fields = line.replace(",", " ").replace(";", " ").split("#")[0].split()
        if not fields:
            continue
        try:
            row = [float(field) for field in fields]
        except ValueError:
            row = []
            if rows:
                raise ValueError(f"line {number} is {line.strip()[:40]!r}") from None
        if not np.isfinite(row).all():
            raise ValueError(f"line {number} is {line.strip()[:40]!r}, which is not finite")
        rows += [row] if row else []
    if len({len(row) for row in rows}) > 1:
        raise ValueError("its rows have different lengths")
    return np.array(rows, dtype=float)


def _read_obj(path: Path) -> np.ndarray:
    """The longest `l` polyline of an OBJ file, or all its vertices in order where it has none."""
    vertices: list[list[float]] = []
    lines: list[list[int]] = []
    for line in path.read_text(encoding="utf-8", errors="strict").splitlines():
        fields = line.split()
        if fields[:1] == ["v"]:
            vertices.append([float(x) for x in fields[1:4]])
        elif fields[:1] == ["l"]:
            indices = [int(field.split("/")[0]) for field in fields[1:]]
            lines.append([i - 1 if i > 0 else len(vertices) + i for i in indices])
    points = np.array(vertices, dtype=float)
    if not lines:
        return points
    longest = max(lines, key=len)
    if longest[0] == longest[-1]:
        longest = longest[:-1]
    return points[longest]

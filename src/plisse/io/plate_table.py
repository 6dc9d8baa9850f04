"""plates.csv and plates.json: what to cut, number by number."""

import csv
import json
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from plisse.io.atomic import written
from plisse.transform.hinged_range import HingedRange
from plisse.transform.plates import Plates

__all__ = ["plates_document", "write_plates_csv", "write_plates_json"]

DIGITS = 9
COLUMNS = ("plate", "strip", "position", "edge", "kind", "neighbour", "x", "y", "x_upper", "y_upper", "length",
           "length_upper", "fold_deg", "bevel_deg")


def plates_document(plates: Plates, movement: HingedRange | None = None, *, units: str = "mm", title: str = "") -> dict:
    """What plates.json says: summary, limits, and every plate with its outlines; lengths in model units, angles in degrees.

    Plates, strips and positions are numbered from 1; a neighbour is null on the boundary.
    """
    cut, limit = plates.cut, plates.largest_thickness
    document: dict[str, Any] = {
        "title": title, "units": units, "plates": plates.count, "thickness": cut.thickness, "gap": cut.gap, "side": cut.side,
        "hinged": cut.hinged, "largest_thickness": limit if np.isfinite(limit) else None, "largest_gap": cut.largest_gap,
        "total_area": float(plates.areas.sum()), "total_volume": float(plates.volumes.sum()),
        "smallest_width": float(plates.widths.min()), "warnings": list(plates.warnings),
    }
    if movement is not None:
        document["free_range_percent"] = [movement.low, movement.high]
        document["free_range_of_faces_percent"] = [movement.faces.low, movement.faces.high]
        document["largest_thickness_for_range_of_faces"] = movement.thickness_for_faces
        document["reasons"] = list(movement.reasons)
    return document | {"table": _entries(plates)}


def write_plates_json(document: dict, path: str | Path) -> None:
    """Write a document of `plates_document`, one line per plate; raises PlisseError where it cannot be written."""
    head = {key: value for key, value in document.items() if key != "table"}
    rows = ",\n  ".join(json.dumps(entry) for entry in document["table"])
    text = json.dumps(head, indent=1, ensure_ascii=False)[:-2] + f',\n "table": [\n  {rows}\n ]\n}}\n'
    with written(path) as aside:
        aside.write_text(text, encoding="utf-8", newline="\n")


def write_plates_csv(plates: Plates, path: str | Path) -> None:
    """Write one row per edge of every plate, beginning at the corner (x, y); raises PlisseError where that fails."""
    corners, lower, upper = plates.structure.topology.corners, *plates.flat
    following = plates.cut.outlines.following
    lengths = [np.hypot(*(outline[following] - outline).T) for outline in (lower, upper)]
    edge = np.arange(len(corners.face)) - np.searchsorted(corners.face, corners.face) + 1
    columns = (corners.face + 1, plates.strips[corners.face] + 1, _positions(plates)[corners.face] + 1, edge, _kinds(plates),
               np.where(plates.neighbours < 0, "", (plates.neighbours + 1).astype(str)),
               *_rounded(*lower.T, *upper.T, *lengths, np.degrees(plates.cut.outlines.fold), np.degrees(plates.bevels)))
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows(zip(*(column.tolist() for column in columns), strict=True))
    with written(path) as aside:
        aside.write_text(text.getvalue(), encoding="utf-8", newline="\n")


def _entries(plates: Plates) -> list[dict]:
    face = plates.structure.topology.corners.face
    cuts = np.flatnonzero(np.diff(face)) + 1
    neighbours = np.where(plates.neighbours < 0, -1, plates.neighbours + 1)
    angles = np.degrees(plates.cut.outlines.fold), np.degrees(plates.bevels)
    per_corner = [np.split(column, cuts) for column in (*_rounded(*plates.flat, *angles), _kinds(plates), neighbours)]
    per_plate = zip(plates.strips + 1, _positions(plates) + 1, *_rounded(plates.areas, plates.volumes, plates.widths),
                    *per_corner, strict=True)
    names = ("strip", "position", "area", "volume", "width", "lower", "upper", "fold_deg", "bevel_deg", "kind", "neighbour")
    entries = [{"plate": number} | {name: value.tolist() for name, value in zip(names, values, strict=True)}
               for number, values in enumerate(per_plate, 1)]
    for entry in entries:
        entry["neighbour"] = [None if number < 0 else number for number in entry["neighbour"]]
    return entries


def _kinds(plates: Plates) -> np.ndarray:
    corners = plates.structure.topology.corners
    return np.where(plates.neighbours < 0, "boundary", np.where(corners.next_is_crease, "crease", "ruling"))


def _positions(plates: Plates) -> np.ndarray:
    """Place (F,) of every plate in its strip, from 0, in the order of the faces."""
    order = np.argsort(plates.strips, kind="stable")
    strips = plates.strips[order]
    positions = np.empty(plates.count, np.int64)
    positions[order] = np.arange(plates.count) - np.searchsorted(strips, strips)
    return positions


def _rounded(*columns: np.ndarray) -> list[np.ndarray]:
    return [np.round(column, DIGITS) + 0.0 for column in columns]

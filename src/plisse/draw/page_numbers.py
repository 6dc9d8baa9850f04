"""The numbers of a report in words: value, limit, and what it means."""

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from plisse.measure.regularity import MIN_SECTOR, OPENING_RANGE
from plisse.measure.verdict import EXACT, FAR
from plisse.result import Report, Sheet

__all__ = ["Entry", "entries", "summary"]

LIMIT = f"{EXACT:.0e}".replace("e-0", "e-")


class Entry(NamedTuple):
    """One line of the table: `shown` as text, `values` as they stand in report.json."""

    name: str
    shown: str
    values: tuple[float, ...]
    limit: str
    meaning: str


def summary(report: Report) -> str:
    """One sentence for people who have never heard of the paper."""
    return {"exact": "Every face is flat and every vertex lies flat to the last digit: this shape folds "
                     f"{_material(report.development)}.",
            "approximate": "This shape is close to one that folds from a sheet, but not exactly.",
            "infeasible": "This shape cannot be folded as it is."}[report.status]


def entries(report: Report) -> list[Entry]:
    """All measures that the report has."""
    faces = Entry("faces", f"{report.faces:,}", (report.faces,), "", f"flat pieces over {report.vertices:,} vertices")
    return [faces, *_defects(report), *_angles(report), *_deviations(report), *_faults(report), *_sheet(report)]


def _material(sheet: Sheet | None) -> str:
    if sheet is None:
        return "exactly"
    if sheet.overlaps:
        return "exactly, from a sheet cut apart where it overlaps itself"
    return f"from {sheet.pieces} pieces of sheet" if sheet.pieces > 1 else "from one sheet"


def _defects(report: Report) -> Iterator[Entry]:
    wanted = report.principal or report.design.get("solve", {}).get("principal", False)
    for name, found, limit, meaning in (
            ("planarity", report.planarity, LIMIT, "how far a face is from flat: the distance of its diagonals over their "
             "length; below 1e-3 no paper shows it"),
            ("angle sum", report.angle_defect, LIMIT, "by how much the angles around a vertex miss 360°, in radians; 0 "
             "means that the sheet lies flat there without tearing or wrinkling"),
            ("principal defect", report.principal_defect, LIMIT if wanted else "", "0 means that opposite angles around "
             "every vertex add up to 180°: folds have constant angles, and the structure moves and folds flat"
             + ("" if wanted else "; a shape that stays as it is need not"))):
        if found is not None:
            yield Entry(name, f"{found.max:.1e}, mean {found.mean:.1e}", (found.max, found.mean), limit, meaning)


def _angles(report: Report) -> Iterator[Entry]:
    if report.min_sector_angle_deg is not None:
        yield Entry("smallest angle", f"{report.min_sector_angle_deg:.1f}°", (report.min_sector_angle_deg,),
                    f"{np.degrees(MIN_SECTOR):.0f}° or more", "of all corners of faces; below it faces are slivers")
    if report.opening_angle_deg is not None:
        found, (low, high) = report.opening_angle_deg, np.degrees(OPENING_RANGE)
        yield Entry("opening angles", f"{found.min:.1f}° to {found.max:.1f}°", (found.min, found.max),
                    f"{low:.0f}° to {high:.0f}°", "of the creases: 180° is flat paper, 0° folded shut")


def _deviations(report: Report) -> Iterator[Entry]:
    astray, off = report.crease_deviation, report.deviation
    if astray is not None:
        yield Entry("off the pattern", f"{astray.max:.2f}, mean {astray.mean:.2f}", (astray.max, astray.mean), f"{FAR:g}",
                    "distance of creases from the curves that guide them, in amplitudes (half the height of a fold)")
    if off is not None:
        yield Entry("off the surface", f"{off.max_amplitudes:.2f}, mean {off.mean_amplitudes:.2f}",
                    (off.max_amplitudes, off.mean_amplitudes), "", "distance of the middle of the pleats from the reference "
                    f"surface, in amplitudes; the mean is {100 * off.mean_relative:.2g} % of its diagonal")
    if report.coverage is not None:
        yield Entry("coverage", f"{100 * report.coverage:.1f} %", (report.coverage,), "",
                    "of the area of the reference surface lies under the structure")


def _faults(report: Report) -> Iterator[Entry]:
    for name, count, meaning in (
            ("faces folded over", report.inverted_faces, "faces whose corners run the wrong way round"),
            ("self-intersections", report.self_intersections, "pairs of faces that cut through each other")):
        if count is not None:
            yield Entry(name, str(count), (count,), "0", meaning)


def _sheet(report: Report) -> Iterator[Entry]:
    if report.isometry is not None:
        yield Entry("sheet against fold", f"{report.isometry:.1e}", (report.isometry,), LIMIT,
                    "largest difference of lengths on the flat sheet and in the folded shape, in mean edges")
    sheet = report.development
    if sheet is not None:
        pieces = f", in {sheet.pieces} pieces" if sheet.pieces > 1 else ""
        overlap = "; it overlaps itself, so it must be cut apart" if sheet.overlaps else ""
        yield Entry("sheet", f"{sheet.size_mm[0]:.1f} × {sheet.size_mm[1]:.1f} mm", sheet.size_mm, "",
                    f"paper needed for the flat state at 1:1{pieces}{overlap}")

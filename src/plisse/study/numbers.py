"""The numbers that a study keeps of every design: columns of its store and of its table."""

from plisse.result import Report

__all__ = ["NUMBERS", "numbers"]

NUMBERS = {
    "vertices": "vertices",
    "faces": "faces",
    "planarity": "planarity.max",
    "angle_defect": "angle_defect.max",
    "principal_defect": "principal_defect.max",
    "min_sector_angle_deg": "min_sector_angle_deg",
    "min_opening_deg": "opening_angle_deg.min",
    "max_opening_deg": "opening_angle_deg.max",
    "max_deviation": "crease_deviation.max",
    "mean_deviation": "crease_deviation.mean",
    "inverted_faces": "inverted_faces",
    "self_intersections": "self_intersections",
    "coverage": "coverage",
    "sheet_width_mm": "development.size_mm.0",
    "sheet_height_mm": "development.size_mm.1",
    "sheet_overlaps": "development.overlaps",
    "iterations": "iterations",
    "solve_seconds": "seconds.solve",
    "method": "method",
}
ON_SURFACES = {"max_deviation": "deviation.max_amplitudes", "mean_deviation": "deviation.mean_amplitudes"}


def numbers(report: Report) -> dict[str, float | str | None]:
    """The columns of one design, None for what does not apply.

    Deviations are in amplitudes: from the reference surface where there is one, else from the guiding curves.
    """
    places = NUMBERS | (ON_SURFACES if report.deviation is not None else {})
    return {name: _at(report, place) for name, place in places.items()}


def _at(value, place: str) -> float | str | None:
    """What stands under a dotted place of structs, dictionaries and tuples."""
    for name in place.split("."):
        if value is None:
            return None
        if isinstance(value, tuple):
            value = value[int(name)]
        else:
            value = value.get(name) if isinstance(value, dict) else getattr(value, name)
    return value

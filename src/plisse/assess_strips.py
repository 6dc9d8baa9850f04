"""From an arrangement of strips to its report: straight, planar and isometric, or not, and at what angle they stand."""

import numpy as np

from plisse.geometry.vectors import norm
from plisse.measure.isometry import isometry_defect
from plisse.measure.planarity import planarity_defect
from plisse.measure.verdict import EXACT
from plisse.recipe import MILLIMETRES
from plisse.result import Interval, Report, Sheet, Spread, StripEntry
from plisse.transform.arrangement import Arrangement
from plisse.transform.strips import RectifyingStrip

__all__ = ["assess_strips"]


def assess_strips(arrangement: Arrangement, units: str = "mm") -> Report:
    """Report on rectifying strips; `angle_defect` is by how much unfolded curves turn, `strips` the cutting list.

    Status is exact where planarity, straightness and isometry are within 1e-9 and no strip
    was left out or lost more than half of its length. Reasons and warnings name strips.
    """
    structure = arrangement.structure
    topology, flat = structure.topology, structure.development
    assert flat is not None
    planarity = planarity_defect(topology, structure.vertices)
    turns = np.abs(np.concatenate([strip.straightness_defect for strip in arrangement.strips]))
    isometry = float(isometry_defect(topology, structure.vertices, flat))
    reasons = [f"{what} by {value:.1e} (limit {EXACT:.0e})" for what, value in (
        ("faces of strips are not planar", float(planarity.max())), ("curves do not unfold straight: they turn",
                                                                     float(turns.max())),
        ("flat strips differ from those in space", isometry)) if not value <= EXACT]
    reasons += arrangement.lost
    width, height = (MILLIMETRES[units] * np.ptp(flat, axis=0)).tolist()
    return Report(
        status="approximate" if reasons else "exact", reasons=reasons, vertices=topology.vertex_count,
        faces=topology.face_count, planarity=_spread(planarity), angle_defect=_spread(turns), isometry=isometry,
        strips=[_entry(*entry) for entry in zip(arrangement.numbers, arrangement.strips, arrangement.inclinations,
                                                strict=True)],
        inclination_deg=[_degrees(part) for part in arrangement.inclinations if part is not None] or None,
        warnings=list(arrangement.notes), development=Sheet(False, (width, height), None, len(arrangement.strips)),
        units=units, method="rectifying strips")


def _entry(number: int, strip: RectifyingStrip, inclination: np.ndarray | None) -> StripEntry:
    flat = strip.structure.development
    assert flat is not None
    return StripEntry(
        strip=number, length=float(np.ptp(flat[:, 0])), width=strip.width, curve_length=strip.length,
        faces=len(strip.normals), inclination_deg=None if inclination is None else _degrees(inclination),
        shortest_ruling=float(norm(strip.row(strip.high) - strip.row(strip.low)).min()), notes=list(strip.notes))


def _degrees(angles: np.ndarray) -> Interval:
    return Interval(float(np.degrees(angles.min())), float(np.degrees(angles.max())))


def _spread(values: np.ndarray) -> Spread:
    return Spread(float(values.max()), float(values.mean()))

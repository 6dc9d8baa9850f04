"""What `plisse check` finds out about a structure, with the reasons for its verdict."""

from math import degrees
from pathlib import Path

import msgspec

from plisse.assess import spread
from plisse.errors import InvalidStructure
from plisse.io.fold import read_fold
from plisse.io.obj import read_obj
from plisse.measure.intersection import intersecting_faces
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import MIN_SECTOR, OPENING_RANGE, regularity
from plisse.measure.sectors import angle_defect, principal_defect
from plisse.measure.verdict import EXACT
from plisse.result import Interval, Spread
from plisse.structure.pleated import PleatedStructure

__all__ = ["Findings", "findings", "findings_json", "read_structure"]


class Findings(msgspec.Struct, frozen=True, kw_only=True):
    """Numbers named as in report.json; `principal` is whether the structure folds flat with one freedom."""

    status: str
    reasons: list[str]
    principal: bool
    vertices: int
    faces: int
    planarity: Spread
    angle_defect: Spread
    principal_defect: Spread
    min_sector_angle_deg: float
    opening_angle_deg: Interval
    inverted_faces: int
    self_intersections: int


def read_structure(path: str | Path) -> PleatedStructure:
    """The structure in a .fold or .obj file; raises InvalidStructure for other files and meshes."""
    path = Path(path)
    readers = {".fold": read_fold, ".json": read_fold, ".obj": read_obj}
    if path.suffix.lower() not in readers:
        raise InvalidStructure(f"{path.name} is neither a .fold nor an .obj file; give one of these")
    return readers[path.suffix.lower()](path)


def findings(structure: PleatedStructure) -> Findings:
    """All measures of a structure and the verdict: exact, or approximate for the reasons given."""
    topology, vertices = structure.topology, structure.vertices
    interior = ~topology.is_boundary
    quality = regularity(topology, vertices)
    conical = spread(principal_defect(topology, vertices)[interior])
    found = Findings(
        status="exact", reasons=[], vertices=topology.vertex_count, faces=topology.face_count,
        planarity=spread(planarity_defect(topology, vertices)),
        angle_defect=spread(angle_defect(topology, vertices)[interior]),
        principal_defect=conical, principal=bool(interior.any()) and conical.max <= EXACT,
        min_sector_angle_deg=degrees(quality.min_sector),
        opening_angle_deg=Interval(degrees(quality.min_opening), degrees(quality.max_opening)),
        inverted_faces=quality.inverted, self_intersections=len(intersecting_faces(topology, vertices)))
    reasons = _reasons(found)
    return msgspec.structs.replace(found, reasons=reasons, status="approximate" if reasons else "exact")


def findings_json(found: Findings) -> str:
    """The findings as indented JSON."""
    return msgspec.json.format(msgspec.json.encode(found), indent=2).decode() + "\n"


def _reasons(found: Findings) -> list[str]:
    """One sentence for everything that keeps a structure from being exact and regular."""
    planarity, angle, sector = found.planarity.max, found.angle_defect.max, found.min_sector_angle_deg
    low, high = map(degrees, OPENING_RANGE)
    opening = found.opening_angle_deg
    sentences = {
        f"faces are not planar: the defect reaches {planarity:.1e} (exact: {EXACT:g})": planarity <= EXACT,
        f"the sheet does not lie flat: angle sums miss 360° by up to {angle:.1e} radians": angle <= EXACT,
        f"faces are slivers: the smallest angle is {sector:.1f}°": sector >= degrees(MIN_SECTOR),
        f"creases are folded shut: the smallest opening angle is {opening.min:.1f}°": opening.min > low,
        f"creases hardly fold: the largest opening angle is {opening.max:.1f}°": opening.max < high,
        f"faces are folded over: {found.inverted_faces} of them are not convex": found.inverted_faces == 0,
        f"the shape cuts through itself in {found.self_intersections} places": found.self_intersections == 0,
    }
    return [sentence for sentence, holds in sentences.items() if not holds]

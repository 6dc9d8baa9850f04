"""What `plisse check` finds out about a structure, with the reasons for its verdict."""

from pathlib import Path

import msgspec
import numpy as np

from plisse.errors import InvalidStructure
from plisse.geometry.vectors import dot
from plisse.io.fold import read_fold
from plisse.io.obj import read_obj
from plisse.measure.folds import crease_opening_angles
from plisse.measure.planarity import face_normals, planarity_defect
from plisse.measure.sectors import angle_defect, principal_defect, sector_angles
from plisse.result import Interval, Spread
from plisse.structure.pleated import PleatedStructure

__all__ = ["Findings", "findings", "findings_json", "read_structure"]

EXACT, LEAST_SECTOR, LEAST_OPENING, MOST_OPENING = 1e-9, 5.0, 2.0, 178.0


class Findings(msgspec.Struct, frozen=True, kw_only=True):
    """Numbers named as in report.json; `principal` is whether the creases would fold flat (conical, 1-DOF)."""

    status: str
    reasons: list[str]
    principal: bool
    vertices: int
    faces: int
    planarity: Spread
    angle_defect: Spread
    principal_defect: Spread
    min_sector_angle_deg: float
    opening_angle_deg: Interval | None
    inverted_faces: int


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
    opening = np.degrees(crease_opening_angles(topology, vertices))
    conical = _spread(principal_defect(topology, vertices)[interior])
    found = Findings(
        status="exact", reasons=[], vertices=topology.vertex_count, faces=topology.face_count,
        planarity=_spread(planarity_defect(topology, vertices)),
        angle_defect=_spread(angle_defect(topology, vertices)[interior]),
        principal_defect=conical, principal=bool(interior.any()) and conical.max <= EXACT,
        min_sector_angle_deg=float(np.degrees(sector_angles(topology, vertices)).min()),
        opening_angle_deg=Interval(float(opening.min()), float(opening.max())) if len(opening) else None,
        inverted_faces=_inverted(structure))
    reasons = _reasons(found)
    return msgspec.structs.replace(found, reasons=reasons, status="approximate" if reasons else "exact")


def findings_json(found: Findings) -> str:
    """The findings as indented JSON."""
    return msgspec.json.format(msgspec.json.encode(found), indent=2).decode() + "\n"


def _reasons(found: Findings) -> list[str]:
    """One sentence for everything that keeps a structure from being exact and regular."""
    reasons = []
    planarity, angle, sector = found.planarity.max, found.angle_defect.max, found.min_sector_angle_deg
    if not planarity <= EXACT:
        reasons.append(f"faces are not planar: the defect reaches {planarity:.1e}, {EXACT:g} counts as exact")
    if not angle <= EXACT:
        reasons.append(f"the sheet does not lie flat: angles around a vertex miss 360° by {angle:.1e} radians")
    if not sector >= LEAST_SECTOR:
        reasons.append(f"faces are slivers: the smallest angle is {sector:.1f}°")
    opening = found.opening_angle_deg
    if opening is not None and not opening.min >= LEAST_OPENING:
        reasons.append(f"creases are folded shut: the smallest opening angle is {opening.min:.1f}°")
    if opening is not None and not opening.max <= MOST_OPENING:
        reasons.append(f"creases hardly fold: the largest opening angle is {opening.max:.1f}°")
    if found.inverted_faces:
        reasons.append(f"faces are folded over: {found.inverted_faces} of them are not convex")
    return reasons


def _inverted(structure: PleatedStructure) -> int:
    """Number of faces with a corner that turns the wrong way."""
    topology, vertices = structure.topology, structure.vertices
    corners, normals = topology.corners, face_normals(topology, vertices)
    origin = vertices[corners.vertex]
    turn = np.cross(vertices[corners.next] - origin, vertices[corners.previous] - origin)
    wrong = dot(turn, normals[corners.face]) <= 0
    return len(np.unique(corners.face[wrong]))


def _spread(values: np.ndarray) -> Spread:
    if len(values) == 0:
        return Spread(0.0, 0.0)
    return Spread(float(np.abs(values).max()), float(np.abs(values).mean()))

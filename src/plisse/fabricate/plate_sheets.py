"""Outlines of plates in rows on sheets of material: many small parts, in little time (§2.4, Fig. 9)."""

from dataclasses import dataclass

import numpy as np

from plisse.errors import Infeasible
from plisse.fabricate.fitting import angle_that_fits
from plisse.fabricate.nesting import Bed
from plisse.fabricate.pieces import Placement
from plisse.fabricate.plan import FOOTER, require_lengths
from plisse.recipe import MILLIMETRES
from plisse.transform.plates import Plates

__all__ = ["PlateSheets", "plate_sheets", "rows"]


@dataclass(frozen=True, eq=False)
class PlateSheets:
    """Outlines (N, 2) in mm of all plates, the part of each that its bevels leave whole, and where they lie.

    `outlines` are what is cut, grown by half the kerf: the hull of the upper and lower outline, which bevels cut back.
    `upper` is the outline on the side that faces are oriented to. Plate k has number k + 1.
    """

    outlines: tuple[np.ndarray, ...]
    upper: tuple[np.ndarray, ...]
    placements: tuple[Placement, ...]
    material: tuple[float, float]
    margin: float

    @property
    def count(self) -> int:
        """Number of sheets."""
        return 1 + max(placement.sheet for placement in self.placements)


def plate_sheets(plates: Plates, *, material: tuple[float, float] = (600.0, 300.0), units: str = "mm", kerf: float = 0.0,
                 margin: float = 5.0, spacing: float = 2.0) -> PlateSheets:
    """All plates laid out on sheets of `material` (width, height) mm, `spacing` mm apart, tallest rows first.

    Raises PlisseError for lengths without sense, Infeasible where a plate does not fit between the margins or the kerf
    is wider than a plate.
    """
    from shapely import MultiPoint, get_coordinates

    require_lengths(material, kerf=kerf, margin=margin, spacing=spacing)
    room = material[0] - 2 * margin, material[1] - 2 * margin - FOOTER
    if min(room) <= 0:
        raise Infeasible(f"material of {material[0]:g} × {material[1]:g} mm has no room inside margins of {margin:g} mm "
                         f"(and {FOOTER:g} mm for the number of the sheet); take larger material")
    slim = int(np.argmin(plates.widths))
    if kerf >= plates.widths[slim] * MILLIMETRES[units]:
        raise Infeasible(f"a kerf of {kerf:g} mm is wider than plate {slim + 1}; give the width of the cut")
    lower, upper = (outline * MILLIMETRES[units] for outline in plates.flat)
    face = plates.structure.topology.corners.face
    cuts = np.flatnonzero(np.diff(face)) + 1
    parts = [np.split(outline, cuts) for outline in (lower, upper)]
    hulls = [MultiPoint(np.concatenate(pair)).convex_hull.buffer(kerf / 2, join_style="mitre")
             for pair in zip(*parts, strict=True)]
    outlines = tuple(get_coordinates(hull.exterior)[:-1] for hull in hulls)
    bed = Bed((margin, margin + FOOTER), *room, spacing)
    return PlateSheets(outlines, tuple(parts[1]), tuple(rows(outlines, bed)), material, margin)


def rows(outlines: tuple[np.ndarray, ...], bed: Bed) -> list[Placement]:
    """Placements of convex outlines (N, 2), each on its flattest side, in rows from below, the tallest row first.

    Raises Infeasible where an outline does not fit the bed.
    """
    angles = [angle_that_fits(outline, bed.width, bed.height) for outline in outlines]
    if None in angles:
        raise Infeasible(f"plate {angles.index(None) + 1} does not fit {bed.width:.1f} × {bed.height:.1f} mm inside the "
                         "margins; take larger material")
    turned = [Placement(0, angle or 0.0, (0.0, 0.0)).apply(outline)
              for angle, outline in zip(angles, outlines, strict=True)]
    sizes = np.array([np.ptp(points, axis=0) for points in turned])
    placements: dict[int, Placement] = {}
    sheet, left, bottom, tall = 0, 0.0, 0.0, 0.0
    for k in np.lexsort((np.arange(len(sizes)), -sizes[:, 1])).tolist():
        width, height = sizes[k]
        if left + width > bed.width + 1e-9:
            left, bottom, tall = 0.0, bottom + tall + bed.spacing, 0.0
        if bottom + height > bed.height + 1e-9:
            sheet, left, bottom, tall = sheet + 1, 0.0, 0.0, 0.0
        shift = np.add(bed.corner, (left, bottom)) - turned[k].min(axis=0)
        placements[k] = Placement(sheet, angles[k] or 0.0, (float(shift[0]), float(shift[1])))
        left, tall = left + width + bed.spacing, max(tall, height)
    return [placements[k] for k in range(len(outlines))]

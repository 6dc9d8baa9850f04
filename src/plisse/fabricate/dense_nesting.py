"""Sheets saved by strip packing (spyrrow): pieces of the last sheet squeezed onto earlier ones."""

from dataclasses import replace

import numpy as np

from plisse.extras import optional
from plisse.fabricate.fitting import angle_that_fits, extents
from plisse.fabricate.nesting import Bed
from plisse.fabricate.pieces import Placement

__all__ = ["tightened"]

TURNS = 24
SECONDS, ATTEMPTS = 3, 8
FULLEST = 0.9
TOLERANCE = 1e-3


def tightened(outlines: list, placements: list[Placement], bed: Bed) -> list[Placement]:
    """Placements on as many sheets or fewer; takes about three seconds for each of at most eight attempts.

    Raises MissingExtra without spyrrow.
    """
    optional("spyrrow", extra="nest", purpose="dense layouts")
    placements, attempts = list(placements), 0
    while True:
        last = max(placement.sheet for placement in placements)
        moving = [k for k, placement in enumerate(placements) if placement.sheet == last]
        trial = list(placements)
        for k in sorted(moving, key=lambda k: -outlines[k].area):
            for sheet in range(last):
                together = [*(m for m, placement in enumerate(trial) if placement.sheet == sheet), k]
                if sum(outlines[m].area for m in together) > FULLEST * bed.width * bed.height or attempts == ATTEMPTS:
                    continue
                attempts += 1
                found = _packed([outlines[m] for m in together], bed)
                if found is not None:
                    for m, placement in zip(together, found, strict=True):
                        trial[m] = replace(placement, sheet=sheet)
                    break
            else:
                return placements
        placements = trial


def _packed(outlines: list, bed: Bed) -> list[Placement] | None:
    """Placements of the outlines on one sheet, or None where the packing found is longer than the sheet."""
    import spyrrow
    from shapely import Polygon, get_coordinates, transform

    items, grown = [], bed.spacing / 2
    for k, outline in enumerate(outlines):
        shape = Polygon(outline.exterior).simplify(grown / 20).buffer(grown * 1.05, quad_segs=2)
        best = angle_that_fits(get_coordinates(shape), bed.width + bed.spacing, (bed.height + bed.spacing) * (1 - 1e-4))
        if best is None:
            return None
        angles = best + np.linspace(0, 2 * np.pi, TURNS, endpoint=False)
        fitting = angles[extents(get_coordinates(shape), angles)[:, 1] < (bed.height + bed.spacing) * (1 - 1e-4)]
        corners = [tuple(point) for point in get_coordinates(shape).tolist()]
        items.append(spyrrow.Item(str(k), corners, 1, np.degrees(fitting).tolist()))
    strip = spyrrow.StripPackingInstance("sheet", bed.height + bed.spacing, items)
    found = strip.solve(spyrrow.StripPackingConfig(total_computation_time=SECONDS, num_workers=1, seed=0))
    if found.width > bed.width + bed.spacing:
        return None
    corner = np.array(bed.corner) - grown
    out = {int(item.id): Placement(0, float(np.radians(item.rotation)), tuple((corner + item.translation).tolist()))
           for item in found.placed_items}
    placed = [transform(outline, out[k].apply) for k, outline in enumerate(outlines)]
    return [out[k] for k in range(len(outlines))] if _is_sound(placed, bed) else None


def _is_sound(placed: list, bed: Bed) -> bool:
    """Whether the outlines lie on the bed and apart from each other: the packer counts in single precision."""
    from shapely import box

    x, y = bed.corner
    room = box(x, y, x + bed.width, y + bed.height).buffer(TOLERANCE, join_style="mitre")
    return all(room.contains(outline) for outline in placed) and all(
        one.distance(other) >= bed.spacing - TOLERANCE for k, one in enumerate(placed) for other in placed[:k])

"""Pieces on beds: inside, apart, on few sheets."""

import numpy as np
import pytest
import shapely

from plisse.errors import Infeasible
from plisse.fabricate.dense_nesting import tightened
from plisse.fabricate.fitting import angle_that_fits, extents
from plisse.fabricate.nesting import Bed, nest
from plisse.fabricate.pieces import Placement


def arch(radius, width, angle=np.pi):
    turn = np.linspace(0, angle, 60)
    rim = np.stack([np.cos(turn), np.sin(turn)], axis=1)
    return shapely.Polygon(np.concatenate([radius * rim, (radius - width) * rim[::-1]]))


def require_apart(outlines, placements, bed, tolerance=1e-9):
    x, y = bed.corner
    room = shapely.box(x, y, x + bed.width, y + bed.height).buffer(tolerance, join_style="mitre")
    placed = [shapely.transform(outline, placement.apply) for outline, placement in zip(outlines, placements, strict=True)]
    for k, one in enumerate(placed):
        assert room.contains(one)
        assert one.area == pytest.approx(outlines[k].area, rel=1e-9)
        for other in range(k):
            if placements[other].sheet == placements[k].sheet:
                assert one.distance(placed[other]) >= bed.spacing - tolerance


def test_random_shapes_lie_inside_and_apart():
    rng = np.random.default_rng(5)
    outlines = [shapely.MultiPoint(rng.uniform(0, rng.uniform(10, 60), (8, 2))).convex_hull for _ in range(25)]
    bed = Bed((3.0, 4.0), 150.0, 100.0, 1.5)
    placements = nest(outlines, bed)
    require_apart(outlines, placements, bed)
    sheets = 1 + max(placement.sheet for placement in placements)
    assert sheets <= np.ceil(sum(outline.area for outline in outlines) / (0.5 * 150 * 100))


def test_arches_lie_inside_one_another():
    outlines = [arch(50, 8), arch(38, 8), arch(26, 8)]
    bed = Bed((0.0, 0.0), 102.0, 52.0, 2.0)
    placements = nest(outlines, bed)
    require_apart(outlines, placements, bed)
    assert {placement.sheet for placement in placements} == {0}


def test_a_long_piece_is_laid_along_the_diagonal():
    stick = shapely.box(0, 0, 115, 2)
    bed = Bed((0.0, 0.0), 100.0, 70.0, 1.0)
    require_apart([stick], nest([stick], bed), bed)
    angle = angle_that_fits(shapely.get_coordinates(stick), 100, 70)
    assert (extents(shapely.get_coordinates(stick), np.array([angle]))[0] <= [100, 70]).all()


def test_what_fits_no_bed_is_refused():
    with pytest.raises(Infeasible, match="piece 1"):
        nest([shapely.box(0, 0, 130, 2)], Bed((0.0, 0.0), 100.0, 70.0, 1.0))


def test_strip_packing_saves_a_sheet_or_leaves_everything_as_it_was(monkeypatch):
    monkeypatch.setattr("plisse.fabricate.dense_nesting.SECONDS", 1)
    outlines = [arch(40, 10), arch(40, 10), shapely.box(0, 0, 38, 10)]
    bed = Bed((5.0, 5.0), 100.0, 60.0, 1.0)
    spread = [Placement(0, 0.0, (45.0, 5.0)), Placement(1, 0.0, (45.0, 5.0)), Placement(1, 0.0, (26.0, 6.0))]
    require_apart(outlines, spread, bed)
    tight = tightened(outlines, spread, bed)
    require_apart(outlines, tight, bed, tolerance=1e-3)  # the packer counts in single precision
    assert max(one.sheet for one in tight) == 0
    assert tightened(outlines[:1], spread[:1], bed) == spread[:1]

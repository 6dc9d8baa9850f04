"""Numbers beside the edges they name, clear of every line and of each other."""

import numpy as np
import pytest
import shapely

from plisse.fabricate.folds import flap_lines, fold_lines, tick_marks
from plisse.fabricate.labels import labels_on
from plisse.fabricate.scores import PATTERNS, dash_spans


def written(plan, piece, placement):
    points = placement.apply(plan.paper.points)
    lines = [points[fold.vertices] for fold in fold_lines(plan.paper, piece) + flap_lines(plan.paper, piece, plan.joints)]
    ticks = placement.apply(tick_marks(plan.paper, piece).reshape(-1, 2)).reshape(-1, 2, 2)
    return labels_on(plan.paper, piece, placement, plan.joints, [*lines, *ticks]), [*lines, *ticks], points


@pytest.mark.parametrize("figure", ["fig19", "fig27"])
def test_every_numbered_edge_has_its_label_close_by_on_both_pieces(plans, figure):
    plan, sides = plans[figure], {}
    for piece, placement in zip(plan.pieces, plan.placements, strict=True):
        labels, _, points = written(plan, piece, placement)
        place = {label.words: shapely.Polygon(label.corners) for label in labels}
        assert sum(label.kind == "piece" for label in labels) == 1
        for joint in plan.joints:
            for side in (0, 1):
                if joint.pieces[side] == piece.number - 1:
                    for name, path in zip(joint.labels, joint.edges(side), strict=True):
                        middle = shapely.Point(points[path].mean(axis=0))
                        nearest = min(place, key=lambda words: place[words].distance(middle))
                        assert nearest == name
                        sides[name] = sides.get(name, 0) + 1
    assert sides and set(sides.values()) == {2}


@pytest.mark.parametrize("figure", ["fig19", "fig27"])
def test_labels_touch_neither_lines_nor_each_other_and_stand_upright(plans, figure):
    plan = plans[figure]
    for piece, placement in zip(plan.pieces, plan.placements, strict=True):
        labels, lines, _ = written(plan, piece, placement)
        boxes = [shapely.Polygon(label.corners) for label in labels]
        drawn = shapely.union_all([shapely.LineString(line) for line in lines])
        inside = shapely.transform(plan.paper.polygon(piece.faces), placement.apply)
        for k, box in enumerate(boxes):
            assert inside.contains(box) and not box.intersects(drawn)
            assert not any(box.intersects(other) for other in boxes[:k])
        assert all(-np.radians(75) < label.angle <= np.radians(105) + 1e-12 for label in labels)


def test_ticks_start_on_the_rim_and_run_along_rulings_into_the_piece(plans):
    plan = plans["fig27"]
    for piece in plan.pieces:
        polygon = plan.paper.polygon(piece.faces)
        ticks = tick_marks(plan.paper, piece)
        assert len(ticks) > 20
        assert polygon.exterior.distance(shapely.points(ticks[:, 0])).max() < 1e-9
        assert all(polygon.buffer(1e-9).contains(shapely.LineString(tick)) for tick in ticks)
        rulings = shapely.MultiLineString([plan.paper.points[line.vertices] for line in plan.paper.topology.rulings])
        assert shapely.distance(rulings, shapely.points(ticks[:, 1])).max() < 1e-9


@pytest.mark.parametrize("length", [0.3, 7.0, 123.4])
@pytest.mark.parametrize("score", PATTERNS)
def test_dashes_begin_and_end_with_the_line_in_an_unbroken_rhythm(length, score):
    for pattern in PATTERNS[score].values():
        spans = dash_spans(length, pattern)
        assert spans[0, 0] == 0 and spans[-1, 1] == pytest.approx(length, rel=1e-12)
        assert (spans[:, 1] > spans[:, 0]).all() and (spans[1:, 0] > spans[:-1, 1]).all()
        if len(spans) > 4:
            assert (spans[0, 1] - spans[0, 0]) == pytest.approx(pattern[0], rel=0.35)


def test_mountains_and_valleys_differ_in_their_rhythm():
    for score in ("dashed", "perforated"):
        mountain, valley = (np.diff(dash_spans(50.0, PATTERNS[score][letter]), axis=1) for letter in "MV")
        assert np.ptp(mountain) > 1.0 and np.ptp(valley) < 1e-9

"""Plates in rows."""

import numpy as np
import pytest
import shapely

from plisse.draw.plate_sheets import plate_drawings
from plisse.errors import Infeasible, PlisseError
from plisse.fabricate.plate_sheets import plate_sheets


@pytest.fixture
def made(cones):
    return cones.plates(1.0)


def test_plates_lie_inside_and_apart_and_keep_their_areas(made):
    plan = plate_sheets(made, material=(150.0, 100.0))
    assert plan.count > 1 and len(plan.placements) == made.count
    room = shapely.box(5, 14, 145, 95).buffer(1e-9, join_style="mitre")
    for number in range(plan.count):
        placed = [shapely.Polygon(placement.apply(outline)) for outline, placement in
                  zip(plan.outlines, plan.placements, strict=True) if placement.sheet == number]
        assert placed and all(room.contains(plate) for plate in placed)
        assert all(one.distance(other) >= 2 - 1e-9 for k, one in enumerate(placed) for other in placed[:k])
    areas = np.array([shapely.Polygon(outline).area for outline in plan.upper])
    a, b, c, d = (made.upper[made.corners[:, k]] for k in range(4))
    assert areas == pytest.approx(0.5 * np.linalg.norm(np.cross(c - a, d - b), axis=1), rel=1e-9)
    cut = np.array([shapely.Polygon(outline).area for outline in plan.outlines])
    assert (cut >= made.areas * (1 - 1e-12)).all()


def test_drawings_number_every_plate_inside_its_outline(made):
    drawings = plate_drawings(plate_sheets(made, material=(150.0, 100.0), kerf=0.1), title="cones")
    numbers = []
    for drawing in drawings:
        plates = [shapely.Polygon(line.points) for line in drawing.layer("bevel").lines]
        for text in drawing.layer("text").texts[:len(plates)]:
            numbers.append(int(text.words))
            assert sum(plate.contains(shapely.Point(text.at)) for plate in plates) == 1
    assert sorted(numbers) == list(range(1, made.count + 1))


def test_a_plate_larger_than_the_material_is_named(made):
    with pytest.raises(Infeasible, match="plate 1 does not fit"):
        plate_sheets(made, material=(22.0, 24.0))


@pytest.mark.parametrize(("options", "words"), [({"kerf": 50.0}, "wider than plate"), ({"kerf": -1.0}, "kerf is -1"),
                                                ({"material": (0.0, 10.0)}, "material width is 0")])
def test_numbers_without_sense_are_refused(made, options, words):
    with pytest.raises(PlisseError, match=words):
        plate_sheets(made, **options)

"""Options of a surface section that contradict each other are answered in one sentence that names them."""

import pytest

from plisse.errors import InvalidDesign
from plisse.io.designs import design_from_dict

BASE = {"height": "0.1*x*y", "x": [-1, 1], "y": [-1, 1]}
GUIDE = {"guide": [[0, 0, 0], [1, 0, 0]]}
SIZES = {"theta": 50, "width": 0.2, "amplitude": 0.1}
POINT = {"point": [0, 0, 0]}
PULL = [{"point": [0, 0, 0], "displacement": [0, 0, 1], "radius": 1}]


@pytest.mark.parametrize(("surface", "pattern", "solve", "expected"), [
    (GUIDE, {}, {}, "pattern.theta is missing"),
    ({"guide_boundary": 1}, {"theta": 50}, {}, "pattern.width is missing; a layout along surface.guide_boundary"),
    (POINT, SIZES, {}, "pattern.creases is missing"),
    ({**POINT, **GUIDE}, SIZES, {}, "surface.guide and surface.point are both given"),
    ({"guide_section": {"point": [0, 0, 0], "normal": [1, 0, 0]}, "guide_boundary": 1}, SIZES, {}, "both given"),
    ({**GUIDE, "centre": [0, 0, 0]}, SIZES, {}, "both given"),
    ({"guide_boundary": 1, "guide_closed": True}, SIZES, {}, "surface.guide_closed"),
    ({**POINT, "directions": "tuned"}, {**SIZES, "creases": 8}, {}, r"\[from, to\]"),
    ({**POINT, "directions": [90, 30]}, {**SIZES, "creases": 8}, {}, "rising"),
    ({**GUIDE, "directions": [0, 90]}, SIZES, {}, "no surface.point"),
    ({**GUIDE, "directions": 5}, SIZES, {}, "from 20 to 160"),
    ({**GUIDE, "directions": "sideways"}, SIZES, {}, "surface.directions"),
    ({"directions": "tuned"}, {}, {}, "surface.directions belongs"),
    ({"reach": 2}, {}, {}, "surface.reach belongs"),
    ({"crop": "rectangle"}, {}, {}, "always cropped to its outline"),
    ({**GUIDE, "overhang": False}, SIZES, {}, "overhang from 45 degrees on"),
    ({**GUIDE, "overhang": False}, {**SIZES, "theta": 35}, {}, r"amplitudes from 0\.0596 on overhang"),
    ({**GUIDE, "seams": 2}, SIZES, {}, "surface.seams cut a whole surface apart"),
    ({"seams": 2, "centre": [0, 0, 0]}, {**SIZES, "initial": "normal"}, {}, "in one piece"),
    ({"seams": -1}, {}, {}, "a whole number from 0 to 100"),
    ({**GUIDE, "boundary": True, "beyond": True}, SIZES, {}, "surface.boundary"),
    ({**POINT, "crop": "outline"}, {**SIZES, "creases": 8}, {}, "open families"),
    ({**GUIDE, "crop": "outline"}, SIZES, {"principal": True}, "solve.principal needs a whole grid"),
    ({**GUIDE, "crop": "outline"}, SIZES, {"method": "paper"}, "method = \"paper\" needs a whole grid"),
    ({**GUIDE, "handles": PULL}, SIZES, {}, "surface.handles edits"),
    ({**GUIDE, "guide_section": {"point": [0, 0, 0], "normul": [1, 0, 0]}}, SIZES, {}, "known here: point, normal"),
    ({**GUIDE}, {**SIZES, "initial": "normal"}, {}, "failure of whole surfaces"),
    ({}, {"samples": 99}, {"principal": True}, "solve.principal does not go with pattern.samples"),
    ({}, {}, {"method": "paper"}, "solve.method"),
    ({}, {}, {"cut": 10}, "solve.cut"),
    ({}, {"creases": 12}, {}, "pattern.creases"),
    ({}, {"initial": "normal"}, {}, "surface.centre"),
    ({"handles": PULL}, {"samples": 80}, {}, "pattern.samples"),
    ({"edited_file": "x.obj"}, {}, {}, "surface.file"),
    (GUIDE, SIZES, {"weights": [0, 0, 0, 0, 0]}, "all 0"),
])
def test_contradictions_are_one_sentence(surface, pattern, solve, expected):
    with pytest.raises(InvalidDesign, match=expected) as caught:
        design_from_dict({"surface": {**BASE, **surface}, "pattern": pattern, "solve": solve})
    assert "\n" not in str(caught.value)


def test_the_points_of_a_guide_file_are_taken_into_the_design(tmp_path):
    (tmp_path / "line.csv").write_text("x,y,z\n0,0,0\n1,0.5,0\n")
    design = design_from_dict({"surface": {**BASE, "guide_file": "line.csv"}, "pattern": SIZES}, base=tmp_path)
    assert design.surface.guide == [[0, 0, 0], [1, 0.5, 0]]
    assert design.surface.guide_file is None
    for closed, name, expected in ((True, "line.csv", "at least 3 rows"), (False, "nowhere.csv", "there is no curve file")):
        with pytest.raises(InvalidDesign, match=expected):
            design_from_dict({"surface": {**BASE, "guide_file": name, "guide_closed": closed}, "pattern": SIZES},
                             base=tmp_path)

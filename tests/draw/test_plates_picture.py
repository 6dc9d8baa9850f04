import numpy as np
import pytest

import plisse.draw.plates
from plisse.draw.plates import film, write_plates_picture
from plisse.structure.exact import alternating_cones
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.hinged_range import hinged_range
from plisse.transform.solids import solids


@pytest.fixture
def drawn(monkeypatch):
    """What would be rendered: captions and shapes; the command's test looks at a real picture."""
    shown = {}

    def remember(shapes, captions, path, **about):
        shown.update(zip(captions, shapes, strict=True))

    monkeypatch.setattr(plisse.draw.plates, "write_row", remember)
    return shown


def test_hinged_plates_are_drawn_in_place_opened_exploded_and_as_a_node(drawn):
    plates = alternating_cones(4, 9).plates(0.01, gap=0.04, hinged=True)
    write_plates_picture(plates, "a.png", movement=hinged_range(plates))
    assert list(drawn) == ["in place", "opened to 50 %", "exploded", "a node, enlarged"]
    whole = drawn["in place"]
    assert whole.topology.face_count == 24 * 6
    assert drawn["a node, enlarged"].topology.face_count == 4 * 6
    for name in ("opened to 50 %", "exploded"):
        assert drawn[name].mean_edge == pytest.approx(whole.mean_edge, rel=1e-9)  # plates are rigid
        assert drawn[name].diagonal > 1.02 * whole.diagonal


def test_the_film_shows_every_plate_once_with_its_number_inside():
    import shapely

    plates = alternating_cones(4, 9, closed=True).plates(0.01, gap=0.04, hinged=True)
    sheet = film(plates, "cm")
    outlines = [shapely.Polygon(line.points) for line in sheet.layer("plate").lines]
    numbers = sheet.layer("number").texts
    assert [int(text.words) for text in numbers] == list(range(1, 28))
    assert all(outline.contains(shapely.Point(*text.at)) for outline, text in zip(outlines, numbers, strict=True))
    assert max(one.intersection(other).area for k, one in enumerate(outlines) for other in outlines[:k]) == 0
    assert sheet.size == pytest.approx(10 * np.ptp(plates.structure.development, axis=0) + 10)


def test_a_hexagon_becomes_a_plate_with_six_walls(drawn):
    angle = np.pi / 3 * np.arange(6)
    corners = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=1)
    wing = corners[[0, 1]] + [np.cos(np.pi / 6), 0.5, 0.8]
    topology = Topology(8, np.array([[1, 0, 6, 7]]), (np.arange(6),))
    plates = PleatedStructure(topology, np.concatenate([corners, wing])).plates(0.1)
    assert plates.areas[1] == pytest.approx(1.5 * np.sqrt(3), rel=0.05)  # the edge at the wing is mitred
    assert [len(face) for face in solids(plates)[1].faces] == [6, 6, 4, 4, 4, 4, 4, 4]
    write_plates_picture(plates, "a.png")
    assert [len(face) for face in drawn["in place"].topology.faces] == [4] * 12 + [6] * 2

import xml.etree.ElementTree as ET

import numpy as np
import pytest
import svgelements

from plisse.draw.drawing import Arc, Drawing, Layer, Line, Spline, Text, crease_pattern
from plisse.draw.strokes import MACHINE, PRINT
from plisse.geometry.bezier import bezier_through
from plisse.io.svg import INKSCAPE, SVG, write_svg


def layers_of(path):
    root = ET.parse(path).getroot()
    return root, {group.get(f"{{{INKSCAPE}}}label"): group for group in root.findall(f"{{{SVG}}}g")}


def points_of(element):
    closed = element.get("d").endswith("Z")
    pairs = element.get("d").lstrip("M").rstrip(" Z").split()
    points = np.array([list(map(float, pair.split(","))) for pair in pairs])
    return np.concatenate([points, points[:1]]) if closed else points


def length_of(group):
    return sum(np.hypot(*np.diff(points_of(path), axis=0).T).sum() for path in group)


@pytest.mark.parametrize(("units", "factor"), [("mm", 1.0), ("in", 25.4)])
def test_lengths_are_those_of_the_development_in_millimetres(closed_cones, tmp_path, units, factor):
    write_svg(crease_pattern(closed_cones, units), tmp_path / "d.svg")
    _, groups = layers_of(tmp_path / "d.svg")
    edges = closed_cones.cut.topology.edges
    a, b = closed_cones.development[edges.vertices.T]
    lengths = factor * np.linalg.norm(a - b, axis=1)
    folded = edges.is_crease & ~edges.is_boundary
    on_paper = length_of(groups["mountain"]) + length_of(groups["valley"])
    assert on_paper == pytest.approx(lengths[folded].sum(), abs=1e-3)
    assert length_of(groups["boundary"]) == pytest.approx(lengths[edges.is_boundary].sum(), abs=1e-3)
    rulings = ~edges.is_crease & ~edges.is_boundary
    assert length_of(groups["ruling"]) == pytest.approx(lengths[rulings].sum(), abs=1e-3)


def test_one_user_unit_is_one_millimetre_and_everything_lies_on_the_page(cones, tmp_path):
    write_svg(crease_pattern(cones), tmp_path / "d.svg")
    root, groups = layers_of(tmp_path / "d.svg")
    box = list(map(float, root.get("viewBox").split()))
    assert [root.get("width"), root.get("height")] == [f"{root.get('viewBox').split()[k]}mm" for k in (2, 3)]
    points = np.concatenate([points_of(path) for group in groups.values() for path in group])
    assert np.allclose(points.min(axis=0), 5, atol=1e-5)
    assert np.allclose(points.max(axis=0), np.array(box[2:]) - 5, atol=1e-5)


def test_layers_carry_the_colours_that_origami_simulator_reads(cones, tmp_path):
    write_svg(crease_pattern(cones), tmp_path / "d.svg")
    _, groups = layers_of(tmp_path / "d.svg")
    assert list(groups) == ["ruling", "boundary", "mountain", "valley"]
    assert [MACHINE[name].colour for name in ("mountain", "valley", "boundary")] == ["#ff0000", "#0000ff", "#000000"]
    for name, group in groups.items():
        assert group.get(f"{{{INKSCAPE}}}groupmode") == "layer"
        assert {path.get("stroke") for path in group} == {MACHINE[name].colour}


def test_every_crease_is_one_path(cones, tmp_path):
    write_svg(crease_pattern(cones), tmp_path / "d.svg")
    _, groups = layers_of(tmp_path / "d.svg")
    assert len(groups["mountain"]) + len(groups["valley"]) == len(cones.topology.creases) - 2
    assert len(groups["boundary"]) == 1
    assert len(groups["ruling"]) == len(cones.topology.rulings) - 2


def test_up_in_the_drawing_is_up_on_the_screen(tmp_path):
    line = Line(np.array([[1.0, 1.0], [1.0, 9.0]]))
    write_svg(Drawing("", (10.0, 20.0), (Layer("mountain", (line,)),)), tmp_path / "d.svg")
    _, groups = layers_of(tmp_path / "d.svg")
    assert points_of(groups["mountain"][0]).tolist() == [[1, 19], [1, 11]]


def test_titles_are_escaped_and_two_writes_give_the_same_bytes(cones, tmp_path):
    for name in ("a.svg", "b.svg"):
        write_svg(crease_pattern(cones, title='5 < 6 & "7" – é'), tmp_path / name)
    root, _ = layers_of(tmp_path / "a.svg")
    assert root.find(f"{{{SVG}}}title").text == '5 < 6 & "7" – é'
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_svgelements_measures_the_same_millimetres(closed_cones, tmp_path):
    drawing = crease_pattern(closed_cones)
    write_svg(drawing, tmp_path / "d.svg")
    picture = svgelements.SVG.parse(tmp_path / "d.svg", ppi=25.4)  # one pixel is one millimetre
    assert np.allclose([picture.width, picture.height], drawing.size, rtol=1e-6)  # its inch has six digits
    paths = [np.array([(point.x, point.y) for point in path.as_points()])
             for path in picture.elements(lambda element: isinstance(element, svgelements.Path))]
    found = sum(np.hypot(*np.diff(path, axis=0).T).sum() for path in paths) * drawing.size[0] / picture.width
    wanted = sum(line.length for layer in drawing.layers for line in layer.lines)
    vertices = sum(len(line.path) for layer in drawing.layers for line in layer.lines)
    assert found == pytest.approx(wanted, abs=1e-6 * vertices)


def test_splines_and_arcs_are_curves_that_other_readers_follow(tmp_path):
    ring = 50 + 20 * np.stack([np.cos(t := np.linspace(0, 2 * np.pi, 40, endpoint=False)), np.sin(t)], axis=1)
    shapes = (Spline(bezier_through(ring, closed=True), closed=True), Arc((50.0, 40.0), 10.0, 0.5, 2.0),
              Arc((50.0, 40.0), 5.0, 1.0, 1.0 + 2 * np.pi))
    write_svg(Drawing("", (100.0, 100.0), (Layer("mountain", shapes),)), tmp_path / "d.svg")
    picture = svgelements.SVG.parse(tmp_path / "d.svg", ppi=25.4)
    spline, arc, circle = picture.elements(lambda element: isinstance(element, svgelements.Path))
    for path, centre, radius in ((spline, (50, 50), 20), (arc, (50, 60), 10), (circle, (50, 60), 5)):
        points = np.array([(path.point(u).x, path.point(u).y) for u in np.linspace(0, 1, 50)])
        assert np.abs(np.hypot(*(points - centre).T) - radius).max() < 1e-4  # the spline's own distance from the circle
    assert arc.length() == pytest.approx(15.0, rel=1e-6)  # its inch has six digits
    assert circle.length() == pytest.approx(10 * np.pi, rel=1e-6)
    first, last = arc.point(0), arc.point(1)
    assert np.allclose([first.x, first.y], [50 + 10 * np.cos(0.5), 60 - 10 * np.sin(0.5)], atol=1e-4)
    assert np.allclose([last.x, last.y], [50 + 10 * np.cos(2.0), 60 - 10 * np.sin(2.0)], atol=1e-4)


def test_words_stand_where_they_belong_and_dashes_are_in_millimetres(tmp_path):
    text = Text("5 < 6", (3.0, 4.0), 7.18, np.pi / 2, "end")
    layer = Layer("valley", (Line(np.array([[0.0, 0.0], [9.0, 0.0]])),), (text,), PRINT["valley"])
    write_svg(Drawing("", (10.0, 20.0), (layer,)), tmp_path / "d.svg")
    _, groups = layers_of(tmp_path / "d.svg")
    assert groups["valley"].get("stroke-dasharray") == "2.2 1.1"
    found = groups["valley"].find(f"{{{SVG}}}text")
    assert found.text == "5 < 6" and found.get("text-anchor") == "end" and found.get("font-size") == "10"
    assert (found.get("x"), found.get("y"), found.get("transform")) == ("3", "16", "rotate(-90 3 16)")

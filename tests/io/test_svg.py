import xml.etree.ElementTree as ET

import numpy as np
import pytest

from plisse.draw.drawing import Drawing, Layer, Line, crease_pattern
from plisse.io.svg import INKSCAPE, STROKES, SVG, write_svg


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
    assert [STROKES[name] for name in ("mountain", "valley", "boundary")] == ["#ff0000", "#0000ff", "#000000"]
    for name, group in groups.items():
        assert group.get(f"{{{INKSCAPE}}}groupmode") == "layer"
        assert {path.get("stroke") for path in group} == {STROKES[name]}


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

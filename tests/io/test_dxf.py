import sys

import ezdxf
import numpy as np
import pytest

from plisse.draw.drawing import Arc, Drawing, Layer, Line, Spline, Text, crease_pattern
from plisse.draw.strokes import PRINT
from plisse.errors import MissingExtra
from plisse.geometry.bezier import bezier_through
from plisse.io.dxf import GAP, write_dxf


def read(path):
    document = ezdxf.readfile(path)
    audit = document.audit()
    assert not audit.errors and not audit.fixes
    return document


def lengths(document):
    """Length by layer, as ezdxf measures polylines."""
    out = {}
    for entity in document.modelspace().query("LWPOLYLINE"):
        points = np.array(entity.get_points("xy"))
        points = np.concatenate([points, points[:1]]) if entity.closed else points
        out[entity.dxf.layer] = out.get(entity.dxf.layer, 0.0) + np.hypot(*np.diff(points, axis=0).T).sum()
    return out


@pytest.mark.parametrize(("units", "factor"), [("mm", 1.0), ("in", 25.4)])
def test_the_sheet_is_r2010_in_millimetres_and_every_length_is_right(closed_cones, tmp_path, units, factor):
    write_dxf([crease_pattern(closed_cones, units)], tmp_path / "s.dxf")
    document = read(tmp_path / "s.dxf")
    assert document.dxfversion == "AC1024"
    assert document.header["$INSUNITS"] == 4 and document.header["$MEASUREMENT"] == 1
    edges = closed_cones.cut.topology.edges
    a, b = closed_cones.development[edges.vertices.T]
    each, found = factor * np.linalg.norm(a - b, axis=1), lengths(document)
    folded = edges.is_crease & ~edges.is_boundary
    assert found["MOUNTAIN"] + found["VALLEY"] == pytest.approx(each[folded].sum(), abs=1e-6)
    assert found["CUT"] == pytest.approx(each[edges.is_boundary].sum(), abs=1e-6)
    assert found["RULING"] == pytest.approx(each[~edges.is_crease & ~edges.is_boundary].sum(), abs=1e-6)


def test_layers_have_the_names_and_colours_that_cutters_sort_by(cones, tmp_path):
    texts = Layer("text", (), (Text("A1", (10.0, 10.0)),))
    drawing = crease_pattern(cones)
    write_dxf([Drawing("", drawing.size, (*drawing.layers, texts))], tmp_path / "s.dxf")
    layers = {layer.dxf.name: layer for layer in read(tmp_path / "s.dxf").layers}
    assert {"MOUNTAIN", "VALLEY", "CUT", "RULING", "TEXT"} <= set(layers)
    assert (layers["MOUNTAIN"].color, layers["VALLEY"].color, layers["CUT"].color) == (1, 5, 7)
    assert layers["MOUNTAIN"].rgb == (255, 0, 0)
    assert all(layers[name].dxf.linetype.upper() == "CONTINUOUS" for name in ("MOUNTAIN", "VALLEY", "CUT"))


def test_several_drawings_stand_side_by_side(cones, tmp_path):
    drawing = crease_pattern(cones)
    write_dxf([drawing, drawing], tmp_path / "s.dxf")
    space = read(tmp_path / "s.dxf").modelspace()
    outlines = [np.array(outline.get_points("xy")) for outline in space.query("LWPOLYLINE[layer=='CUT']")]
    assert np.allclose(outlines[1] - outlines[0], [drawing.size[0] + GAP, 0], atol=1e-9)


def test_splines_arcs_circles_and_words_stay_what_they_are(tmp_path):
    ring = np.stack([np.cos(t := np.linspace(0, 6, 30)), np.sin(t)], axis=1) * 20 + 50
    shapes = (Spline(bezier_through(ring)), Arc((50.0, 50.0), 10.0, 0.5, 2.0), Arc((50.0, 50.0), 5.0, 0.0, 2 * np.pi))
    texts = (Text("up", (10.0, 20.0), 4.0, np.pi / 2, "middle"),)
    write_dxf([Drawing("", (100.0, 100.0), (Layer("mountain", shapes, texts, PRINT["mountain"]),))], tmp_path / "s.dxf")
    document = read(tmp_path / "s.dxf")
    space = document.modelspace()
    spline, = space.query("SPLINE")
    points = np.array([(point.x, point.y) for point in spline.flattening(1e-3)])
    assert np.abs(np.hypot(*(points - 50).T) - 20).max() < 2e-3  # 1e-3 is how finely it is flattened here
    arc, = space.query("ARC")
    assert (arc.dxf.radius, np.radians([arc.dxf.start_angle, arc.dxf.end_angle])) == (10, pytest.approx([0.5, 2.0]))
    circle, = space.query("CIRCLE")
    assert circle.dxf.radius == 5
    text, = space.query("TEXT")
    assert (text.dxf.text, text.dxf.height, text.dxf.rotation) == ("up", 4, 90)
    dash = document.linetypes.get(document.layers.get("MOUNTAIN").dxf.linetype).pattern_tags
    assert [tag.value for tag in dash.tags if tag.code == 49] == [4.0, -1.0, 0.5, -1.0]


def test_without_ezdxf_one_sentence_says_what_to_install(cones, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(MissingExtra, match=r'ezdxf.*pip install "plisse\[cad\]"'):
        write_dxf([Drawing("", (1.0, 1.0), (Layer("cut", (Line(np.zeros((2, 2))),)),))], tmp_path / "s.dxf")
    assert list(tmp_path.iterdir()) == []

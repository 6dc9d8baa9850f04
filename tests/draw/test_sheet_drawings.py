"""Sheets as drawings: curves within their tolerance, pages at 1:1, every line where it belongs."""

import numpy as np
import pytest
import shapely

from plisse.draw.pages import printed_pages
from plisse.draw.shapes import Arc, Bulged, Line, Spline
from plisse.draw.sheets import legend_of, sheet_drawings
from plisse.draw.smoothing import Smoother
from plisse.draw.strokes import PRINT
from plisse.fabricate import sheets


def text_box(text):
    """Room of a text with the widths of Helvetica, about 0.95 heights per character."""
    along, up = np.array([np.cos(text.angle), np.sin(text.angle)]), np.array([-np.sin(text.angle), np.cos(text.angle)])
    width = 0.95 * text.height * len(text.words)
    start = np.array(text.at) - along * width * {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor]
    end, up = start + width * along, text.height * up
    return shapely.Polygon([start, end, end + up, start + up])


@pytest.fixture
def plan(cones):
    return sheets(cones, material=(200.0, 180.0), kerf=0.2)


def test_cut_lines_are_the_outlines_where_they_lie(plan):
    for number, drawing in enumerate(sheet_drawings(plan)):
        cut = [shapely.Polygon(line.points) for line in drawing.layer("cut").lines]
        placed = [shapely.transform(piece.outline, placement.apply) for piece, placement in plan.on_sheet(number)]
        assert sum(shape.length for shape in cut) == pytest.approx(sum(shape.length for shape in placed), rel=1e-12)
        assert shapely.union_all(cut).symmetric_difference(shapely.union_all(placed)).area < 1e-9
        assert drawing.size == (200.0, 180.0)


def test_folds_are_not_moved_by_the_kerf_and_keep_to_their_piece(plan, cones):
    drawn = [line for drawing in sheet_drawings(plan, score="solid", captioned=False)
             for name in ("mountain", "valley") for line in drawing.layer(name).lines]
    edges, points = plan.paper.topology.edges, plan.paper.points
    piece = np.zeros(plan.paper.topology.face_count)
    for one in plan.pieces:
        piece[one.faces] = one.number
    within = edges.is_crease & ~edges.is_boundary & (piece[edges.faces[:, 0]] == piece[edges.faces[:, 1]])
    a, b = points[edges.vertices[within]].swapaxes(0, 1)
    on_creases = sum(1 for joint in plan.joints if joint.on_crease)
    assert on_creases == 0
    assert sum(line.length for line in drawn) == pytest.approx(np.linalg.norm(a - b, axis=1).sum(), rel=1e-9)


def test_nothing_leaves_the_sheet_and_no_two_texts_overlap(plan):
    for drawing in sheet_drawings(plan, title="cones", strokes=PRINT):
        paper = shapely.box(0, 0, *drawing.size)
        texts = [text_box(text) for layer in drawing.layers for text in layer.texts]
        lines = [shapely.LineString(shape.path) for layer in drawing.layers for shape in layer.lines]
        assert all(paper.contains(shape) for shape in [*texts, *lines])
        assert not any(one.intersects(other) for k, one in enumerate(texts) for other in texts[:k])
        bar, = (line for line in drawing.layer("text").lines if len(line.points) == 4)
        assert np.ptp(bar.points[:, 0]) == pytest.approx(100.0, abs=1e-12)


@pytest.mark.parametrize("kind", ["spline", "arc"])
@pytest.mark.parametrize("tolerance", [0.2, 0.02])
def test_smooth_curves_stay_within_the_tolerance_and_say_how_far_they_go(kind, tolerance):
    turn = np.linspace(0, 1.2, 300)
    bend = np.stack([(60 + 20 * turn) * np.cos(turn), (60 + 20 * turn) * np.sin(turn)], axis=1)
    outline = np.concatenate([bend, 0.5 * bend[::-1]])
    smoother = Smoother(kind, tolerance)
    shapes = smoother.shapes(outline, closed=True)
    assert (Spline if kind == "spline" else Arc) in set(map(type, shapes))
    assert sum(type(shape) is Line for shape in shapes) == 2
    exact = shapely.LinearRing(outline)
    far = max(shapely.distance(exact, shapely.points(shape.path)).max() for shape in shapes)
    assert far <= tolerance * 1.01 + 1e-3  # the smooth curve bulges between the vertices of the polyline by up to 1e-3
    assert 0 < smoother.deviation <= tolerance and smoother.kept == 0
    assert len(shapes) < 40
    ends = sorted((round(x, 6), round(y, 6)) for shape in shapes for x, y in shape.path[[0, -1]])
    assert ends[::2] == ends[1::2]


def test_curves_coarser_than_the_tolerance_stay_what_they_are():
    turn = np.linspace(0, 3, 20)
    smoother = Smoother("spline", 0.01)
    line, = smoother.shapes(50 * np.stack([np.cos(turn), np.sin(turn)], axis=1))
    assert isinstance(line, Line) and len(line.points) == 20 and smoother.kept == 1


def test_pages_show_every_line_of_a_large_sheet_at_full_size(cones):
    drawings = sheet_drawings(sheets(cones, material=(420.0, 300.0)), strokes=PRINT, captioned=False)
    paper = (210.0, 297.0)
    pages = printed_pages(drawings, paper)
    assert len(pages) > len(drawings)
    assert {tuple(sorted(page.size)) for page in pages} == {paper}
    for page in pages:
        sheet = shapely.box(5, 5, page.size[0] - 5, page.size[1] - 5)
        assert all(sheet.contains(shapely.LineString(shape.path)) for layer in page.layers for shape in layer.lines)
        assert any("row" in text.words for text in page.layer("text").texts)
    shown = sum(shape.length for page in pages for shape in page.layer("cut").lines)
    whole = sum(shape.length for drawing in drawings for shape in drawing.layer("cut").lines)
    assert whole < shown < 2 * whole
    names = {text.words for drawing in drawings for text in drawing.layer("text").texts}
    assert names <= {text.words for page in pages for text in page.layer("text").texts}


def test_sheets_no_larger_than_the_paper_lie_whole_in_the_middle_of_a_page(plan):
    drawings = sheet_drawings(plan, smoother=Smoother("arc", 0.3))
    pages = printed_pages(drawings, (210.0, 297.0))
    assert [page.size for page in pages] == [(210.0, 297.0)] * len(drawings)
    for page, drawing in zip(pages, drawings, strict=True):
        shift = (np.array(page.size) - drawing.size) / 2
        for layer, other in zip(page.layers, drawing.layers, strict=True):
            assert all(np.abs(a.path - b.path - shift).max() < 1e-9 for a, b in zip(layer.lines, other.lines, strict=True))


@pytest.mark.parametrize("kind", ["polyline", "spline", "arc"])
@pytest.mark.parametrize("direction", [1, -1])
def test_every_outline_is_one_closed_shape_of_whatever_curves(kind, direction):
    turn = np.linspace(0, 1.2, 300)
    bend = 60 * np.stack([np.cos(turn), np.sin(turn)], axis=1)
    outline = np.concatenate([bend, 0.5 * bend[::-1]])[::direction]
    shape = Smoother(kind, 0.05).outline(outline)
    assert isinstance(shape, {"polyline": Line, "spline": Spline, "arc": Bulged}[kind]) and shape.closed
    assert np.abs(shape.path[0] - shape.path[-1]).max() < 1e-9
    exact = shapely.Polygon(outline)
    assert shapely.Polygon(shape.path).symmetric_difference(exact).area < 0.05 * exact.length
    assert shape.length == pytest.approx(exact.length, rel=1e-4)  # a polyline of 300 points is shorter than its arc


def test_a_closed_line_of_arcs_turns_as_its_bulges_say():
    disk = Bulged(np.array([[-2.0, 0.0], [2.0, 0.0]]), np.array([1.0, 1.0]))
    assert disk.radii == pytest.approx([2.0, 2.0], rel=1e-12)
    assert disk.length == pytest.approx(4 * np.pi, rel=1e-12)
    lens = Bulged(disk.points, np.array([np.tan(np.pi / 8), 0.0]))
    assert lens.path[:, 1].min() == pytest.approx(-2 * (np.sqrt(2) - 1), rel=1e-6)  # controls follow arcs to 1e-9


def test_the_first_tile_bears_the_title_and_explains_the_folds(cones):
    drawings = sheet_drawings(sheets(cones, material=(420.0, 300.0)), title="fan", strokes=PRINT, captioned=False)
    first, *others = printed_pages(drawings, (210.0, 297.0), legend_of(drawings, "dashed"))
    words = [text.words for text in first.layer("text").texts]
    assert {"fan sheet 1", "mountain", "valley"} <= set(words)
    assert all("fan sheet 1" not in [text.words for text in page.layer("text").texts] for page in others)
    boxes = [text_box(text) for text in first.layer("text").texts if text.at[1] < 17]
    assert not any(one.intersects(other) for k, one in enumerate(boxes) for other in boxes[:k])
    samples = [line for line in first.layer("mountain").lines if line.path[:, 1].max() < 17]
    assert samples and all(8 <= x <= first.size[0] - 8 for line in samples for x in line.path[:, 0])

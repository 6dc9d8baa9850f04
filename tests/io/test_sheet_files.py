"""Sheets read back by readers of others: sizes, lengths, layers, and what a printer sees."""

import io

import numpy as np
import pytest
import shapely

from plisse.draw.pages import printed_pages
from plisse.draw.sheets import sheet_drawings
from plisse.draw.smoothing import Smoother
from plisse.draw.strokes import PRINT
from plisse.errors import PlisseError
from plisse.fabricate import sheets
from plisse.io.sheets import require_place, write_sheets

POINTS_PER_MM = 72 / 25.4


@pytest.fixture
def plan(cones):
    return sheets(cones, material=(150.0, 160.0), kerf=0.1)


def test_cut_lines_in_svg_have_the_length_of_the_outlines(plan, tmp_path):
    svgelements = pytest.importorskip("svgelements")
    files = write_sheets(sheet_drawings(plan), tmp_path / "cones.svg")
    assert [file.name for file in files] == [f"cones-{k}.svg" for k in range(1, plan.count + 1)] and plan.count > 1
    length = 0.0
    for file in files:
        document = svgelements.SVG.parse(str(file), ppi=25.4)
        millimetre = document.width / 150  # the reader rounds its inch
        assert (document.width, document.height) == pytest.approx((150.0, 160.0), rel=1e-6)
        cut = next(group for group in document.select(lambda e: isinstance(e, svgelements.Group)) if group.id == "cut")
        length += sum(path.length() / millimetre for path in cut if isinstance(path, svgelements.Path))
    # coordinates are written to a nanometre, each line has about a hundred
    assert length == pytest.approx(sum(piece.outline.length for piece in plan.pieces), abs=1e-4)


@pytest.mark.parametrize("curves", ["polyline", "spline", "arc"])
def test_dxf_passes_the_audit_and_has_its_layers_in_millimetres(plan, tmp_path, curves):
    ezdxf = pytest.importorskip("ezdxf")
    file, = write_sheets(sheet_drawings(plan, smoother=Smoother(curves, 0.3)), tmp_path / "cones.dxf")
    document = ezdxf.readfile(file)
    assert document.audit().errors == [] and document.units == 4
    space = document.modelspace()
    assert {"CUT", "MOUNTAIN", "VALLEY", "TEXT", "FLAP", "TICK"} <= {entity.dxf.layer for entity in space}
    kinds = {entity.dxftype() for entity in space if entity.dxf.layer == "CUT"}
    assert kinds == {"SPLINE" if curves == "spline" else "LWPOLYLINE"}
    words = [entity.dxf.text for entity in space if entity.dxftype() == "TEXT"]
    for joint in plan.joints:
        assert all(words.count(label) == 2 for label in joint.labels)


def test_pdf_pages_have_the_size_of_the_paper(plan, tmp_path):
    pikepdf = pytest.importorskip("pikepdf")
    pages = printed_pages(sheet_drawings(plan, strokes=PRINT, captioned=False), (140.0, 150.0))
    file, = write_sheets(pages, tmp_path / "cones.pdf")
    with pikepdf.open(file) as document:
        boxes = [[float(value) for value in page.mediabox] for page in document.pages]
    assert len(boxes) == len(pages)
    assert all(sorted(box[2:]) == pytest.approx([140 * POINTS_PER_MM, 150 * POINTS_PER_MM], abs=1e-3) for box in boxes)


def test_a_printed_sheet_is_whole_dark_enough_and_its_bar_is_100_mm_long(plan, tmp_path):
    pdfium = pytest.importorskip("pypdfium2")
    file, = write_sheets(sheet_drawings(plan, strokes=PRINT), tmp_path / "cones.pdf")
    scale = 8 / POINTS_PER_MM  # eight pixels per millimetre
    document = pdfium.PdfDocument(io.BytesIO(file.read_bytes()))
    page = np.asarray(document[0].render(scale=scale).to_pil().convert("L"), dtype=float)
    document.close()
    assert page.shape == pytest.approx((160 * 8, 150 * 8), abs=1)
    dark = page < 140
    rows, columns = np.flatnonzero(dark.any(axis=1)), np.flatnonzero(dark.any(axis=0))
    assert min(rows[0], columns[0]) > 3 * 8 and rows[-1] < page.shape[0] - 3 * 8 and columns[-1] < page.shape[1] - 3 * 8
    bottom = dark[-int(7.5 * 8):]
    longest = max(np.diff(np.flatnonzero(np.diff(np.pad(row, 1).astype(int)))).max(initial=0) for row in bottom)
    assert longest / 8 == pytest.approx(100.0, abs=0.5)


def test_a_directory_gets_one_file_per_sheet_and_loses_those_of_an_earlier_run(plan, tmp_path):
    place = tmp_path / "out"
    place.mkdir()
    (place / "sheet-99.svg").write_text("old")
    (place / "notes.txt").write_text("mine")
    files = write_sheets(sheet_drawings(plan), place)
    assert sorted(place.iterdir()) == sorted([*files, place / "notes.txt"])


@pytest.mark.parametrize(("name", "word"), [("sheets.png", "svg"), ("missing/sheets.pdf", "directory"),
                                            ("folder.svg", "directory")])
def test_places_that_cannot_be_written_are_refused_before_any_work(tmp_path, name, word):
    (tmp_path / "folder.svg").mkdir()
    with pytest.raises(PlisseError, match=word):
        require_place(tmp_path / name)


def test_files_of_other_names_in_the_directory_stay(plan, tmp_path):
    place = tmp_path / "out"
    place.mkdir()
    mine = ["sheet-metal.svg", "sheet-1-copy.svg", "my-sheet-1.svg", "sheet-.svg"]
    for name in mine:
        (place / name).write_text("mine")
    files = write_sheets(sheet_drawings(plan), place)
    assert {path.name for path in place.iterdir()} == {*mine, *(file.name for file in files)}


def test_sheets_of_an_earlier_run_vanish_and_files_of_others_stay(plan, cones, tmp_path):
    (tmp_path / "m-7.svg").write_text("mine")
    write_sheets(sheet_drawings(plan, title="other"), tmp_path / "m.svg")
    (tmp_path / "m-1.svg").rename(tmp_path / "m-8.svg")
    several = write_sheets(sheet_drawings(plan, title="cones"), tmp_path / "m.svg")
    assert {path.name for path in tmp_path.iterdir()} == {"m-7.svg", "m-8.svg", *(path.name for path in several)}
    write_sheets(sheet_drawings(sheets(cones), title="cones"), tmp_path / "m.svg")
    assert {path.name for path in tmp_path.iterdir()} == {"m-7.svg", "m-8.svg", "m.svg"}


@pytest.mark.parametrize("curves", ["polyline", "spline", "arc"])
def test_every_piece_is_one_closed_entity_and_one_closed_path(plan, tmp_path, curves):
    ezdxf = pytest.importorskip("ezdxf")
    svgelements = pytest.importorskip("svgelements")
    drawings = sheet_drawings(plan, smoother=Smoother(curves, 0.3))
    file, = write_sheets(drawings, tmp_path / "cones.dxf")
    cut = [entity for entity in ezdxf.readfile(file).modelspace() if entity.dxf.layer == "CUT"]
    assert len(cut) == len(plan.pieces) and all(entity.closed for entity in cut)
    paths = [path for file in write_sheets(drawings, tmp_path / "cones.svg")
             for group in svgelements.SVG.parse(str(file), ppi=25.4).select(lambda e: isinstance(e, svgelements.Group))
             if group.id == "cut" for path in group if isinstance(path, svgelements.Path)]
    assert len(paths) == len(plan.pieces)
    assert all(isinstance(path[-1], svgelements.Close) and len(list(path.as_subpaths())) == 1 for path in paths)
    lines = [line for drawing in drawings for line in drawing.layer("cut").lines]
    for path, line in zip(paths, lines, strict=True):
        assert path.length(error=1e-5) == pytest.approx(line.length, rel=1e-4)  # its inch has six digits
        probes = np.array([(point.x, 160 - point.y) for point in (path.point(u) for u in np.linspace(0, 1, 40))])
        assert shapely.distance(shapely.LineString(line.path), shapely.points(probes)).max() < 0.05  # the path has chords
    from ezdxf.path import make_path

    for entity, line in zip(cut, lines, strict=True):
        points = np.array([(point.x, point.y) for point in make_path(entity).flattening(1e-3)])
        assert np.hypot(*np.diff(points, axis=0).T).sum() == pytest.approx(line.length, rel=1e-3)  # flattened here

import re
import sys

import numpy as np
import pikepdf
import pypdfium2
import pytest

from plisse.draw.drawing import Arc, Drawing, Layer, Line, Spline, Text, crease_pattern
from plisse.draw.strokes import PRINT
from plisse.errors import MissingExtra, PlisseError
from plisse.geometry.bezier import bezier_through
from plisse.io.pdf import write_pdf

POINT = 25.4 / 72


def paths_of(page):
    """Subpaths of a page as arrays of numbers in millimetres, in the order they are stroked, curves by controls."""
    paths, current = [], []
    for operands, operator in pikepdf.parse_content_stream(page):
        name = str(operator)
        numbers = [float(x) for x in operands] if name in ("m", "l", "c") else []
        if name == "m":
            current = [numbers]
        elif name in ("l", "c"):
            current += [numbers[k:k + 2] for k in range(0, len(numbers), 2)]
        elif name in ("S", "s"):
            paths.append(POINT * np.array(current + current[:1] * (name == "s")))
    return paths


@pytest.mark.parametrize(("units", "factor"), [("mm", 1.0), ("cm", 10.0)])
def test_the_page_is_the_sheet_and_every_length_on_it_is_right(cones, tmp_path, units, factor):
    drawing = crease_pattern(cones, units, strokes=PRINT)
    write_pdf([drawing], tmp_path / "s.pdf")
    with pikepdf.open(tmp_path / "s.pdf") as document:
        page, = document.pages
        box = [float(x) for x in page.MediaBox]
        assert np.allclose(box, [0, 0, *np.array(drawing.size) / POINT], atol=1e-4)  # page boxes have four decimals
        found = paths_of(page)
        assert document.Root.ViewerPreferences.PrintScaling == "/None"
    wanted = [line for layer in drawing.layers for line in layer.lines]
    assert len(found) == len(wanted)
    for path, line in zip(found, wanted, strict=True):
        assert np.hypot(*np.diff(path, axis=0).T).sum() == pytest.approx(line.length, abs=1e-6)
        assert np.allclose(path, line.path, atol=1e-6)


def test_a_drawing_lies_in_the_middle_of_larger_paper_at_the_same_scale(tmp_path):
    line = Line(np.array([[0.0, 0.0], [100.0, 0.0]]))
    drawing = Drawing("", (100.0, 50.0), (Layer("cut", (line,)),))
    write_pdf([drawing, drawing], tmp_path / "s.pdf", page=(297.0, 210.0))
    with pikepdf.open(tmp_path / "s.pdf") as document:
        assert len(document.pages) == 2
        for page in document.pages:
            path, = paths_of(page)
            assert np.allclose(path, [[98.5, 80.0], [198.5, 80.0]], atol=1e-6)


def test_curves_are_drawn_as_curves(tmp_path):
    ring = 50 + 20 * np.stack([np.cos(t := np.linspace(0, 6, 30)), np.sin(t)], axis=1)
    spline, arc = Spline(bezier_through(ring)), Arc((50.0, 50.0), 30.0, 0.5, 2.0)
    write_pdf([Drawing("", (100.0, 100.0), (Layer("mountain", (spline, arc)),))], tmp_path / "s.pdf")
    with pikepdf.open(tmp_path / "s.pdf") as document:
        first, second = paths_of(document.pages[0])
    assert np.allclose(first, spline.controls, atol=1e-6) and np.allclose(second, arc.controls, atol=1e-6)


def test_mountains_and_valleys_differ_without_colour(cones, tmp_path):
    write_pdf([crease_pattern(cones, strokes=PRINT)], tmp_path / "s.pdf")
    with pikepdf.open(tmp_path / "s.pdf") as document:
        content = document.pages[0].Contents.read_bytes().decode()
    dashes = set(re.findall(r"\[([\d. ]+)\] 0 d", content))
    assert len(dashes) == 2 and sorted(len(dash.split()) for dash in dashes) == [2, 4]


def test_rendered_ink_is_where_the_drawing_says_and_words_can_be_read(tmp_path):
    box = Line(np.array([[20.0, 30.0], [80.0, 30.0], [80.0, 60.0], [20.0, 60.0]]), closed=True)
    texts = Layer("text", (), (Text("Strip 7", (50.0, 5.0), 5.0, anchor="middle"),))
    write_pdf([Drawing("", (100.0, 70.0), (Layer("cut", (box,)), texts))], tmp_path / "s.pdf")
    document = pypdfium2.PdfDocument(tmp_path / "s.pdf")
    page = document[0]
    image = np.asarray(page.render(scale=10 * POINT).to_pil().convert("L"))  # ten pixels per millimetre
    dark = np.argwhere(image[:500] < 128)
    assert np.allclose([dark.min(axis=0), dark.max(axis=0)], [[100, 200], [400, 800]], atol=2)
    assert page.get_textpage().get_text_bounded().strip() == "Strip 7"
    document.close()


def test_what_does_not_fit_is_refused_and_nothing_written(cones, tmp_path):
    drawing = crease_pattern(cones)
    with pytest.raises(PlisseError, match="does not fit on a page of 50"):
        write_pdf([drawing], tmp_path / "s.pdf", page=(50.0, 50.0))
    with pytest.raises(PlisseError, match="PDF ends at 5080 mm"):
        write_pdf([crease_pattern(cones, "m")], tmp_path / "s.pdf")
    assert list(tmp_path.iterdir()) == []


def test_equal_drawings_give_equal_bytes(cones, tmp_path):
    for name in ("a.pdf", "b.pdf"):
        write_pdf([crease_pattern(cones)], tmp_path / name)
    assert (tmp_path / "a.pdf").read_bytes() == (tmp_path / "b.pdf").read_bytes()


def test_without_reportlab_one_sentence_says_what_to_install(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "reportlab", None)
    with pytest.raises(MissingExtra, match=r'reportlab.*pip install "plisse\[pdf\]"'):
        write_pdf([], tmp_path / "s.pdf")
    assert list(tmp_path.iterdir()) == []

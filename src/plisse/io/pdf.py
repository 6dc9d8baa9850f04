"""PDF at exactly 1:1: one page per drawing, of its size or of a given paper."""

from pathlib import Path

import numpy as np

from plisse.draw.drawing import Drawing, Layer
from plisse.draw.shapes import Arc, Line, Shape, Text
from plisse.draw.strokes import Stroke
from plisse.errors import PlisseError
from plisse.extras import optional
from plisse.io.atomic import written

__all__ = ["POINTS_PER_MM", "write_pdf"]

POINTS_PER_MM = 72 / 25.4
LARGEST = 14_400 / POINTS_PER_MM


def write_pdf(drawings: list[Drawing], path: str | Path, page: tuple[float, float] | None = None) -> None:
    """Write one page per drawing, as large as the drawing, or `page` (width, height) in mm with the drawing in its middle.

    Equal drawings give equal bytes. Raises MissingExtra without reportlab, PlisseError where a drawing is larger than
    its page or a page larger than PDF allows (5.08 m), or the file cannot be written.
    """
    optional("reportlab", extra="pdf", purpose="PDF files")
    from reportlab.pdfgen.canvas import Canvas

    with written(path) as aside:
        canvas = Canvas(str(aside), invariant=1, pageCompression=1)
        canvas.setTitle(drawings[0].title if drawings else "")
        canvas.setViewerPreference("PrintScaling", "None")
        for drawing in drawings:
            _page(canvas, drawing, drawing.size if page is None else page)
        canvas.save()


def _page(canvas, drawing: Drawing, size: tuple[float, float]) -> None:
    """One page of `size` millimetres."""
    room = [have - want for have, want in zip(size, drawing.size, strict=True)]
    if min(room) < -1e-6:
        raise PlisseError(f"a drawing of {drawing.size[0]:.1f} × {drawing.size[1]:.1f} mm does not fit on a page of "
                          f"{size[0]:.1f} × {size[1]:.1f} mm; take larger paper or smaller pieces")
    if max(size) > LARGEST:
        raise PlisseError(f"the page would be {size[0]:.0f} × {size[1]:.0f} mm, but PDF ends at {LARGEST:.0f} mm; "
                          "write SVG or DXF, or split the sheet")
    canvas.setPageSize([side * POINTS_PER_MM for side in size])
    shift = np.maximum(room, 0) / 2
    for layer in drawing.layers:
        _layer(canvas, layer, shift)
    canvas.showPage()


def _layer(canvas, layer: Layer, shift: np.ndarray) -> None:
    _take(canvas, layer.stroke)
    for shape in layer.lines:
        canvas.addLiteral(_operators(shape, shift))
    for text in layer.texts:
        _write(canvas, text, shift)


def _take(canvas, stroke: Stroke) -> None:
    """Pen and ink of a stroke, round like a pen."""
    canvas.setLineWidth(stroke.width * POINTS_PER_MM)
    canvas.setLineJoin(1)
    canvas.setLineCap(0 if stroke.dash else 1)
    canvas.setDash([length * POINTS_PER_MM for length in stroke.dash], 0)
    colour = [int(stroke.colour[k:k + 2], 16) / 255 for k in (1, 3, 5)]
    canvas.setStrokeColorRGB(*colour)
    canvas.setFillColorRGB(*colour)


def _operators(shape: Shape, shift: np.ndarray) -> str:
    """PDF operators that draw the shape; written here, because reportlab rounds coordinates to six figures in all."""
    points = ((shape.points if isinstance(shape, Line) else shape.controls) + shift) * POINTS_PER_MM
    pairs = [f"{x:.7f} {y:.7f}" for x, y in points.tolist()]
    if isinstance(shape, Line):
        steps = [f"{pair} l" for pair in pairs[1:]]
    else:
        steps = [f"{' '.join(pairs[k:k + 3])} c" for k in range(1, len(pairs), 3)]
    closed = shape.is_circle if isinstance(shape, Arc) else shape.closed
    return "\n".join([f"{pairs[0]} m", *steps, "s" if closed else "S"])


def _write(canvas, text: Text, shift: np.ndarray) -> None:
    canvas.saveState()
    x, y = ((np.array(text.at) + shift) * POINTS_PER_MM).tolist()
    canvas.translate(x, y)
    canvas.rotate(float(np.degrees(text.angle)))
    canvas.setFont("Helvetica", text.font_size * POINTS_PER_MM)
    draw = {"start": canvas.drawString, "middle": canvas.drawCentredString, "end": canvas.drawRightString}[text.anchor]
    draw(0, 0, text.words)
    canvas.restoreState()

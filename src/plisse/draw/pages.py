"""Drawings on the paper of a printer: parts of a large sheet, page by page, with marks to lay them together."""

from dataclasses import replace

import numpy as np

from plisse.draw.captions import HEIGHT, LINE, caption
from plisse.draw.drawing import Drawing, Layer
from plisse.draw.shapes import Bulged, Line, Shape, Spline, Text
from plisse.fabricate.labels import CHARACTER
from plisse.fabricate.tiling import BORDER, Tile, Tiling, tiling

__all__ = ["fits_page", "printed_pages"]

CROSS, RING = 4.0, 1.5
BAR = 100.0


def printed_pages(drawings: list[Drawing], paper: tuple[float, float],
                  folds: dict[str, tuple[float, ...]] | None = None) -> list[Drawing]:
    """Pages of `paper` (width, height) mm at 1:1: drawings that fit stay whole, others are tiled.

    Tiles without lines are left out. Texts stand on every page that shows them whole. The first tile of all bears the
    title of its drawing and explains `folds`, the dashes of layers.
    """
    pages = []
    for number, drawing in enumerate(drawings, 1):
        if fits_page(drawing.size, paper):
            pages.append(_centred(drawing, paper))
            continue
        layout = tiling(drawing.size, paper)
        for tile in layout.tiles:
            layers = _cropped(drawing, layout, tile)
            if any(layer.lines for layer in layers):
                page = _page(drawing, layout, tile, layers, number)
                pages.append(page if pages else _introduced(page, drawing.title, layout, folds or {}))
    return pages


def fits_page(size: tuple[float, float], paper: tuple[float, float]) -> bool:
    """Whether a sheet (width, height) is no larger than the paper, upright or lying."""
    return any(size[0] <= page[0] + 1e-6 and size[1] <= page[1] + 1e-6 for page in (paper, paper[::-1]))


def _centred(drawing: Drawing, paper: tuple[float, float]) -> Drawing:
    """A drawing in the middle of a page, upright if it fits so."""
    upright = drawing.size[0] <= paper[0] + 1e-6 and drawing.size[1] <= paper[1] + 1e-6
    page = paper if upright else paper[::-1]
    shift = (np.array(page) - drawing.size) / 2
    layers = tuple(replace(layer, lines=tuple(_moved(shape, shift) for shape in layer.lines),
                           texts=tuple(_moved_text(text, shift) for text in layer.texts)) for layer in drawing.layers)
    return Drawing(drawing.title, page, layers)


def _moved(shape: Shape, shift: np.ndarray) -> Shape:
    if isinstance(shape, Line | Bulged):
        return replace(shape, points=shape.points + shift)
    if isinstance(shape, Spline):
        return replace(shape, controls=shape.controls + shift)
    return replace(shape, centre=tuple((np.array(shape.centre) + shift).tolist()))


def _moved_text(text: Text, shift: np.ndarray) -> Text:
    return replace(text, at=tuple((np.array(text.at) + shift).tolist()))


def _page(drawing: Drawing, layout: Tiling, tile: Tile, layers: list[Layer], number: int) -> Drawing:
    """One page with its part of the drawing, registration marks, scale bar and its place among the pages."""
    shift = np.array(layout.origin) - tile.corner
    lines: list[Shape] = []
    for mark in layout.marks:
        if _inside(mark[None], tile.corner, layout.window):
            lines += _registration(mark + shift)
    place = f"sheet {number}, row {tile.row} of {layout.rows}, column {tile.column} of {layout.columns}"
    short = f"sheet {number}, row {tile.row}, column {tile.column}"
    said = caption((BORDER, BORDER), layout.window[0], [f"{place}, crosses over crosses, print at 100 %", place, short])
    lines += said["text"][0]
    words = next((layer for layer in layers if layer.name == "text"), Layer("text"))
    others = [layer for layer in layers if layer.name != "text"]
    text = replace(words, lines=(*words.lines, *lines), texts=(*words.texts, *said["text"][1]))
    return Drawing(f"{drawing.title} row {tile.row} column {tile.column}", layout.page, (text, *others))


def _introduced(page: Drawing, title: str, layout: Tiling, folds: dict[str, tuple[float, ...]]) -> Drawing:
    """The page with the title of the drawing above its scale bar and a legend of the folds beside it."""
    legend = caption((BORDER, BORDER), layout.window[0], [], folds)
    names = [text for text in legend["text"][1] if text.words in folds]
    room = int(BAR / (CHARACTER * HEIGHT))
    words = title if len(title) <= room else title[:room - 1] + "…"
    head = Text(words, (BORDER, BORDER + LINE), HEIGHT)
    layers = tuple(replace(layer, lines=(*layer.lines, *legend.get(layer.name, ((), ()))[0] * (layer.name in folds)),
                           texts=(*layer.texts, head, *names) if layer.name == "text" else layer.texts)
                   for layer in page.layers)
    return replace(page, layers=layers)


def _cropped(drawing: Drawing, layout: Tiling, tile: Tile) -> list[Layer]:
    """The layers inside the window of a tile, where they lie on its page."""
    from shapely import LineString, box, get_coordinates, get_parts, intersection, prepare

    low, shift = np.array(tile.corner), np.array(layout.origin) - tile.corner
    window = box(*low, *(low + layout.window))
    prepare(window)
    out = []
    for layer in drawing.layers:
        paths = [LineString(shape.path) for shape in layer.lines]
        parts = get_parts(intersection(np.array(paths, dtype=object), window)) if paths else []
        parts = [part for piece in parts for part in get_parts(piece) if part.geom_type == "LineString" and part.length > 0]
        texts = tuple(_moved_text(text, shift) for text in layer.texts
                      if _inside(_box(text), tile.corner, layout.window))
        out.append(replace(layer, lines=tuple(Line(get_coordinates(part) + shift) for part in parts), texts=texts))
    return out


def _box(text: Text) -> np.ndarray:
    """Corners (4, 2) of the room that a text takes."""
    along, up = np.array([np.cos(text.angle), np.sin(text.angle)]), np.array([-np.sin(text.angle), np.cos(text.angle)])
    width = CHARACTER * text.height * len(text.words)
    start = np.array(text.at) - along * width * {"start": 0.0, "middle": 0.5, "end": 1.0}[text.anchor]
    return np.array([start, start + width * along, start + width * along + text.height * up, start + text.height * up])


def _inside(points: np.ndarray, corner: tuple[float, float], window: tuple[float, float]) -> bool:
    """Whether all points (N, 2) lie in a window."""
    low = np.array(corner)
    return bool(np.logical_and(points >= low - 1e-9, points <= low + window + 1e-9).all())


def _registration(at: np.ndarray) -> list[Shape]:
    """A cross in a circle."""
    angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    across, up = np.array([[-CROSS, 0.0], [CROSS, 0.0]]), np.array([[0.0, -CROSS], [0.0, CROSS]])
    ring = RING * np.stack([np.cos(angle), np.sin(angle)], axis=1)
    return [Line(at + across), Line(at + up), Line(at + ring, closed=True)]

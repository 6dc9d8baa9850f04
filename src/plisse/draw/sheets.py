"""Sheets as drawings at 1:1: what is cut, what is scored, and the numbers that say how it goes together."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from plisse.draw.captions import caption
from plisse.draw.drawing import Drawing, Layer
from plisse.draw.shapes import Line, Shape, Text
from plisse.draw.smoothing import Smoother
from plisse.draw.strokes import MACHINE, Stroke
from plisse.fabricate.folds import flap_lines, fold_lines, tick_marks
from plisse.fabricate.labels import Label, labels_on
from plisse.fabricate.pieces import Piece, Placement
from plisse.fabricate.plan import Sheets
from plisse.fabricate.scores import PATTERNS, Score, dash_spans

__all__ = ["legend_of", "sheet_drawings"]

NAMES = {"M": "mountain", "V": "valley", "F": "flat", "R": "flap"}
ORDER = ("text", "tick", "flat", "flap", "mountain", "valley", "cut")  # cut last: pieces move once they are free
BOLD = 2.5
CLOSEST = 1e-6


def sheet_drawings(plan: Sheets, *, title: str = "", score: Score = "dashed", smoother: Smoother | None = None,
                   strokes: Mapping[str, Stroke] = MACHINE, captioned: bool = True) -> list[Drawing]:
    """One drawing per sheet, layers text, tick, flat, flap, mountain, valley and cut in this order.

    `smoother` says what curves are made of and gathers how far they deviate. Dashes are lines of their own; mountains
    that are drawn through are bolder than valleys. Captions bring scale bar, legend and the number of the sheet.
    """
    smoother = smoother or Smoother()
    looks = {name: replace(strokes.get(name, strokes["text"]), dash=()) for name in ORDER}
    if score == "solid":
        looks["mountain"] = replace(looks["mountain"], width=BOLD * looks["mountain"].width)
    out = []
    for number in range(plan.count):
        shapes: dict[str, list[Shape]] = {name: [] for name in ORDER}
        texts: list[Text] = []
        for piece, placement in plan.on_sheet(number):
            texts += _draw(plan, piece, placement, PATTERNS[score], smoother, shapes)
        if captioned:
            _describe(plan, number, title, PATTERNS[score], shapes, texts)
        layers = tuple(Layer(name, tuple(shapes[name]), tuple(texts) if name == "text" else (), looks[name])
                       for name in ORDER if shapes[name] or name == "text")
        out.append(Drawing(f"{title} sheet {number + 1}".strip(), plan.material, layers))
    return out


def legend_of(drawings: list[Drawing], score: Score) -> dict[str, tuple[float, ...]]:
    """Dashes of the layers mountain and valley, as far as some drawing has any."""
    return {NAMES[letter]: PATTERNS[score][letter] for letter in "MV"
            if any(drawing.layer(NAMES[letter]).lines for drawing in drawings)}


def _draw(plan: Sheets, piece: Piece, placement: Placement, patterns: dict[str, tuple[float, ...]], smoother: Smoother,
          shapes: dict[str, list[Shape]]) -> list[Text]:
    """Add the lines of a piece to those of its sheet; its labels."""
    paper, points = plan.paper, placement.apply(plan.paper.points)
    for ring in piece.rings:
        shapes["cut"].append(smoother.outline(placement.apply(ring)))
    lines = []
    for fold in fold_lines(paper, piece) + flap_lines(paper, piece, plan.joints):
        path = points[np.append(fold.vertices, fold.vertices[:1]) if fold.closed else fold.vertices]
        lines.append(path)
        for dash in _dashes(path, patterns[fold.letter]):
            shapes[NAMES[fold.letter]] += smoother.shapes(dash)
    ticks = placement.apply(tick_marks(paper, piece).reshape(-1, 2)).reshape(-1, 2, 2)
    shapes["tick"] += [Line(tick) for tick in ticks]
    return [_text(label) for label in labels_on(paper, piece, placement, plan.joints, [*lines, *ticks])]


def _dashes(path: np.ndarray, pattern: tuple[float, ...]) -> list[np.ndarray]:
    """Stretches of a polyline (N, 2) that are drawn."""
    length = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(path, axis=0).T))])
    out = []
    for start, end in dash_spans(float(length[-1]), pattern).tolist():
        within = (length > start + CLOSEST) & (length < end - CLOSEST)
        at = np.concatenate([[start], length[within], [end]])
        out.append(np.stack([np.interp(at, length, coordinate) for coordinate in path.T], axis=1))
    return out


def _text(label: Label) -> Text:
    """A label as text whose baseline is half a height below its centre."""
    down = 0.5 * label.height * np.array([np.sin(label.angle), -np.cos(label.angle)])
    x, y = (np.array(label.centre) + down).tolist()
    return Text(label.words, (x, y), label.height, label.angle, "middle")


def _describe(plan: Sheets, number: int, title: str, patterns: dict[str, tuple[float, ...]], shapes: dict[str, list[Shape]],
              texts: list[Text]) -> None:
    """Add scale bar, legend and caption in the free band at the bottom of a sheet."""
    place = f"sheet {number + 1} of {plan.count}"
    words = [f"{title} · {place} · 1:1" if title else f"{place} · 1:1", place, f"{number + 1}/{plan.count}"]
    folds = {NAMES[letter]: patterns[letter] for letter in "MV" if shapes[NAMES[letter]]}
    margin = max(plan.margin, 1.0)
    for layer, (lines, said) in caption((margin, margin + 1.0), plan.material[0] - 2 * margin, words, folds).items():
        shapes[layer] += lines
        texts += said

"""Sheets of plates as drawings at 1:1: what is cut, where bevels begin, and the number of each plate."""

from collections.abc import Mapping

import numpy as np

from plisse.draw.captions import caption
from plisse.draw.drawing import Drawing, Layer
from plisse.draw.shapes import Line, Text
from plisse.draw.strokes import MACHINE, Stroke
from plisse.fabricate.labels import CHARACTER
from plisse.fabricate.plate_sheets import PlateSheets

__all__ = ["plate_drawings"]

LARGEST = 4.0


def plate_drawings(plan: PlateSheets, *, title: str = "", strokes: Mapping[str, Stroke] = MACHINE) -> list[Drawing]:
    """One drawing per sheet, layers text, bevel and cut: `bevel` is the upper outline, which differs from what is cut."""
    out = []
    for number in range(plan.count):
        cut, bevel, texts = [], [], []
        for k, placement in enumerate(plan.placements):
            if placement.sheet == number:
                upper = placement.apply(plan.upper[k])
                cut.append(Line(placement.apply(plan.outlines[k]), closed=True))
                bevel.append(Line(upper, closed=True))
                texts.append(_number(k + 1, upper))
        place = f"sheet {number + 1} of {plan.count}"
        said = caption((plan.margin, plan.margin + 1.0), plan.material[0] - 2 * plan.margin,
                       [f"{title} · {place} · 1:1" if title else f"{place} · 1:1", place])["text"]
        layers = (Layer("text", tuple(said[0]), (*texts, *said[1]), strokes["text"]),
                  Layer("bevel", tuple(bevel), (), strokes["flat"]), Layer("cut", tuple(cut), (), strokes["cut"]))
        out.append(Drawing(f"{title} {place}".strip(), plan.material, layers))
    return out


def _number(number: int, outline: np.ndarray) -> Text:
    """The number of a plate in its middle, along its longest side, as large as its narrow direction allows."""
    from shapely import Point, Polygon

    plate = Polygon(outline)
    middle = np.array(plate.centroid.coords[0])
    sides = np.roll(outline, -1, axis=0) - outline
    along = sides[np.argmax(np.hypot(*sides.T))]
    angle = float(np.arctan2(along[1], along[0]))
    angle -= np.pi * np.round(angle / np.pi)
    room = plate.exterior.distance(Point(middle))
    height = min(LARGEST, 1.6 * room / np.hypot(1.0, CHARACTER * len(str(number))))
    x, y = (middle + 0.5 * height * np.array([np.sin(angle), -np.cos(angle)])).tolist()
    return Text(str(number), (x, y), float(height), angle, "middle")

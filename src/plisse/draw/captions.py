"""Below a sheet: a scale bar of 100 mm, how mountains and valleys look, and words, as far as there is room."""

from collections.abc import Sequence

import numpy as np

from plisse.draw.shapes import Line, Text
from plisse.fabricate.labels import CHARACTER
from plisse.fabricate.scores import dash_spans

__all__ = ["Caption", "caption"]

BARS = (100.0, 50.0, 20.0, 10.0)
HEIGHT, LINE, GAP, SAMPLE = 2.2, 3.8, 4.0, 16.0

Caption = dict[str, tuple[list[Line], list[Text]]]


def caption(corner: tuple[float, float], width: float, words: Sequence[str],
            folds: dict[str, tuple[float, ...]] | None = None) -> Caption:
    """Lines and texts by layer in a band of `width` mm by 6 mm whose lower left corner is given.

    `words` are the longest caption and shorter ones; the first that fits is taken. `folds` are the dashes of layers to
    explain below it, where there is room.
    """
    x, y = corner
    out: Caption = {"text": ([], [])}
    lines, texts = out["text"]
    bar = next((length for length in BARS if length + _width(f"{length:.0f} mm") + 1 <= width), None)
    if bar is not None:
        lines.append(Line(np.array([[x, y + 3.0], [x, y], [x + bar, y], [x + bar, y + 3.0]])))
        for k in range(1, 10):
            tenth = x + bar * k / 10
            lines.append(Line(np.array([[tenth, y], [tenth, y + (2.2 if k == 5 else 1.2)]])))
        texts.append(Text(f"{bar:.0f} mm", (x + bar + 1.5, y), HEIGHT))
        x += bar + 1.5 + _width(f"{bar:.0f} mm") + GAP
    room = corner[0] + width - x
    said = next((text for text in words if _width(text) <= room), None)
    if said is not None:
        texts.append(Text(said, (x, y + LINE), HEIGHT))
    for name, pattern in (folds or {}).items():
        if SAMPLE + 1.5 + _width(name) > corner[0] + width - x:
            break
        out[name] = ([Line(np.array([[x + a, y + HEIGHT / 2], [x + b, y + HEIGHT / 2]]))
                      for a, b in dash_spans(SAMPLE, pattern).tolist()], [])
        texts.append(Text(name, (x + SAMPLE + 1.5, y), HEIGHT))
        x += SAMPLE + 1.5 + _width(name) + GAP
    return out


def _width(words: str) -> float:
    return CHARACTER * HEIGHT * len(words)

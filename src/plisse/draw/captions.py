"""The line below a sheet: a scale bar of 100 mm, how mountains and valleys look, and words as far as there is room."""

from collections.abc import Sequence

import numpy as np

from plisse.draw.shapes import Line, Text
from plisse.fabricate.labels import CHARACTER
from plisse.fabricate.scores import dash_spans

__all__ = ["Caption", "caption"]

BARS = (100.0, 50.0, 20.0, 10.0)
HEIGHT, GAP, SAMPLE = 2.2, 5.0, 20.0

Caption = dict[str, tuple[list[Line], list[Text]]]


def caption(corner: tuple[float, float], width: float, words: Sequence[str], folds: dict[str, tuple[float, ...]] | None = None) -> Caption:
    """Lines and texts by layer in a band of `width` mm by 6 mm whose lower left corner is given.

    `words` are the longest caption and shorter ones; the first that fits is taken. `folds` are the dashes of layers to
    explain, where there is room for it.
    """
    x, y = corner
    out: Caption = {"text": ([], [])}
    lines, texts = out["text"]
    bar = next((length for length in BARS if length + _width(f"{length:.0f} mm") + 1 <= width), None)
    if bar is not None:
        tenths = np.linspace(0, bar, 11)
        lines.append(Line(np.array([[x, y + 3.0], [x, y], [x + bar, y], [x + bar, y + 3.0]])))
        lines += [Line(np.array([[x + t, y], [x + t, y + (2.2 if k == 5 else 1.2)]])) for k, t in enumerate(tenths) if 0 < k < 10]
        texts.append(Text(f"{bar:.0f} mm", (x + bar + 1.5, y), HEIGHT))
        x += bar + 1.5 + _width(f"{bar:.0f} mm") + GAP
    room = corner[0] + width - x
    legend = sum(SAMPLE + 1.5 + _width(name) + GAP for name in folds or {})
    said = next((text for text in words if _width(text) + legend <= room), None)
    if said is None or not folds:
        said = next((text for text in words if _width(text) <= room), None)
    elif folds:
        for name, pattern in folds.items():
            spans = dash_spans(SAMPLE, pattern)
            out[name] = ([Line(np.array([[x + a, y + HEIGHT / 2], [x + b, y + HEIGHT / 2]])) for a, b in spans.tolist()], [])
            texts.append(Text(name, (x + SAMPLE + 1.5, y), HEIGHT))
            x += SAMPLE + 1.5 + _width(name) + GAP
    if said is not None:
        texts.append(Text(said, (x, y), HEIGHT))
    return out


def _width(words: str) -> float:
    return CHARACTER * HEIGHT * len(words)

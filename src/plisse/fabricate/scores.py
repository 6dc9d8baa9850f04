"""Folds as dashes that a machine draws one by one: mountains and valleys differ without colour too."""

from typing import Literal

import numpy as np

__all__ = ["PATTERNS", "Score", "dash_spans"]

Score = Literal["dashed", "perforated", "solid"]

# lengths on, off, on, off in mm: mountains dash-dotted and valleys dashed, flaps and flat creases dotted
PATTERNS: dict[str, dict[str, tuple[float, ...]]] = {
    "dashed": {"M": (4.0, 1.0, 0.6, 1.0), "V": (2.4, 1.4), "F": (0.5, 1.5), "R": (0.5, 1.0)},
    "perforated": {"M": (2.6, 0.8, 0.6, 0.8), "V": (1.2, 0.9), "F": (0.5, 1.5), "R": (0.5, 1.0)},
    "solid": {"M": (), "V": (), "F": (0.5, 1.5), "R": (0.5, 1.0)},
}


def dash_spans(length: float, pattern: tuple[float, ...]) -> np.ndarray:
    """Start and end (D, 2) of the dashes along a line of that length, which begins and ends with its first dash.

    Gaps and dashes are stretched together so that whole repeats fit; an empty pattern is one dash.
    """
    if not pattern:
        return np.array([[0.0, length]])
    period = sum(pattern)
    repeats = max(0, round((length - pattern[0]) / period))
    if repeats == 0:
        return np.array([[0.0, length]])
    steps = np.concatenate([np.tile(pattern, repeats), pattern[:1]])
    ends = np.cumsum(steps) * (length / steps.sum())
    starts = np.concatenate([[0.0], ends[:-1]])
    return np.stack([starts[::2], ends[::2]], axis=1)

"""One palette for every picture: paper, folds, ink and the scale for quality."""

import numpy as np

__all__ = ["BACKGROUND", "BACK_OF_PAPER", "CAPTION", "EDGE", "INK", "MOUNTAIN", "PAPER", "RULING", "SHADE",
           "UNKNOWN", "VALLEY", "opening", "quality", "rgb"]

BACKGROUND = "#e6e1d8"
PAPER = "#fdf6e7"
BACK_OF_PAPER = "#f3dfc4"
SHADE = "#7f6353"
MOUNTAIN = "#c4452d"
VALLEY = "#1f5288"
RULING = "#8d8271"
EDGE = "#4d463f"
INK = "#2e2a27"
CAPTION = "#7b7268"
UNKNOWN = "#cfc8bb"

# both run from light to dark without turning back, which every eye can tell apart, and a printer too
_OPENINGS = ("#16324f", "#2f5f8a", "#6c9ab5", "#b9ccc0", "#f6ecc9")
_SCALE = ("#f4ead5", "#eec78f", "#dd8f5b", "#b8533f", "#6f2239")


def rgb(colour: str) -> np.ndarray:
    """Red, green and blue (3,) in 0…1 of #rrggbb."""
    return np.array([int(colour[k:k + 2], 16) for k in (1, 3, 5)]) / 255


def quality(values: np.ndarray) -> np.ndarray:
    """Colours (…, 3) of values in 0…1, from pale paper for good to dark red for bad."""
    return _between(_SCALE, values)


def opening(values: np.ndarray) -> np.ndarray:
    """Colours (…, 3) of values in 0…1, from dark blue for closed to pale for open."""
    return _between(_OPENINGS, values)


def _between(colours: tuple[str, ...], values: np.ndarray) -> np.ndarray:
    stops = np.array([rgb(colour) for colour in colours])
    position = np.linspace(0, 1, len(stops))
    return np.stack([np.interp(values, position, stops[:, k]) for k in range(3)], axis=-1)

"""The table on which a preview's papers lie: a soft fall of light and their shadows."""

import numpy as np

from plisse.draw.colours import BACKGROUND, SHADE, rgb

__all__ = ["glow", "table"]

COARSE = 5


def table(size: tuple[int, int], shape: np.ndarray, corner: np.ndarray,
          loops: list[np.ndarray]) -> np.ndarray:
    """Colours (H, W, 3) of the table at a fifth of `size` in pixels, row 0 at the bottom.

    `shape` (h, w) is the coverage in 0…1 of the folded picture, which starts at `corner`; `loops` (N, 2)
    bound the sheet. The folded shape floats a little and throws a wide shadow, the sheet a narrow one.
    """
    from scipy.ndimage import gaussian_filter, shift

    width, height = size[0] // COARSE, size[1] // COARSE
    floating = _stamped((height, width), shape[::COARSE, ::COARSE], corner / COARSE)
    lying = _inside((height, width), loops)
    shadow = (0.42 * gaussian_filter(shift(floating, (-7, 6), order=0), 7)
              + 0.3 * gaussian_filter(shift(lying, (-1, 1), order=0), 2))
    dark = np.clip(shadow, 0, 1)[..., None] * (1 - rgb(SHADE))
    return np.clip(rgb(BACKGROUND) * glow(height, width)[..., None] * (1 - dark), 0, 1)


def glow(height: int, width: int) -> np.ndarray:
    """A soft fall of light over the page (height, width), 1 where it is brightest."""
    y, x = np.mgrid[0:height, 0:width]
    return 0.94 + 0.06 * np.exp(-(((x / width - 0.36) / 0.62) ** 2 + ((y / height - 0.72) / 0.75) ** 2))


def _stamped(size: tuple[int, int], image: np.ndarray, corner: np.ndarray) -> np.ndarray:
    target = np.zeros(size)
    column, row = np.maximum(np.round(corner).astype(int), 0)
    part = target[row:row + image.shape[0], column:column + image.shape[1]]
    part[:] = image[:part.shape[0], :part.shape[1]]
    return target


def _inside(size: tuple[int, int], loops: list[np.ndarray]) -> np.ndarray:
    """1 inside an odd number of loops, 0 elsewhere; long loops are thinned, which a shadow does not show."""
    from matplotlib.path import Path

    row, column = np.mgrid[0:size[0], 0:size[1]]
    centres = (np.column_stack([column.ravel(), row.ravel()]) + 0.5) * COARSE
    inside = np.zeros(len(centres), bool)
    for loop in loops:
        inside ^= Path(loop[:: 1 + len(loop) // 600]).contains_points(centres)
    return inside.reshape(size).astype(float)

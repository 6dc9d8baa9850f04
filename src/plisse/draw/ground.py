"""The ground on which a structure lies: its shadow, and the darkness below it."""

import numpy as np
from scipy.ndimage import gaussian_filter

from plisse.draw.camera import Camera
from plisse.draw.colours import BACKGROUND, rgb
from plisse.draw.light import TILE, Fineness, open_share
from plisse.draw.rays import Occluder, fibonacci_sphere
from plisse.draw.shade import BLUR, SKY_COLOUR, SUN, SUN_COLOUR
from plisse.draw.table import glow, table

__all__ = ["ground"]

STEP = 3
FLATTEST = 0.2  # cosine between ground and view below which the ground is not drawn
WIDER = 4.0  # times the sun's disk, so that what stands high throws no hard shadow
STRENGTH = np.array([0.62, 0.66, 0.70])  # of shadows: the ground throws warm light back
GAP = 0.3  # pixels between the ground and the lowest point


def ground(size: tuple[int, int], coverage: np.ndarray, corner: np.ndarray, triangles: np.ndarray, camera: Camera,
           fineness: Fineness) -> np.ndarray:
    """Colours (H, W, 3) of the ground on a coarser grid than `size` in pixels, row 0 at the bottom.

    `coverage` (h, w) and `triangles` (T, 3, 3) are those of the picture that starts at `corner`, in its pixels. From below
    and from the side there is no ground; without cast rays its shadow is that of something that floats.
    """
    shape = size[1] // STEP, size[0] // STEP
    upright = None if camera.upright is None else camera.project(camera.upright)
    if upright is None or upright[2] < FLATTEST:
        return np.broadcast_to(rgb(BACKGROUND), (*shape, 3)) * glow(*shape)[..., None]
    if not fineness.casts:
        return table(size, coverage, corner, [])
    shadow = _shadow(shape, corner, triangles, upright.astype(np.float32), fineness)
    return rgb(BACKGROUND) * glow(*shape)[..., None] * shadow


def _shadow(shape: tuple[int, int], corner: np.ndarray, triangles: np.ndarray, upright: np.ndarray,
            fineness: Fineness) -> np.ndarray:
    """Share (H, W, 3) of the light that reaches the ground in spite of the structure."""
    lowest = float((triangles @ upright).min()) - GAP
    row, column = (index.ravel() for index in np.mgrid[:shape[0], :shape[1]])
    x, y = (STEP * (index + 0.5) - low for index, low in ((column, corner[0]), (row, corner[1])))
    points = np.stack([x, y, (lowest - upright[0] * x - upright[1] * y) / upright[2]], axis=1).astype(np.float32)
    occluder, cell = Occluder(triangles), row % TILE * TILE + column % TILE
    disk = SUN + WIDER * BLUR * fibonacci_sphere(TILE * TILE * 2 * fineness.sun)
    sun = open_share(occluder, points, disk, cell)
    sky = open_share(occluder, points, fibonacci_sphere(TILE * TILE * fineness.sky), cell,
                     np.broadcast_to(upright, points.shape))
    sun, sky = (gaussian_filter(field.reshape(shape), 2.5)[..., None] for field in (sun, sky))
    direct, dome = SUN_COLOUR * max(float(upright @ SUN), 0.0), SKY_COLOUR
    return 1 - STRENGTH * (1 - np.sqrt((direct * sun + dome * sky) / (direct + dome)))

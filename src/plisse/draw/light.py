"""How much sun and sky reach what a picture shows: by cast rays, or by shadow map and horizons without them."""

from dataclasses import dataclass

import numpy as np

from plisse.draw.denoise import smoothed, spread_out
from plisse.draw.rays import Occluder, can_cast, fibonacci_sphere
from plisse.draw.shade import BLUR, SUN, occlusion, soft, sunlight

__all__ = ["Fineness", "cast_light", "light", "screen_light"]

TILE = 4  # neighbouring pixels look in different directions and share what they see
OFF = 0.35  # pixels off the surface where rays start


@dataclass(frozen=True)
class Fineness:
    """Rays to the sky and to the sun per pixel; the sky is sampled at every `step`-th pixel on both axes.

    `cast` False, or no embree, leaves it to the depth buffer.
    """

    sky: int = 12
    sun: int = 2
    step: int = 2
    cast: bool = True


def light(triangles: np.ndarray, depth: np.ndarray, normals: np.ndarray, block: int,
          fineness: Fineness) -> tuple[np.ndarray, np.ndarray]:
    """Sun and sky (H, W) in 0…1 over pixels of `block` units, seen at `depth` (H, W), −inf outside, with unit `normals`."""
    if fineness.cast and can_cast():
        return cast_light(triangles, depth, normals, block, fineness)
    return screen_light(triangles, depth, normals, block)


def cast_light(triangles: np.ndarray, depth: np.ndarray, normals: np.ndarray, block: int,
               fineness: Fineness) -> tuple[np.ndarray, np.ndarray]:
    """Sun as a disk and sky as a cosine-weighted dome, by rays into the triangles (T, 3, 3)."""
    occluder = Occluder((triangles - [0.5, 0.5, 0.0]) / block)
    mask, flat = np.isfinite(depth), depth / block
    directions = SUN + BLUR * fibonacci_sphere(TILE * TILE * fineness.sun)
    sun = np.zeros(depth.shape, np.float32)
    row, column, origins = _origins(flat, normals, mask, 1)
    lit = (normals[row, column] @ SUN.astype(np.float32)) > 0
    row, column, origins = row[lit], column[lit], origins[lit]
    sun[row, column] = _open(occluder, origins, None, directions, _cell(row, column))
    step = fineness.step
    row, column, origins = _origins(flat, normals, mask, step)
    sky = np.zeros((-(-depth.shape[0] // step), -(-depth.shape[1] // step)), np.float32)
    sky[row // step, column // step] = _open(occluder, origins, normals[row, column],
                                             fibonacci_sphere(TILE * TILE * fineness.sky), _cell(row // step, column // step))
    some = slice(None, None, step)
    sky = smoothed(sky, flat[some, some] / step, normals[some, some], mask[some, some])
    return smoothed(sun, flat, normals, mask), spread_out(sky, step, flat, normals, mask)


def screen_light(triangles: np.ndarray, depth: np.ndarray, normals: np.ndarray, block: int) -> tuple[np.ndarray, np.ndarray]:
    """Sun by a shadow map and sky by horizons in the depth buffer: what can be said without rays."""
    mask = np.isfinite(depth)
    row, column = np.nonzero(mask)
    points = np.stack([column * block + 0.5, row * block + 0.5, depth[row, column]])
    sun = np.zeros(depth.shape, np.float32)
    sun[row, column] = sunlight(triangles, points.astype(np.float32))
    # the sky varies slowly: every second block is enough
    sky = occlusion(depth[::2, ::2] / (2 * block), normals[::2, ::2], radius=0.045 * max(depth.shape))
    sky = sky.repeat(2, axis=0).repeat(2, axis=1)[:depth.shape[0], :depth.shape[1]]
    return soft(sun, mask, 1.2), soft(sky, mask, 1.8)


def _origins(depth: np.ndarray, normals: np.ndarray, mask: np.ndarray, step: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rows and columns of every `step`-th pixel that shows something, and points (N, 3) just off it."""
    row, column = (step * index for index in np.nonzero(mask[::step, ::step]))
    points = np.stack([column, row, depth[row, column]], axis=1).astype(np.float32)
    return row, column, points + np.float32(OFF) * normals[row, column]


def _cell(row: np.ndarray, column: np.ndarray) -> np.ndarray:
    return row % TILE * TILE + column % TILE


def _open(occluder: Occluder, origins: np.ndarray, normals: np.ndarray | None, directions: np.ndarray,
          cell: np.ndarray) -> np.ndarray:
    """Share (N,) of rays that meet nothing: directions of the pixel's cell, about its normal where there is one.

    A unit vector spread evenly over the sphere, added to the normal, is spread by the cosine over the sky.
    """
    fans = directions.reshape(-1, TILE * TILE, 3).swapaxes(0, 1)
    count = fans.shape[1]
    towards = fans[cell]
    if normals is not None:
        towards = towards + np.float32(1.0001) * normals[:, None]
    blocked = occluder.blocked(origins.repeat(count, axis=0), towards.reshape(-1, 3))
    return 1 - blocked.reshape(-1, count).mean(axis=1, dtype=np.float32)

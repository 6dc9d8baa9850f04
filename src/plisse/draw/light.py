"""How much sun and sky reach what a picture shows: by cast rays, or by shadow map and horizons without them."""

from dataclasses import dataclass

import numpy as np

from plisse.draw.denoise import Seen, smoothed
from plisse.draw.rays import Occluder, can_cast, fibonacci_sphere
from plisse.draw.shade import BLUR, SUN, occlusion, soft, sunlight

__all__ = ["TILE", "Fineness", "light", "open_share"]

TILE = 3  # neighbouring pixels look in different directions and share what they see
OFF = 0.1  # pixels off the surface where rays start


@dataclass(frozen=True)
class Fineness:
    """Rays per pixel to the sky and to the sun.

    `cast` False, or no embree, leaves both to the depth buffer, which is faster.
    """

    sky: int = 16
    sun: int = 4
    cast: bool = False

    @property
    def casts(self) -> bool:
        """Whether rays are wanted and can be had."""
        return self.cast and can_cast()


def light(triangles: np.ndarray, seen: Seen, fineness: Fineness) -> tuple[np.ndarray, np.ndarray]:
    """Sun and sky (N,) in 0…1 at pixels, among triangles (T, 3, 3) in pixels."""
    return _cast(triangles, seen, fineness) if fineness.casts else _from_the_screen(triangles, seen)


def _cast(triangles: np.ndarray, seen: Seen, fineness: Fineness) -> tuple[np.ndarray, np.ndarray]:
    """Sun as a disk and sky as a cosine-weighted dome, by rays."""
    occluder = Occluder(triangles)
    chosen, numbers = seen.one_per_pixel()
    known = seen.at(chosen)
    origins = known.points + np.float32(OFF) * known.normals
    cell = known.row % TILE * TILE + known.column % TILE
    values, lit = np.zeros((len(chosen), 2), np.float32), known.normals @ SUN.astype(np.float32) > 0
    disk = SUN + BLUR * fibonacci_sphere(TILE * TILE * fineness.sun)
    values[lit, 0] = open_share(occluder, origins[lit], disk, cell[lit])
    values[:, 1] = open_share(occluder, origins, fibonacci_sphere(TILE * TILE * fineness.sky), cell, known.normals)
    sun, sky = smoothed(values, known, numbers, seen).T
    return sun, sky


def open_share(occluder: Occluder, origins: np.ndarray, directions: np.ndarray, cell: np.ndarray,
               normals: np.ndarray | None = None) -> np.ndarray:
    """Share (N,) of rays that meet nothing, each point in the directions of its cell, about its normal where there is one.

    A unit vector spread evenly over the sphere, added to the normal, is spread by the cosine over the sky.
    """
    fans = directions.astype(np.float32).reshape(-1, TILE * TILE, 3).swapaxes(0, 1)
    count = fans.shape[1]
    towards = fans[cell]
    if normals is not None:
        towards += np.float32(1.0001) * normals[:, None]
    blocked = occluder.blocked(origins.repeat(count, axis=0), towards.reshape(-1, 3))
    return 1 - blocked.reshape(-1, count).mean(axis=1, dtype=np.float32)


def _from_the_screen(triangles: np.ndarray, seen: Seen) -> tuple[np.ndarray, np.ndarray]:
    """Sun by a shadow map and sky by horizons in the depth buffer: what can be said without rays."""
    chosen, _ = seen.one_per_pixel()
    known = seen.at(chosen)
    sun = known.image(sunlight(triangles, np.ascontiguousarray(known.points.T)))
    depth = known.image(known.points[:, 2], -np.inf)
    mask, normals = np.isfinite(depth), np.moveaxis(known.image(known.normals), 0, -1)
    normals[~mask] = [0, 0, 1]
    # the sky varies slowly: every second pixel is enough
    sky = occlusion(depth[::2, ::2] / 2, normals[::2, ::2], radius=0.045 * max(seen.shape))
    sky = sky.repeat(2, axis=0).repeat(2, axis=1)[:seen.shape[0], :seen.shape[1]]
    return soft(sun, mask, 1.2)[seen.row, seen.column], soft(sky, mask, 1.8)[seen.row, seen.column]

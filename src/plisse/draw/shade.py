"""Light on paper: a sun from the upper left with soft shadows, a bright sky, and darkness in the folds."""

import numpy as np
from scipy.ndimage import gaussian_filter

from plisse.draw.colours import BACK_OF_PAPER, PAPER, rgb
from plisse.draw.raster import rasterise
from plisse.geometry.vectors import unit

__all__ = ["BLUR", "SKY_COLOUR", "SUN", "SUN_COLOUR", "occlusion", "paper_colour", "soft", "sunlight"]

SUN = unit(np.array([-0.55, 0.62, 0.66]))
BLUR = 0.07


def paper_colour(normals: np.ndarray, front: np.ndarray, sun: np.ndarray, sky: np.ndarray,
                 colour: np.ndarray | None = None) -> np.ndarray:
    """Colours (N, 3) of points with unit normals (N, 3) towards the viewer.

    `front` says which side of the paper is seen, `sun` and `sky` in 0…1 how much of each reaches the point; `colour`
    (N, 3) stands for the paper's own and is darkened less. Folds are lit by their own walls and paper lets some sun
    through, so shadows stay warm and never black.
    """
    facing = normals @ SUN.astype(np.float32)
    direct = (np.maximum(facing, 0) * sun + 0.16 * np.maximum(-facing, 0))[:, None]
    dome = (sky * (0.9 + 0.1 * normals[:, 1]))[:, None]
    diffuse = dome / (1 - BOUNCE * (1 - dome))
    light = SUN_COLOUR * direct + SKY_COLOUR * diffuse
    tone = np.sqrt(light / (1 + 0.06 * light))
    return _PAPERS[front.astype(np.intp)] * tone if colour is None else colour * (0.45 + 0.55 * tone)


SUN_COLOUR = np.array([0.56, 0.535, 0.48], np.float32)
SKY_COLOUR = np.array([0.50, 0.485, 0.465], np.float32)
BOUNCE = np.array([0.76, 0.70, 0.61], np.float32)  # of sky light that other folds throw back
_PAPERS = np.stack([rgb(BACK_OF_PAPER), rgb(PAPER)]).astype(np.float32)


def occlusion(depth: np.ndarray, normals: np.ndarray, radius: float, directions: int = 8,
              steps: int = 5) -> np.ndarray:
    """How open the sky is (H, W) in 0…1 over a depth map in pixels, by horizons within `radius`."""
    safe = np.where(np.isfinite(depth), depth, -1e6).astype(np.float32)
    up = np.maximum(normals[..., 2], 0.15)
    lost = np.zeros_like(safe)
    distances = radius * (np.arange(1, steps + 1) / steps) ** 2
    for k in range(directions):
        angle = 2 * np.pi * (k + 0.25) / directions
        dx, dy = np.cos(angle), np.sin(angle)
        slope = -(normals[..., 0] * dx + normals[..., 1] * dy) / up
        tangent = slope / np.sqrt(1 + slope * slope)
        worst = np.zeros_like(safe)
        for distance in distances:
            sx, sy = round(distance * dx), round(distance * dy)
            if sx == 0 and sy == 0:
                continue
            rise = _shifted(safe, sx, sy) - safe
            run = np.hypot(sx, sy)
            reach = np.sqrt(rise * rise + run * run)
            fade = np.clip(1.3 - reach / (1.6 * radius), 0, 1)
            np.maximum(worst, (rise / reach - tangent) * fade, out=worst)
        lost += worst
    return np.clip(1 - lost / directions, 0, 1)


def _shifted(image: np.ndarray, sx: int, sy: int) -> np.ndarray:
    """The image moved so that each pixel holds the one sx to its right and sy above, −1e6 beyond the rim."""
    out = np.full_like(image, -1e6)
    height, width = image.shape
    if abs(sx) >= width or abs(sy) >= height:
        return out
    out[max(0, -sy):height - max(0, sy), max(0, -sx):width - max(0, sx)] = \
        image[max(0, sy):height - max(0, -sy), max(0, sx):width - max(0, -sx)]
    return out


def sunlight(triangles: np.ndarray, points: np.ndarray, size: int = 800) -> np.ndarray:
    """Fraction (N,) of the sun's disk that sees points (3, N); triangles (T, 3, 3) in the same frame."""
    samples = 4 if len(triangles) < 60_000 else 2
    total = np.zeros(points.shape[1], np.float32)
    for k in range(samples):
        angle = 2 * np.pi * k / samples
        towards = unit(SUN + BLUR * np.array([np.cos(angle), np.sin(angle), 0]))
        right = unit(np.cross([0.0, 1.0, 0.0], towards))
        axes = np.stack([right, np.cross(towards, right), towards])
        total += _lit(triangles @ axes.T, axes.astype(np.float32) @ points, size)
    return total / samples


def _lit(triangles: np.ndarray, points: np.ndarray, size: int) -> np.ndarray:
    """1 where nothing stands between points (3, N) and the sun, else 0; everything as seen from the sun."""
    low = triangles.min(axis=(0, 1))
    scale = size / (np.ptp(triangles.reshape(-1, 3)[:, :2], axis=0).max() * 1.001)
    depth = rasterise((triangles - low) * scale, size, size).depth
    seen = (points - low[:, None].astype(np.float32)) * np.float32(scale)
    column, row = np.clip(seen[:2].astype(np.int32), 0, size - 1)
    return np.clip(1.5 - (depth[row, column] - seen[2]) / 3, 0, 1)


def soft(image: np.ndarray, mask: np.ndarray, radius: float) -> np.ndarray:
    """The image blurred inside the mask only."""
    weight = gaussian_filter(mask.astype(np.float32), radius)
    return gaussian_filter(np.where(mask, image, 0).astype(np.float32), radius) / np.maximum(weight, 1e-3)

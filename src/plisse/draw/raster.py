"""Hidden surfaces: triangles into a depth buffer, all of them at the same time."""

from dataclasses import dataclass
from functools import reduce
from itertools import product

import numpy as np

__all__ = ["DepthBuffer", "averaged", "rasterise"]

CHUNK = 3_000_000


@dataclass(frozen=True, eq=False)
class DepthBuffer:
    """Per pixel (H, W) from the bottom row up: `depth` to the viewer and `triangle`; −inf and −1 outside."""

    depth: np.ndarray
    triangle: np.ndarray


def rasterise(points: np.ndarray, width: int, height: int) -> DepthBuffer:
    """Depth buffer of triangles (T, 3, 3) given in pixels: x right, y up, z towards the viewer.

    A pixel belongs to the triangle that covers its centre and is nearest to the viewer.
    """
    depth = np.full(width * height, -np.inf, np.float32)
    owner = np.full(width * height, -1, np.int32)
    triangle, row, left, count = _spans(points, width, height)
    plane = depth_planes(points)
    ends = np.cumsum(count)
    for start, stop in _chunks(ends):
        part = slice(start, stop)
        repeats = count[part]
        offset = np.arange(repeats.sum()) - np.repeat(np.cumsum(repeats) - repeats, repeats)
        x = np.repeat(left[part], repeats) + offset
        span = np.repeat(np.arange(start, stop), repeats)
        pixel = row[span] * width + x
        base = plane[triangle[part], 0] + plane[triangle[part], 2] * (row[part] + 0.5)
        slope = plane[triangle[part], 1]
        z = (np.repeat(base, repeats) + np.repeat(slope, repeats) * (x + 0.5)).astype(np.float32)
        np.maximum.at(depth, pixel, z)
        seen = z >= depth[pixel]
        owner[pixel[seen]] = triangle[span[seen]]
    return DepthBuffer(depth.reshape(height, width), owner.reshape(height, width))


def depth_planes(points: np.ndarray, values: np.ndarray | None = None) -> np.ndarray:
    """Coefficients (T, 3) of value = k0 + k1 x + k2 y over triangles, from values (T, 3) at corners, or z."""
    values = points[..., 2] if values is None else values
    a, b, c = points[:, 0, :2], points[:, 1, :2], points[:, 2, :2]
    ab, ac = b - a, c - a
    area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    area = np.where(np.abs(area) < 1e-12, np.inf, area)
    du, dv = values[:, 1] - values[:, 0], values[:, 2] - values[:, 0]
    kx = (du * ac[:, 1] - dv * ab[:, 1]) / area
    ky = (dv * ab[:, 0] - du * ac[:, 0]) / area
    return np.stack([values[:, 0] - kx * a[:, 0] - ky * a[:, 1], kx, ky], axis=1)


def _spans(points: np.ndarray, width: int,
           height: int) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Triangle, row, first column and number of columns of every horizontal run of covered pixel centres."""
    y = points[..., 1]
    low = np.clip(np.ceil(y.min(axis=1) - 0.5), 0, height).astype(np.int64)
    high = np.clip(np.ceil(y.max(axis=1) - 0.5), 0, height).astype(np.int64)
    rows = high - low
    triangle = np.repeat(np.arange(len(points)), rows)
    row = np.repeat(low - np.cumsum(rows) + rows, rows) + np.arange(rows.sum())
    middle = row + 0.5
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for k in range(3):
        (px, py), (qx, qy) = points[:, k, :2].T, points[:, (k + 1) % 3, :2].T
        slope = (qx - px) / np.where(qy == py, np.inf, qy - py)
        start, end = py[triangle], qy[triangle]
        x = (px - py * slope)[triangle] + slope[triangle] * middle
        crosses = (start <= middle) != (end <= middle)
        np.minimum(left, x, out=left, where=crosses)
        np.maximum(right, x, out=right, where=crosses)
    filled = right > left
    first = np.clip(np.ceil(left[filled] - 0.5), 0, width).astype(np.int64)
    last = np.clip(np.ceil(right[filled] - 0.5), 0, width).astype(np.int64)
    some = last > first
    return triangle[filled][some], row[filled][some], first[some], (last - first)[some]


def _chunks(ends: np.ndarray):
    """Ranges of spans that cover about CHUNK pixels each."""
    start = 0
    while start < len(ends):
        done = ends[start - 1] if start else 0
        stop = max(start + 1, int(np.searchsorted(ends, done + CHUNK)))
        yield start, stop
        start = stop


def averaged(image: np.ndarray, block: int) -> np.ndarray:
    """Blocks of pixels (H, W, 4) averaged, colours weighted by opacity."""
    weighted = np.concatenate([image[..., :3] * image[..., 3:], image[..., 3:]], axis=-1)
    # far faster than a mean over two axes
    total = reduce(np.add, (weighted[row::block, column::block] for row, column in product(range(block), repeat=2)))
    colour = total[..., :3] / np.maximum(total[..., 3:], 1e-6)
    return np.concatenate([colour, total[..., 3:] / block**2], axis=-1)

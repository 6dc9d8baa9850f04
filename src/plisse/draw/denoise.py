"""Fields over pixels smoothed within one surface only: not across folds, rims and shadows' owners."""

import numpy as np

__all__ = ["smoothed", "spread_out"]

SAME_SIDE = 0.94


def smoothed(values: np.ndarray, depth: np.ndarray, normals: np.ndarray, mask: np.ndarray, *, reach: tuple[int, int] = (-2, 2),
             slack: float = 1.5) -> np.ndarray:
    """Means (H, W) over the window of pixels from reach[0] up to, not including, reach[1], on both axes.

    Only neighbours count that are in the mask, face the same way and lie in the same plane within `slack`; `depth` (H, W)
    is in pixels, `normals` (H, W, 3) are unit. Where nothing counts the value stays.
    """
    total, weight = np.zeros(values.shape, np.float32), np.zeros(values.shape, np.float32)
    for dy in range(*reach):
        for dx in range(*reach):
            here, there = _windows(values.shape, dy, dx)
            n, m = normals[here], normals[there]
            rise = np.where(mask[there] & mask[here], depth[there] - depth[here], np.inf)
            off = np.abs(n[..., 0] * dx + n[..., 1] * dy + n[..., 2] * rise)
            same = (off < slack) & (np.einsum("ijk,ijk->ij", n, m) > SAME_SIDE)
            total[here] += np.where(same, values[there], 0)
            weight[here] += same
    return np.where(weight > 0, total / np.maximum(weight, 1), values)


def spread_out(coarse: np.ndarray, step: int, depth: np.ndarray, normals: np.ndarray, mask: np.ndarray) -> np.ndarray:
    """Values known at every `step`-th pixel, at all pixels (H, W), taken from known ones on the same surface."""
    nearest = coarse.repeat(step, axis=0).repeat(step, axis=1)[:mask.shape[0], :mask.shape[1]]
    if step == 1:
        return nearest
    total, weight = np.zeros(mask.shape, np.float32), np.zeros(mask.shape, np.float32)
    for oy in range(step):
        for ox in range(step):
            part = (slice(oy, None, step), slice(ox, None, step))
            for ky in (0, 1):
                for kx in (0, 1):
                    there = _known(coarse.shape, part, mask.shape, step, ky, kx)
                    dy, dx = ky * step - oy, kx * step - ox
                    n, m = normals[part], normals[there]
                    rise = np.where(mask[there] & mask[part], depth[there] - depth[part], np.inf)
                    off = np.abs(n[..., 0] * dx + n[..., 1] * dy + n[..., 2] * rise)
                    share = np.where((off < 1.5) & (np.einsum("ijk,ijk->ij", n, m) > SAME_SIDE),
                                     (1 - abs(dy) / step) * (1 - abs(dx) / step), 0)
                    row, column = there
                    total[part] += share * coarse[row // step, column // step]
                    weight[part] += share
    return np.where(weight > 1e-3, total / np.maximum(weight, 1e-3), nearest)


def _known(coarse: tuple[int, ...], part: tuple[slice, slice], shape: tuple[int, ...], step: int, ky: int,
           kx: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of the known pixels ky down and kx right of those in `part`."""
    rows, columns = (np.arange(shape[axis])[part[axis]] // step for axis in (0, 1))
    row = np.minimum(rows + ky, coarse[0] - 1) * step
    column = np.minimum(columns + kx, coarse[1] - 1) * step
    grid = np.broadcast_arrays(row[:, None], column[None])
    return grid[0], grid[1]


def _windows(shape: tuple[int, ...], dy: int, dx: int) -> tuple[tuple[slice, slice], tuple[slice, slice]]:
    """The part of an image that has a neighbour dy up and dx right, and those neighbours."""
    def pair(size: int, by: int) -> tuple[slice, slice]:
        return slice(max(0, -by), size - max(0, by)), slice(max(0, by), size - max(0, -by))

    (y, v), (x, u) = pair(shape[0], dy), pair(shape[1], dx)
    return (y, x), (v, u)

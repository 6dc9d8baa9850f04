"""Values at pixels averaged within one surface only: not across folds and rims."""

from dataclasses import dataclass

import numpy as np

__all__ = ["Seen", "smoothed"]

SAME_SIDE = 0.94  # cosine
SAME_PLANE = 1.5  # pixels


@dataclass(frozen=True, eq=False)
class Seen:
    """Samples in pixels `row`, `column` (N,) of an image of `shape`: `points` (N, 3) in pixels, unit `normals` (N, 3)."""

    shape: tuple[int, int]
    row: np.ndarray
    column: np.ndarray
    points: np.ndarray
    normals: np.ndarray

    def at(self, index: np.ndarray) -> "Seen":
        """Some of the samples."""
        return Seen(self.shape, self.row[index], self.column[index], self.points[index], self.normals[index])

    def image(self, values: np.ndarray, outside: float = 0.0) -> np.ndarray:
        """Values (N, …) as an image (…, H, W); the last sample of a pixel counts."""
        image = np.full((*values.shape[1:], *self.shape), outside, values.dtype)
        image[..., self.row, self.column] = values.T
        return image

    def one_per_pixel(self) -> tuple[np.ndarray, np.ndarray]:
        """Samples (M,) that stand for their pixels, and an image (H, W) of their numbers, −1 where nothing is seen."""
        numbers = self.image(np.arange(len(self.row), dtype=np.int32), -1)
        shown = numbers >= 0
        chosen = numbers[shown]
        numbers[shown] = np.arange(len(chosen), dtype=np.int32)
        return chosen, numbers


def smoothed(values: np.ndarray, known: Seen, numbers: np.ndarray, wanted: Seen) -> np.ndarray:
    """Means (N, k) at wanted samples of values (M, k) known at one sample per pixel, over windows of 3 × 3 pixels.

    Only samples count that face the same way and lie in the same plane; where none does, that of the pixel itself stays.
    `numbers` (H, W) says which sample belongs to a pixel.
    """
    around = np.pad(numbers, 1, constant_values=-1)
    total, weight = np.zeros((len(wanted.row), values.shape[1]), np.float32), np.zeros(len(wanted.row), np.float32)
    for dy in range(3):
        for dx in range(3):
            other = around[wanted.row + dy, wanted.column + dx]
            off = np.abs(np.einsum("ij,ij->i", wanted.normals, known.points[other] - wanted.points))
            facing = np.einsum("ij,ij->i", wanted.normals, known.normals[other])
            same = (other >= 0) & (off < SAME_PLANE) & (facing > SAME_SIDE)
            total += same[:, None] * values[other]
            weight += same
    own = values[numbers[wanted.row, wanted.column]]
    return np.where(weight[:, None] > 0, total / np.maximum(weight, 1)[:, None], own)

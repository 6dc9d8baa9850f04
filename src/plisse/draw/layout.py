"""Where the two pictures of a preview go: as large as fits, the sheet turned to nestle beside the shape."""

from dataclasses import dataclass

import numpy as np

__all__ = ["Layout", "arrange", "dense", "turned"]

BINS = 48
TURNS = np.radians(np.arange(0, 360, 15))
SHIFTS = (0.5, 0.3, 0.7, 0.0, 1.0)
GAP = 0.05
SMALLEST = 0.72


@dataclass(frozen=True, eq=False)
class Layout:
    """Pixels per model unit, the corners (2,) in pixels where each picture starts, the turn of the sheet.

    The sheet is drawn at `scale / reduction`.
    """

    scale: float
    reduction: int
    folded: np.ndarray
    flat: np.ndarray
    turn: float


def dense(line: np.ndarray, between: int = 12) -> np.ndarray:
    """The polyline (N, 2) with points between its vertices, for clouds that must have no holes."""
    share = np.linspace(0, 1, between, endpoint=False)[:, None, None]
    return np.concatenate([(line[:-1] + share * np.diff(line, axis=0)).reshape(-1, 2), line[-1:]])


def turned(points: np.ndarray, angle: float) -> np.ndarray:
    """Points (N, 2) turned counterclockwise by an angle in radians."""
    cosine, sine = np.cos(angle), np.sin(angle)
    return points @ np.array([[cosine, sine], [-sine, cosine]])


def arrange(folded: np.ndarray, flat: np.ndarray | None, low: np.ndarray, high: np.ndarray) -> Layout:
    """Layout of point clouds (N, 2) inside the box from `low` to `high` in pixels.

    The sheet stands to the right; the two may reach into each other's bays but keep a gap. A sheet much
    larger than what it folds into is reduced by a whole number, so that the folded shape stays the picture's
    hero.
    """
    room, size = high - low, np.ptp(folded, axis=0)
    if flat is None:
        scale = float((room / size).min())
        return Layout(scale, 1, low + (room - size * scale) / 2, low, 0.0)
    reduction = max(1, int(np.ceil(SMALLEST * _diameter(flat) / _diameter(folded) - 0.1)))
    flat = flat / reduction
    best, chosen = -1.0, None
    for turn in TURNS:
        sheet = turned(flat, turn)
        tall = np.ptp(sheet, axis=0)
        for shift in SHIFTS:
            lift = shift * (tall[1] - size[1])
            across = _beside(folded, sheet, lift)
            total = np.array([max(across + tall[0], size[0]), max(tall[1], lift + size[1]) - min(0.0, lift)])
            scale = float((room / total).min()) * (1.0 - 0.2 * abs(shift - 0.5))
            if scale > best * 1.0001:
                best, chosen = scale, (turn, lift, across, total)
    assert chosen is not None
    turn, lift, across, total = chosen
    scale = float((room / total).min())
    corner = low + (room - total * scale) / 2
    bottom = -min(0.0, lift)
    shape, sheet = np.array([0, bottom + lift]), np.array([across, bottom])
    return Layout(scale, reduction, corner + shape * scale, corner + sheet * scale, float(turn))


def _beside(folded: np.ndarray, sheet: np.ndarray, lift: float) -> float:
    """Distance from the left edge of the folded picture, raised by `lift`, to that of the sheet."""
    left = folded - folded.min(axis=0) + [0, lift]
    right = sheet - sheet.min(axis=0)
    gap = GAP * (np.ptp(folded, axis=0).max() + np.ptp(sheet, axis=0).max())
    bottom, top = min(0.0, lift), max(left[:, 1].max(), right[:, 1].max())
    bins = lambda y: np.minimum(((y - bottom) / (top - bottom) * BINS).astype(int), BINS - 1)  # noqa: E731
    reach, start = np.full(BINS, -np.inf), np.full(BINS, np.inf)
    np.maximum.at(reach, bins(left[:, 1]), left[:, 0])
    np.minimum.at(start, bins(right[:, 1]), right[:, 0])
    reach = np.max([np.roll(reach, k) for k in range(-3, 4)], axis=0)
    meets = np.isfinite(reach) & np.isfinite(start)
    across = (reach[meets] - start[meets]).max(initial=0.0)
    # never so deep that left and right are lost
    return float(max(across + gap, 0.62 * np.ptp(folded[:, 0])))


def _diameter(points: np.ndarray) -> float:
    return float(np.linalg.norm(points - points.mean(axis=0), axis=1).max())

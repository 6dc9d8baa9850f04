"""Where the camera stands so that what is shown fills the window, and where the sheet lies beside the structure."""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from plisse.draw.camera import Camera
from plisse.geometry.vectors import norm

__all__ = ["FIELD_OF_VIEW", "FILLED", "SEEN", "TINY", "Manner", "SheetPlace", "Stand", "Window", "beside", "is_narrow",
           "seen_by"]

FIELD_OF_VIEW = np.radians(30)
FILLED = 0.9  # of the window
NARROW, BAR = 640, 50  # pixels: windows that are narrower have a bar of this height over their lower end
APART, SMALLEST = 0.08, 0.9
SEEN = 1.02  # how far from the middle, 1 at the rim, still counts as inside the window
TINY = 0.5  # share of the window that counts as too small


@dataclass(frozen=True, eq=False)
class Stand:
    """A camera at `position` (3,) that looks at `middle` (3,)."""

    position: np.ndarray
    middle: np.ndarray

    @property
    def distance(self) -> float:
        """From the camera to what it looks at."""
        return float(norm(self.position - self.middle))

    def nearer(self, near: "Stand", distance: float) -> "Stand":
        """The stand at a distance on the way to a nearer one; this one where it is not farther away than that."""
        if self.distance <= distance:
            return self
        part = (self.distance - distance) / (self.distance - near.distance)
        return Stand((1 - part) * self.position + part * near.position, (1 - part) * self.middle + part * near.middle)


def seen_by(camera) -> Camera:
    """The view that a client's camera has."""
    return Camera.looking_from(camera.position - camera.look_at, camera.up_direction)


def is_narrow(camera) -> bool:
    """Whether the window of a client's camera is that of a phone."""
    return camera.image_width < NARROW


@dataclass(frozen=True)
class Window:
    """A window with its width over its height, and the share of its height that is covered at the bottom."""

    aspect: float
    covered: float = 0.0

    @classmethod
    def of(cls, camera) -> "Window":
        """The window of a client's camera: on a phone a bar at the bottom covers a part of it."""
        return cls(camera.aspect, BAR / camera.image_height if is_narrow(camera) else 0.0)

    @property
    def slopes(self) -> np.ndarray:
        """Tangents (2,) of half its angles, to the right and up."""
        return np.tan(0.5 * FIELD_OF_VIEW) * np.array([self.aspect, 1.0])

    def stand(self, points: np.ndarray, axes: np.ndarray) -> Stand:
        """The nearest camera with `axes` (3, 3): right, up, towards the viewer, that has all points (N, 3) well inside."""
        seen, above = points @ axes.T, FILLED * self.slopes
        below = above * [1, 1 - 2 * self.covered]
        high, low = (seen[:, :2] + above * seen[:, 2:]).max(axis=0), (seen[:, :2] - below * seen[:, 2:]).min(axis=0)
        away = ((high - low) / (above + below)).max()
        across, depth = 0.5 * (high + low + (below - above) * away), 0.5 * (seen[:, 2].min() + seen[:, 2].max())
        return Stand(np.array([*across, away]) @ axes, np.array([*across, depth]) @ axes)

    def reach(self, points: np.ndarray, camera) -> float:
        """How far points (N, 3) reach from the middle of the window as `camera` stands, 1 at the rim; infinite behind it."""
        places = self._places(points, camera)
        return np.inf if places is None else float(np.abs(places).max())

    def share(self, points: np.ndarray, camera) -> float:
        """How much of the window's width or height points (N, 3) take as `camera` stands; infinite behind it."""
        places = self._places(points, camera)
        return np.inf if places is None else float(0.5 * np.ptp(places, axis=0).max())

    def _places(self, points: np.ndarray, camera) -> np.ndarray | None:
        """Places (N, 2) in the window, −1 to 1 from rim to rim; None where some are behind the camera."""
        seen = seen_by(camera).project(points - camera.position)
        return None if seen[:, 2].max() >= 0 else seen[:, :2] / -seen[:, 2:] / self.slopes


@dataclass(frozen=True, eq=False)
class SheetPlace:
    """Where the sheet lies: its origin (3,), its scale, and its x, y and z axes (3, 3) in space."""

    origin: np.ndarray
    scale: float
    axes: np.ndarray

    @property
    def turn(self) -> np.ndarray:
        """The quaternion (w, x, y, z) that takes the axes of space to its own."""
        return Rotation.from_matrix(self.axes.T).as_quat()[[3, 0, 1, 2]]

    def placed(self, points: np.ndarray) -> np.ndarray:
        """Points (…, 2) or (…, 3) of the sheet in space."""
        return self.origin + self.scale * points @ self.axes[:points.shape[-1]]


class Manner(NamedTuple):
    """How the sheet lies: below the structure or to its right, turned by a right angle, smaller than it need be."""

    below: bool = False
    turned: bool = False
    reduced: bool = False


def beside(folded: np.ndarray, flat: np.ndarray, axes: np.ndarray, manner: Manner) -> SheetPlace:
    """The sheet, points (M, 2), beside a structure, points (N, 3), as seen with `axes`.

    It is reduced by a whole number where it is much larger than the structure.
    """
    right, up, towards = axes
    own = np.stack([up, -right, towards]) if manner.turned else axes
    seen, size = folded @ axes.T, np.ptp(flat, axis=0)
    low, high = seen.min(axis=0), seen.max(axis=0)
    room = float(norm(high - low))
    scale = 1 / (max(1, np.ceil(SMALLEST * float(norm(size)) / room - 0.1)) + manner.reduced)
    sheet = scale * flat @ (own[:2] @ axes[:2].T)
    least, most = sheet.min(axis=0), sheet.max(axis=0)
    corner = 0.5 * (low + high)
    corner[:2] -= 0.5 * (least + most)
    if manner.below:
        corner[1] = low[1] - APART * room - most[1]
    else:
        corner[0] = high[0] + APART * room - least[0]
    return SheetPlace(corner @ axes, float(scale), own)

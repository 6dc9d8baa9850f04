"""Is a structure regular? A cheap look at sector angles, openings and inverted faces."""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.components import cross, dot, norm, unit

__all__ = ["Regularity", "regularity"]

_SECTOR, _OPENING = 5.0, (2.0, 178.0)  # degrees


@dataclass(frozen=True)
class Regularity:
    """Smallest sector angle, range of crease openings (degrees) and number of faces that are not convex."""

    sector: float
    opening: tuple[float, float]
    inverted: int

    @property
    def message(self) -> str:
        """Why the structure is not regular; empty if it is."""
        if not np.isfinite(self.sector):
            return "the march broke down: rulings meet the creases tangentially or strips cross"
        if self.inverted:
            return f"{self.inverted} faces are turned over"
        if self.sector < _SECTOR:
            return f"sector angles fall to {self.sector:.1f}°"
        if self.opening[0] < _OPENING[0] or self.opening[1] > _OPENING[1]:
            return f"opening angles range from {self.opening[0]:.1f}° to {self.opening[1]:.1f}°"
        return ""


def regularity(creases: np.ndarray, closed: bool) -> Regularity:
    """Judge creases (m, 3, n)."""
    if not np.isfinite(creases).all():
        return Regularity(np.nan, (np.nan, np.nan), 0)
    points = np.concatenate([creases, creases[..., :1]], axis=2) if closed else creases
    points = np.moveaxis(points, 1, 0)
    corners = points[:, :-1, :-1], points[:, :-1, 1:], points[:, 1:, 1:], points[:, 1:, :-1]
    with np.errstate(all="ignore"):
        normals = unit(cross(corners[2] - corners[0], corners[3] - corners[1]))
        sides = [corners[(k + 1) % 4] - corners[k] for k in range(4)]
        products = [cross(side, -sides[k - 1]) for k, side in enumerate(sides)]
        angles = [np.arctan2(norm(x), dot(side, -sides[k - 1])) for k, (x, side) in
                  enumerate(zip(products, sides, strict=True))]
        inverted = np.any([~(dot(x, normals) > 0) for x in products], axis=0)
        folds = np.arctan2(norm(cross(normals[:, 1:], normals[:, :-1])), dot(normals[:, 1:], normals[:, :-1]))
    openings = 180 - np.degrees(folds)
    return Regularity(float(np.degrees(np.min(angles))), (float(openings.min()), float(openings.max())),
                      int(inverted.sum()))

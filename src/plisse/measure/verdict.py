"""The judgement by which attempts are compared; `assess` gives the final status with the same limits and more."""

from dataclasses import dataclass, replace

import numpy as np

from plisse.measure.regularity import Regularity
from plisse.measure.shape import Shape

__all__ = ["EXACT", "FAR", "Verdict", "judge"]

EXACT = 1e-9
COMFORTABLE_SECTOR = np.radians(15.0)
NEAR, FAR = 1.2, 2.5
PROMISING = 1e-3  # defect of a coarse level from which finer ones become exact


@dataclass(frozen=True)
class Verdict:
    """Defects (largest values), regularity, and largest deviation from the guides in amplitudes."""

    planarity: float
    angle: float
    principal: float
    regularity: Regularity
    deviation: float

    @property
    def defect(self) -> float:
        """The largest of the defects asked for."""
        return max(self.planarity, self.angle, self.principal)

    @property
    def is_exact(self) -> bool:
        """Whether all defects asked for are within 1e-9."""
        return self.defect <= EXACT

    @property
    def is_sound(self) -> bool:
        """Exact and regular, wherever it lies."""
        return self.is_exact and self.regularity.is_regular

    @property
    def is_good(self) -> bool:
        """Exact, regular, and near its guides."""
        return self.is_sound and self.deviation < FAR

    @property
    def is_comfortable(self) -> bool:
        """So good that no other way needs to be tried."""
        return self.is_good and self.has_wide_sectors and self.deviation < NEAR

    @property
    def has_wide_sectors(self) -> bool:
        """Whether larger sector angles would be no better."""
        return self.regularity.min_sector > COMFORTABLE_SECTOR

    @property
    def rank(self) -> tuple:
        """Sort key: exactness, regularity, nearness, then the smallest sector angle up to comfort."""
        sector = min(self.regularity.min_sector, COMFORTABLE_SECTOR)
        return (self.is_good, self.is_sound, self.is_exact,
                self.is_comfortable, sector if self.is_exact else -self.defect, -self.deviation)

    def promises_more_than(self, other: "Verdict") -> bool:
        """Whether what is nearly exact would, if it were exact, be better than another."""
        return self.defect <= PROMISING and replace(self, planarity=0.0, angle=0.0, principal=0.0).rank > other.rank


def judge(shape: Shape, *, principal: bool, deviation: float) -> Verdict:
    """Verdict on a shape; the principal defect counts only where it is asked for."""
    return Verdict(
        float(shape.planarity.max()),
        float(np.abs(shape.angle).max()),
        float(shape.principal.max()) if principal else 0.0,
        shape.regularity,
        deviation,
    )

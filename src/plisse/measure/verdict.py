"""The judgement by which attempts are compared; `assess` gives the final status with the same limits and more."""

from dataclasses import dataclass

import numpy as np

from plisse.measure.regularity import Regularity
from plisse.measure.shape import Shape

__all__ = ["EXACT", "FAR", "Verdict", "judge"]

EXACT = 1e-9
COMFORTABLE_SECTOR = np.radians(15.0)
NEAR, FAR = 1.2, 2.5


@dataclass(frozen=True)
class Verdict:
    """Defects (largest values), regularity, and largest deviation from the guides in amplitudes."""

    planarity: float
    angle: float
    principal: float
    regularity: Regularity
    deviation: float

    @property
    def is_exact(self) -> bool:
        """Whether all defects asked for are within 1e-9."""
        return max(self.planarity, self.angle, self.principal) <= EXACT

    @property
    def is_good(self) -> bool:
        """Exact, regular, and near its guides."""
        return self.is_exact and self.regularity.is_regular and self.deviation < FAR

    @property
    def is_comfortable(self) -> bool:
        """So good that no other way needs to be tried."""
        return self.is_good and self.regularity.min_sector > COMFORTABLE_SECTOR and self.deviation < NEAR

    @property
    def rank(self) -> tuple:
        """Sort key: exactness, regularity, nearness, then the smallest sector angle up to comfort."""
        sector = min(self.regularity.min_sector, COMFORTABLE_SECTOR)
        defect = max(self.planarity, self.angle, self.principal)
        return (self.is_good, self.is_exact and self.regularity.is_regular, self.is_exact,
                self.is_comfortable, sector if self.is_exact else -defect, -self.deviation)


def judge(shape: Shape, *, principal: bool, deviation: float) -> Verdict:
    """Verdict on a shape; the principal defect counts only where it is asked for."""
    return Verdict(
        float(shape.planarity.max()),
        float(np.abs(shape.angle).max()),
        float(shape.principal.max()) if principal else 0.0,
        shape.regularity,
        deviation,
    )

"""The zigzag start M1: guiding curves moved off the surface in turn (§3.3, Fig. 11)."""

import numpy as np

from plisse.structure.pattern import Pattern
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["zigzag", "zigzag_curves"]


def zigzag_curves(pattern: Pattern, amplitude: float) -> np.ndarray:
    """Guiding curves (m, n, 3) moved by −d, +d, −d, … along their binormals."""
    side = np.where(np.arange(pattern.creases) % 2, 1.0, -1.0)
    return pattern.curves + amplitude * side[:, None, None] * pattern.binormals


def zigzag(pattern: Pattern, amplitude: float, topology: Topology | None = None) -> PleatedStructure:
    """The creased mesh M1 over a pattern, neither planar nor developable yet; `amplitude` d in model units.

    The `topology` is that of the pattern, where it is at hand.
    """
    return PleatedStructure(topology or pattern.topology, zigzag_curves(pattern, amplitude).reshape(-1, 3))

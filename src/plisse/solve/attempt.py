"""Where a solver starts and what an attempt comes to."""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from plisse.solve.workspace import Workspace
from plisse.solve.zigzag import zigzag_curves
from plisse.structure.pattern import Pattern
from plisse.structure.topology import Topology

__all__ = ["Attempt", "Start"]


@dataclass(frozen=True, eq=False)
class Start:
    """A pattern (at its own resolution), the amplitude d, the number of samples wanted, and the property wanted.

    Starts that share a `workspace` share topologies and sparsity patterns.
    """

    pattern: Pattern
    amplitude: float
    samples: int
    principal: bool = False
    label: str = ""
    workspace: Workspace = field(default_factory=Workspace)

    @cached_property
    def topology(self) -> Topology:
        """The grid of the structure wanted."""
        return self.grid(self.samples)

    def grid(self, samples: int) -> Topology:
        """The same grid with another number of samples."""
        return self.workspace.grid(self.pattern.creases, samples, self.pattern.closed, self.pattern.closed_family)

    def guides(self, samples: int) -> np.ndarray:
        """Zigzag curves (m, samples, 3) that the creases should follow, in model units."""
        return zigzag_curves(self.pattern.resampled(samples), self.amplitude)


@dataclass(frozen=True, eq=False)
class Attempt:
    """One way's result: vertices (V, 3) in model units, or None with a message why there is none."""

    method: str
    vertices: np.ndarray | None
    message: str = ""
    iterations: int = 0
    history: tuple[float, ...] = ()

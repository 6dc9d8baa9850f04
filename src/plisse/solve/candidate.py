"""A layout over a whole surface, what came of it, and how it ranks among others (§3.1).

Coverage at full regularity counts first, then nearness, then opening angles that one can fold and upright pleats.
"""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.mesh import ReferenceMesh
from plisse.layout.automatic import Layout
from plisse.layout.rows import ChartedSurface
from plisse.measure.mid_surface import MidSurfaceDeviation
from plisse.solve.masked import Masked
from plisse.structure.topology import Topology

__all__ = ["FARNESS", "FARNESS_APART", "FULL", "PARTED", "Candidate", "centre_of", "holes_of"]

FULL = 0.995  # coverage that is as good as all
FARNESS, FARNESS_APART = 0.04, 0.01  # coverage that one amplitude of mean deviation is worth, in one piece or in more
TORN = 0.003  # coverage that a hole costs: the sheet must be cut up to it
PARTED = 0.0005  # coverage that a seam costs
LEANING = 0.02  # coverage that it costs if all faces overhang where pleats shall be upright
NEAR = 0.3  # mean deviation in amplitudes below which nothing more is asked for
COMFORTABLE = {"sector": 20.0, "opening": 30.0}  # degrees above which larger angles are no better


@dataclass(frozen=True, eq=False)
class Candidate:
    """A layout and what came of it: coverage, deviation of the mid-surface, smallest angles in radians.

    `holes` are those that the reference has not, `overhanging` is the fraction of faces that lean beyond the surface
    normal, which costs a little where pleats shall be `upright`.
    """

    layout: Layout
    solved: Masked
    coverage: float
    deviation: MidSurfaceDeviation
    least_opening: float
    least_sector: float
    holes: int = 0
    overhanging: float = 0.0
    upright: bool = False

    @property
    def seams(self) -> tuple[int, ...]:
        """Columns along which the sheet is cut apart."""
        return self.solved.grid.seams

    @property
    def mean_deviation(self) -> float:
        """Mean deviation in amplitudes."""
        return self.deviation.mean / self.layout.sizes.amplitude

    @property
    def rank(self) -> tuple[bool, float]:
        """Sort key: soundness, then coverage and nearness weighed against each other, with a little for openness.

        Seams are there for coverage, so nearness weighs less where there are some.
        """
        ease = sum(min(np.degrees(angle) / COMFORTABLE[name], 1.0)
                   for name, angle in (("sector", self.least_sector), ("opening", self.least_opening)))
        farness = FARNESS_APART if self.seams else FARNESS
        lost = farness * self.mean_deviation + TORN * self.holes + PARTED * len(self.seams)
        lost += LEANING * self.overhanging * self.upright
        return self.solved.is_sound, min(self.coverage, FULL) - lost + 0.005 * ease

    @property
    def lack(self) -> float:
        """How much coverage could be gained, holes counted; infinite where nothing sound was found."""
        return max(FULL - self.coverage, 0.0) + TORN * self.holes if self.solved.is_sound else np.inf

    @property
    def is_full(self) -> bool:
        """Whether nothing is left to be covered."""
        return self.solved.is_sound and self.coverage >= FULL and self.holes == 0

    @property
    def is_done(self) -> bool:
        """Whether nothing is left to be covered or brought nearer."""
        return self.is_full and self.mean_deviation < NEAR


def centre_of(candidate: Candidate, surface: ChartedSurface) -> np.ndarray | None:
    """The point (3,) around which the rows of a candidate run.

    None where they run around none, or where no point stands for it because the surface does not reach there.
    """
    place = candidate.layout.centre
    if place is None:
        return None
    point = surface.to_space(np.array([[*place, 0.0]]))
    return point[0] if np.allclose(surface.to_plane(point)[0, :2], place, atol=1e-6 * surface.diagonal) else None


def holes_of(topology: Topology, mesh: ReferenceMesh) -> int:
    """How many more holes a connected structure has than the reference."""
    return max(1 - topology.euler_characteristic - max(len(mesh.boundary_loops) - 1, 0), 0)

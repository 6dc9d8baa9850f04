"""A pleated structure: folded vertices and their development over one topology (§2.3, §3.4)."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from plisse.errors import InvalidStructure
from plisse.structure.cut import Cut, uncut
from plisse.structure.topology import Topology

__all__ = ["PleatedStructure"]


@dataclass(frozen=True, eq=False)
class PleatedStructure:
    """Folded `vertices` (V, 3) over a topology, and `development` (V', 2) over the topology cut open.

    For structures that need no cut V' = V and `cut` is trivial; `development` is None until it is computed.
    Lengths are in model units. Raises InvalidStructure when shapes do not fit or coordinates are not finite.
    """

    topology: Topology
    vertices: np.ndarray
    cut: Cut = field(default=None)  # type: ignore[assignment]
    development: np.ndarray | None = None

    def __post_init__(self):
        vertices = np.ascontiguousarray(self.vertices, dtype=float)
        object.__setattr__(self, "vertices", vertices)
        if self.cut is None:
            object.__setattr__(self, "cut", uncut(self.topology))
        if vertices.shape != (self.topology.vertex_count, 3):
            raise InvalidStructure(f"expected {self.topology.vertex_count} vertices with three coordinates, "
                                   f"found an array of shape {vertices.shape}")
        if not np.isfinite(vertices).all():
            bad = int(np.argmin(np.isfinite(vertices).all(axis=1)))
            raise InvalidStructure(f"vertex {bad} has a coordinate that is not a finite number")
        if self.development is not None and self.development.shape != (len(self.cut.source), 2):
            raise InvalidStructure(f"the development has shape {self.development.shape}, "
                                   f"expected ({len(self.cut.source)}, 2)")

    @cached_property
    def opened(self) -> "PleatedStructure":
        """The same structure cut open: one vertex per vertex of the development, coincident along the cut."""
        if self.cut.is_trivial:
            return self
        return PleatedStructure(self.cut.topology, self.vertices[self.cut.source], development=self.development)

    @cached_property
    def mean_edge(self) -> float:
        """Mean length of all edges, in model units."""
        a, b = self.topology.edges.vertices.T
        return float(np.linalg.norm(self.vertices[a] - self.vertices[b], axis=1).mean())

    @property
    def diagonal(self) -> float:
        """Diagonal of the bounding box, in model units."""
        return float(np.linalg.norm(np.ptp(self.vertices, axis=0)))

    def with_vertices(self, vertices: np.ndarray) -> "PleatedStructure":
        """The same topology with other vertices (V, 3), not yet developed."""
        return replace(self, vertices=vertices, development=None)

"""A pleated structure: folded vertices and their development over one topology (§2.3, §3.4)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from plisse.errors import InvalidStructure
from plisse.structure.cut import Cut, uncut
from plisse.structure.topology import Topology

if TYPE_CHECKING:
    from trimesh import Trimesh

    from plisse.fabricate.plan import Sheets
    from plisse.transform.arrangement import Arrangement
    from plisse.transform.flex import Motion
    from plisse.transform.plates import Plates

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

    def flex(self, percent) -> "Motion":
        """The motion of a principal structure at one percent or several: 0 flat, 100 as it is, 200 folded flat (§2.5).

        Raises InvalidStructure for structures that are not principal, InvalidDesign for percents outside the range.
        """
        from plisse.transform.flex import flex

        return flex(self, percent)

    def offset(self, distance: float) -> "PleatedStructure":
        """The principal structure whose faces lie at `distance` (model units) from these, edges parallel (§2.4, Fig. 9).

        Raises InvalidStructure for structures that are not principal, InvalidDesign beyond the largest distance.
        """
        from plisse.transform.offset import offset

        return offset(self, distance)

    def plates(self, thickness: float, *, gap: float = 0.0, side: Literal["inner", "outer", "both"] = "outer",
               hinged: bool = False) -> "Plates":
        """A solid plate on every face of a principal structure, mitred, or square on a film (§2.4, Figs 9 and 26).

        Raises InvalidStructure for structures that are not principal, InvalidDesign for a thickness or gap too large.
        """
        from plisse.transform.plates import plates

        return plates(self, thickness, gap=gap, side=side, hinged=hinged)

    def sheets(self, *, material: tuple[float, float] = (600.0, 300.0), **options) -> "Sheets":
        """The development as pieces that overlap nowhere, nested on sheets of `material` (width, height) mm (Figs 19, 27).

        Options and errors are those of plisse.fabricate.sheets.
        """
        from plisse.fabricate.plan import sheets

        return sheets(self, material=material, **options)

    def parallel(self, *, lengths=None, widths=None, growth: float | None = None, positions=None,
                 handles: Mapping | None = None, least_scale: float = 0.05) -> "PleatedStructure":
        """A parallel structure: edges keep their directions, the sheet stays exact, and principal if it is (§2.3, Fig. 7).

        Either factors `lengths` and `widths` along the first crease and zigzag of rulings, or the `growth` of a spiral, or
        what is nearest to `positions` (V, 3) and `handles` {(crease, point): [x, y, z]} with edge scales of at least
        `least_scale`. Raises Infeasible where edges would turn round.
        """
        from plisse.transform.parallel import parallel

        return parallel(self, lengths=lengths, widths=widths, growth=growth, positions=positions, handles=handles,
                        least_scale=least_scale)

    def refine_fold(self, crease: int, *, fraction: float = 1 / 3, at: float | None = None) -> "PleatedStructure":
        """The structure with one fold, number `crease` in `topology.creases`, replaced by three, locally (§2.3, Fig. 7).

        New creases lie at `fraction` of the strips beside it, where they are narrowest or at the position `at` in [0, 1]
        along the crease. Raises Infeasible where they have no room.
        """
        from plisse.transform.refine_fold import refine_fold

        return refine_fold(self, crease, fraction=fraction, at=at)

    def strips(self, width: float, *, side: Literal["both", "above", "below"] = "both",
               creases: Sequence[int] | None = None) -> "Arrangement":
        """Rectifying strips along the creases, exact developables that unfold straight (Fig. 6)."""
        from plisse.transform.arrangement import strips_along_creases

        return strips_along_creases(self, width, side=side, creases=creases)

    def to_fold(self, *, title: str = "", units: str = "mm") -> dict:
        """The structure as a FOLD 1.2 document of plain lists; raises InvalidStructure where there is no development."""
        from plisse.io.fold import fold_document

        return fold_document(self, title=title, units=units)

    def to_trimesh(self) -> "Trimesh":
        """The folded structure as a trimesh.Trimesh: the same vertices, faces in triangles.

        `face_attributes["face"]` says which face of the topology a triangle belongs to.
        """
        from trimesh import Trimesh

        from plisse.structure.triangles import triangulated

        faces, owner = triangulated(self.topology)
        return Trimesh(self.vertices, faces, face_attributes={"face": owner}, process=False)

    def plot(self, ax=None, *, flat: bool = False):
        """The matplotlib axes with the folded structure (3D axes) or its flat sheet (plane axes, or `flat`) on them.

        Without axes a figure is made. Raises InvalidStructure for the sheet of a structure without development.
        """
        from plisse.draw.axes import plot

        return plot(self, ax, flat=flat)

    def _repr_html_(self) -> str:
        """A few numbers and a picture, for notebooks."""
        from plisse.draw.notebook import structure_html

        return structure_html(self)

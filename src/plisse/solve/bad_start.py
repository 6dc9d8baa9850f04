"""The start that fails (Fig. 25): evenly spaced curves moved along surface normals, whatever their osculating planes.

In a fold both strips make the same angle with the osculating plane of the crease, so their bisector is orthogonal to it:
the binormal. A zigzag along surface normals has the wrong bisectors wherever curves are no asymptotic curves. Then
functional (5) comes near exactness with strong fairness, which straightens the creases (a), or closeness leaves
defects (b). Straightening alone proves nothing: the same weights straighten good starts too. What tells them apart is
that with little fairness a good start becomes exact near its surface, and this one does not.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.errors import Infeasible
from plisse.geometry.frames import curvature_vectors
from plisse.geometry.vectors import dot, norm, unit
from plisse.layout.automatic import Sizes, meeting
from plisse.layout.columns import woven
from plisse.layout.coverage import AreaSamples
from plisse.layout.rows import ChartedSurface, Rows
from plisse.measure.planarity import planarity_defect
from plisse.measure.sectors import angle_defect
from plisse.solve.energies import Guides
from plisse.solve.masked import FEWEST_QUADS, MaskedGrid
from plisse.solve.paper import PaperSolution, solve_paper
from plisse.structure.cut import Cut
from plisse.structure.masks import cleaned
from plisse.structure.pattern import Pattern
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology

__all__ = ["BadStart", "NormalStart", "bisector_angles", "bow", "fail_both_ways", "normal_start",
           "normals_over", "pattern_start", "surface_start"]

# λ1 … λ5 of outcome (a): the fairness straightens good starts as well, but these become exact without it
EXACTLY = (100.0, 1e-3, 1000.0, 100.0, 0.0)
CLOSELY = (10.0, 1e3, 100.0, 0.1, 0.0)  # and of outcome (b)
ITERATIONS = 40, 10  # after more, (b) slides off too: E_close lets creases move along themselves and out of their planes


@dataclass(frozen=True, eq=False)
class NormalStart:
    """A zigzag along surface normals: the structure, neither planar nor developable, and `normals` (V, 3)."""

    structure: PleatedStructure
    normals: np.ndarray
    amplitude: float


@dataclass(frozen=True, eq=False)
class BadStart:
    """What becomes of a start along normals: `straightened` is outcome (a), `held` outcome (b) of Fig. 25.

    `angles` (N,) in radians lie between bisectors and osculating planes at the inner vertices of the creases.
    """

    start: NormalStart
    angles: np.ndarray
    straightened: PaperSolution
    held: PaperSolution

    @cached_property
    def straightness(self) -> tuple[float, float]:
        """Mean bow of the creases over their chord at the start and in outcome (a)."""
        topology = self.start.structure.topology
        return bow(topology, self.start.structure.vertices), bow(topology, self.straightened.vertices)

    def departure(self, found: PaperSolution) -> float:
        """Mean distance of the mid-surface from where it started, along the normals, in amplitudes."""
        topology = self.start.structure.topology
        p, q = topology.edges.vertices[~topology.edges.is_crease].T
        shift = found.vertices - self.start.structure.vertices
        along = unit(self.start.normals[p] + self.start.normals[q])
        return float(np.abs(dot(0.5 * (shift[p] + shift[q]), along)).mean()) / self.start.amplitude

    def defects(self, found: PaperSolution) -> tuple[float, float]:
        """Largest planarity and angle defect."""
        topology = self.start.structure.topology
        return (float(planarity_defect(topology, found.vertices).max()),
                float(np.abs(angle_defect(topology, found.vertices)).max()))

    @property
    def diagnosis(self) -> str:
        """One sentence with numbers."""
        degrees = np.degrees(self.angles)
        before, after = self.straightness
        away = self.departure(self.straightened)
        return ("the start moves evenly spaced curves along surface normals, and the bisectors of its zigzag make "
                f"{degrees.mean():.0f}° on average (from {degrees.min():.0f}° to {degrees.max():.0f}°) with the osculating "
                f"planes of the creases where folds need 90°: strong fairness brings angle defects down to "
                f"{self.defects(self.straightened)[1]:.1g} but leaves creases with {100 * after / before:.0f} % of their "
                f"bow, {away:.1f} amplitudes off the surface on average, and holding them leaves angle defects of "
                f'{self.defects(self.held)[1]:.2g}; leave out initial = "normal"')


def normals_over(curves: np.ndarray, closed: bool = False) -> np.ndarray:
    """Unit normals (m, n, 3) of the surface that curves (m, n, 3) sweep."""
    along = 0.5 * (np.roll(curves, -1, axis=1) - np.roll(curves, 1, axis=1)) if closed else np.gradient(curves, axis=1)
    return unit(np.cross(along, np.gradient(curves, axis=0)))


def normal_start(curves: np.ndarray, normals: np.ndarray, amplitude: float, *, closed: bool = False,
                 mask: np.ndarray | None = None) -> NormalStart:
    """Curves (m, n, 3) moved by −d, +d, −d, … along normals (m, n, 3), on the quads of a mask.

    Raises Infeasible when fewer than 30 quads are left.
    """
    creases, columns = curves.shape[:2]
    mask = np.ones((creases - 1, columns if closed else columns - 1), bool) if mask is None else cleaned(mask, closed)
    if mask.sum() < FEWEST_QUADS:
        raise Infeasible(f"evenly spaced curves meet the surface in {int(mask.sum())} quads only; choose a smaller width")
    part = MaskedGrid.of((creases, columns), closed, mask)
    side = np.where(np.arange(creases) % 2, amplitude, -amplitude)[:, None, None]
    vertices = (curves + side * normals).reshape(-1, 3)[part.used]
    return NormalStart(PleatedStructure(part.topology, vertices), normals.reshape(-1, 3)[part.used], amplitude)


def pattern_start(pattern: Pattern, amplitude: float) -> NormalStart:
    """The start along normals over the curves of a pattern; its tilted binormals are not used."""
    return normal_start(pattern.curves, normals_over(pattern.curves, pattern.closed), amplitude, closed=pattern.closed)


def surface_start(surface: ChartedSurface, samples: AreaSamples, rows: Rows, sizes: Sizes) -> NormalStart:
    """The start along normals over evenly spaced rows of a surface, where these meet it."""
    net = woven(rows, np.zeros_like(rows.radii), surface, sizes.column * sizes.width)
    mask = meeting(net, samples, sizes, grow=0)
    return normal_start(net.points, net.normals, sizes.amplitude, closed=net.closed, mask=mask)


def fail_both_ways(start: NormalStart, *, exactly: Sequence[float] = EXACTLY, closely: Sequence[float] = CLOSELY,
                   iterations: tuple[int, int] = ITERATIONS, cut: Cut | None = None) -> BadStart:
    """Both outcomes of Fig. 25 with functional (5), weights λ1 … λ5 `exactly` and `closely`; closed creases need a cut."""
    topology, vertices = start.structure.topology, start.structure.vertices
    guides = Guides.along_creases(topology, vertices)
    straightened, held = (solve_paper(topology, vertices, guides, weights=weights, iterations=count, cut=cut)
                          for weights, count in zip((exactly, closely), iterations, strict=True))
    return BadStart(start, bisector_angles(topology, vertices), straightened, held)


def bisector_angles(topology: Topology, vertices: np.ndarray) -> np.ndarray:
    """Angles (N,) in radians between the bisectors of strips and the osculating planes of creases, 90° in a fold.

    One for every vertex inside a crease with strips on both sides; vertices where the crease runs straight do not count.
    """
    edges = topology.edges
    inner = edges.is_crease & ~edges.is_boundary
    ends, faces = edges.vertices[inner], edges.faces[inner]
    direction = unit(vertices[ends[:, 1]] - vertices[ends[:, 0]])
    middle, centres = vertices[ends].mean(axis=1), vertices[topology.quads].mean(axis=1)
    bisector = np.zeros_like(direction)
    for face in faces.T:
        wing = centres[face] - middle
        bisector += unit(wing - dot(wing, direction)[:, None] * direction)
    at_vertices = np.stack([np.bincount(ends.ravel(), np.repeat(part, 2), topology.vertex_count)
                            for part in bisector.T], axis=1)
    binormals = np.zeros_like(vertices)
    for crease in topology.creases:
        binormals[crease.vertices] = curvature_vectors(vertices[crease.vertices], crease.closed)
    bent = norm(binormals) > 1e-3 * norm(binormals).max()
    counts = bent & (np.bincount(ends.ravel(), minlength=topology.vertex_count) == 2)
    sine = np.abs(dot(unit(at_vertices), unit(binormals)))[counts]
    return np.arcsin(np.minimum(sine, 1.0))


def bow(topology: Topology, vertices: np.ndarray) -> float:
    """Mean distance of crease vertices from the chord of their crease over its length; around closed ones, 1."""
    parts = []
    for crease in topology.creases:
        points = vertices[crease.vertices]
        if crease.closed or len(points) < 4:
            continue
        chord = points[-1] - points[0]
        length = float(norm(chord))
        parts.append(norm(np.cross(points - points[0], chord / length)) / length)
    return float(np.concatenate(parts).mean()) if parts else 1.0

"""Patterns with singularities: relaxation near a zigzag that neither slides nor sinks, then the exact conditions (§2.6).

The surface is raised step by step where it cannot be had at once; asymptotic curves stay asymptotic under that.
"""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plisse.geometry.vectors import norm, unit
from plisse.leastsquares import NotPositiveDefinite
from plisse.leastsquares.differences import second_difference
from plisse.leastsquares.kernel import Rows, Term
from plisse.measure.folds import fold_angles
from plisse.solve.anneal import anneal
from plisse.solve.energies import displacement_fairness
from plisse.solve.energies.amplitude import kept_amplitude
from plisse.solve.polish import polish
from plisse.solve.workspace import Workspace
from plisse.structure.topology import Topology

__all__ = ["Hold", "Solved", "Zigzag", "polished", "relaxed", "smoothed"]

WEIGHTS = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5)
POLISH_STEPS = 20
SMOOTHING = (1e-1, 1e-2, 1e-3, 1e-4)
HELD = 0.03  # closeness to what is smoothed


@dataclass(frozen=True, eq=False)
class Zigzag:
    """Where a structure starts: feet and unit normals of its vertices on a surface (V, 3), `labels` ±1 (V,), and the
    distance `amplitude` (V,) from the surface. Labels repeat across the rulings of the mask `repeats` (E,)."""

    topology: Topology
    feet: np.ndarray
    normals: np.ndarray
    labels: np.ndarray
    repeats: np.ndarray
    amplitude: np.ndarray

    @cached_property
    def vertices(self) -> np.ndarray:
        """The zigzag (V, 3)."""
        return self.feet + (self.labels * self.amplitude)[:, None] * self.normals

    @cached_property
    def unit(self) -> float:
        """Mean length of the edges."""
        one, other = self.topology.edges.vertices.T
        return float(norm(self.vertices[one] - self.vertices[other]).mean())

    def raised(self, height: float) -> "Zigzag":
        """The zigzag on the same surface with its height over the mean plane multiplied by `height`."""
        up = unit(self.normals.mean(axis=0)[None])[0]
        level = (self.feet - self.feet.mean(axis=0)) @ up
        tangential = self.normals - np.outer(self.normals @ up, up)
        return replace(self, feet=self.feet + np.outer((height - 1) * level, up),
                       normals=unit(np.outer(self.normals @ up, up) + height * tangential))

    def against_labels(self, vertices: np.ndarray) -> np.ndarray:
        """Mask (E,) of inner crease edges that do not fold as their label says: up is a mountain from above."""
        edges = self.topology.edges
        inner = edges.is_crease & ~edges.is_boundary
        return inner & (np.sign(fold_angles(self.topology, vertices)) != -self.labels[edges.vertices[:, 0]])


@dataclass(frozen=True)
class Hold:
    """How strongly vertices are held: by `closeness` to the zigzag and by their `height` over neighbouring creases.

    Every weight of the relaxation gets `steps` steps.
    """

    closeness: float = 0.3
    height: float = 0.25
    steps: int = 1


@dataclass(frozen=True, eq=False)
class Solved:
    """Vertices (V, 3), the largest residual left, and the number of linear solves it took."""

    vertices: np.ndarray
    defect: float
    iterations: int


def relaxed(zigzag: Zigzag, displacement: np.ndarray, hold: Hold, workspace: Workspace,
            weights: tuple[float, ...] = WEIGHTS) -> Solved:
    """The structure near a zigzag, sought from a first `displacement` (V, 3): relaxation, then minimum-norm steps."""
    topology, scale = zigzag.topology, zigzag.unit
    rest = np.ascontiguousarray(zigzag.vertices.T / scale)
    start = np.ascontiguousarray((zigzag.vertices + displacement).T / scale)
    extra = [*_same_label(zigzag, rest), *kept_amplitude(topology, rest, zigzag.normals.T, zigzag.repeats, hold.height)]
    try:
        found = anneal(topology, start, rest=rest, weights=weights, steps=hold.steps, extra=extra, workspace=workspace,
                       fairness={"same_side": 0.0, "closeness": hold.closeness})
        return polished(zigzag, found.T * scale, workspace, hold.steps * len(weights))
    except NotPositiveDefinite:
        return Solved(zigzag.vertices, np.inf, 0)


def smoothed(zigzag: Zigzag, vertices: np.ndarray, workspace: Workspace) -> np.ndarray:
    """Vertices (V, 3) near given ones and nearly exact, whose displacement from the zigzag is smooth along creases."""
    start, rest = (np.ascontiguousarray(points.T / zigzag.unit) for points in (vertices, zigzag.vertices))
    near = displacement_fairness(zigzag.topology, start, along=0.0, same_side=0.0, closeness=HELD)
    try:
        return anneal(zigzag.topology, start, rest=rest, weights=SMOOTHING, extra=near, workspace=workspace,
                      fairness={"same_side": 0.0, "closeness": 0.0}).T * zigzag.unit
    except NotPositiveDefinite:
        return vertices


def polished(zigzag: Zigzag, vertices: np.ndarray, workspace: Workspace, before: int = 0, *,
             chord: bool = False) -> Solved:
    """The nearest exact structure to vertices (V, 3), as far as minimum-norm steps reach; `chord` as in `polish`."""
    done = polish(workspace.constraints(zigzag.topology, False), np.ascontiguousarray(vertices.T / zigzag.unit),
                  steps=POLISH_STEPS, chord=chord)
    return Solved(done.vertices.T * zigzag.unit, done.defect, before + done.factorisations)


def _same_label(zigzag: Zigzag, rest: np.ndarray) -> list[Term]:
    """Second differences of the displacement across creases, over neighbours on the same side of the surface."""
    triples = [np.empty((0, 3), np.int64)]
    for line in zigzag.topology.rulings:
        for label in (-1, 1):
            mine = line.vertices[zigzag.labels[line.vertices] == label]
            triples.append(np.stack([mine[:-2], mine[1:-1], mine[2:]], axis=1))
    index = np.concatenate(triples).T
    if not index.size:
        return []
    at_rest = second_difference.residual(*(rest[:, column] for column in index), rest=0.0)
    return [Term("same_label", second_difference, tuple(Rows("vertices", column) for column in index), 1.0,
                 {"rest": at_rest})]

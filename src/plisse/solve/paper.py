"""The paper's optimisation, functional (5) of §3.4 as printed: 5V + 3F unknowns in two stages.

E = λ1 E_plan + λ2 E_close + λ3 E_isom + λ4 E_fair + λ5 E_principal over vertices, development and normals.
Lengths are normalised to a mean edge of 1, because the energies depend on scale.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order

from plisse.geometry.vectors import dot, norm
from plisse.leastsquares.kernel import Rows, Term
from plisse.leastsquares.levenberg import Minimum, Status, levenberg_marquardt
from plisse.leastsquares.problem import Blocks, Problem
from plisse.measure.planarity import face_normals
from plisse.solve.energies import Guides, closeness, constant_fold, fairness, plane_fit
from plisse.solve.energies.angle_sum import angle_sum
from plisse.solve.energies.length import equal_length, given_length
from plisse.solve.flatten import unfold
from plisse.structure.cut import Cut, uncut
from plisse.structure.topology import Topology

__all__ = ["PaperSolution", "paper_weights", "quasi_unfolding", "solve_paper"]

UNFOLDING_STEPS = 100


@dataclass(frozen=True, eq=False)
class PaperSolution:
    """Vertices (V, 3), development (V', 2) over the cut topology and unit normals (F, 3), in model units.

    `history` is the value of functional (5) at the start and after each iteration, in units of the mean edge
    length.
    """

    vertices: np.ndarray
    development: np.ndarray
    normals: np.ndarray
    history: tuple[float, ...]
    iterations: int
    factorisations: int
    status: Status


def paper_weights(principal: bool) -> tuple[float, float, float, float, float]:
    """λ1 … λ5 as most rows of Fig. 21 have them."""
    return 10.0, 1.0, 100.0, 1.0, 100.0 if principal else 0.0


def solve_paper(topology: Topology, vertices: np.ndarray, guides: Guides, *,
                weights: Sequence[float] | None = None, iterations: int = 20, cut: Cut | None = None,
                principal: bool = False) -> PaperSolution:
    """Both stages of §3.4 from zigzagged vertices (V, 3); one Levenberg–Marquardt step is one iteration.

    Closed structures bring a `cut`. Along it the functional as printed leaves the angle sums free, because
    each copy is isometric to its own side only; one condition Σω = 2π per vertex inside the cut, weighted
    like E_isom, closes that gap and makes both copies congruent.
    """
    cut = uncut(topology) if cut is None else cut
    unit = _mean_edge(topology, vertices)
    scaled = vertices / unit
    flat = quasi_unfolding(cut, scaled)
    rest = replace(guides, vertices=guides.vertices / unit)
    weights = paper_weights(principal) if weights is None else weights
    functional = _Functional(topology, cut, rest, tuple(weights))
    start = {"vertices": scaled.T, "development": flat.T, "normals": face_normals(topology, scaled).T}
    problem = Problem(functional.terms(scaled), functional.keys()).prepare()

    def renewed(blocks: Blocks) -> Problem:
        return problem.with_terms(functional.terms(blocks["vertices"].T))

    found = levenberg_marquardt(problem, start, iterations=iterations, damping=1e-2, renew=renewed)
    return PaperSolution(unit * found.blocks["vertices"].T, unit * found.blocks["development"].T,
                         found.blocks["normals"].T, found.history, found.iterations, found.factorisations,
                         found.status)


@dataclass(frozen=True, eq=False)
class _Functional:
    """Functional (5) over one topology."""

    topology: Topology
    cut: Cut
    guides: Guides
    weights: tuple[float, ...]

    def terms(self, vertices: np.ndarray) -> list[Term]:
        """All terms, with the feet and normals of E_close frozen at vertices (V, 3)."""
        plan, close, isom, fair, principal = self.weights
        terms = [*plane_fit(self.topology, plan), closeness(self.guides, vertices, close),
                 *self._isometry(isom), fairness(self.topology, fair),
                 constant_fold(self.topology, principal)]
        return [term for term in terms if term.weight > 0 and term.count]

    def keys(self) -> dict[str, tuple[int, np.ndarray]]:
        """Elimination order: a development vertex beside its vertex, a normal amid its face."""
        topology, source = self.topology, self.cut.source
        key = np.arange(topology.vertex_count) if topology.ordering is None else topology.ordering
        corners = topology.corners
        amid = np.bincount(corners.face, key[corners.vertex]) / np.bincount(corners.face)
        return {"vertices": (3, key), "development": (2, key[source]), "normals": (3, amid)}

    def _isometry(self, weight: float) -> list[Term]:
        """E_isom between space and the opened development, and the angle sums it misses along the cut."""
        i, j = self.cut.topology.rods.T
        source = self.cut.source
        pairs = (Rows("vertices", source[i]), Rows("vertices", source[j]),
                 Rows("development", i), Rows("development", j))
        terms = [Term("isometry", equal_length, pairs, weight)]
        opened = np.unique(source[self.topology.vertex_count:])
        for stars in self.topology.stars.values():
            along = stars[np.isin(stars[:, 0], opened)]
            rows = tuple(Rows("vertices", column) for column in along.T)
            terms.append(Term("cut", angle_sum, rows, weight))
        return terms


def quasi_unfolding(cut: Cut, vertices: np.ndarray) -> np.ndarray:
    """Stage 1: the development (V', 2) as isometric as possible to vertices (V, 3), from a square grid.

    Faces are unfolded one after another instead where the topology is no part of a grid, or where the grid
    gets caught in a development with overturned faces or does not settle.
    """
    topology, space = cut.topology, vertices[cut.source]
    squares = square_grid(topology)
    if squares is not None:
        found = _most_isometric(topology, space, squares * _mean_edge(topology, space))
        if found.status is not Status.EXHAUSTED and _turned_over(topology, found.blocks["flat"].T) == 0:
            return found.blocks["flat"].T
    return _most_isometric(topology, space, unfold(topology, space)).blocks["flat"].T


def square_grid(topology: Topology) -> np.ndarray | None:
    """Integer coordinates (V, 2) of a topology that is part of a square grid, creases along x; or None."""
    if topology.hubs or topology.components > 1:
        return None
    a, b, c, d = topology.quads.T
    tail, head = np.concatenate([a, d, a, b]), np.concatenate([b, c, d, c])
    move = np.repeat([[1.0, 0.0], [0.0, 1.0]], 2 * len(a), axis=0)
    size = (topology.vertex_count,) * 2
    links = coo_array((np.ones(len(tail)), (tail, head)), shape=size).tocsr()
    sequence, before = breadth_first_order(links, int(a[0]), directed=False)
    step = {(int(i), int(j)): m for i, j, m in zip(tail, head, move, strict=True)}
    place = np.zeros((topology.vertex_count, 2))
    for vertex in sequence[1:].tolist():
        previous = int(before[vertex])
        forward = step.get((previous, vertex))
        place[vertex] = place[previous] + (forward if forward is not None else -step[vertex, previous])
    return place if np.array_equal(place[head] - place[tail], move) else None


def _most_isometric(topology: Topology, space: np.ndarray, flat: np.ndarray) -> Minimum:
    """The development, block `flat` (2, V'), that minimises E_isom for fixed vertices."""
    i, j = topology.rods.T
    key = np.arange(topology.vertex_count) if topology.ordering is None else topology.ordering
    square = dot(space[i] - space[j], space[i] - space[j])
    term = Term("isometry", given_length, (Rows("flat", i), Rows("flat", j)), 1.0, {"square": square})
    problem = Problem([term], {"flat": (2, key)})
    return levenberg_marquardt(problem, {"flat": flat.T}, iterations=UNFOLDING_STEPS, damping=1e-2,
                               tolerance=1e-6)


def _turned_over(topology: Topology, flat: np.ndarray) -> int:
    """Number of quads whose area is not positive."""
    a, b, c, d = (flat[topology.quads[:, k]] for k in range(4))
    p, q = c - a, d - b
    return int((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0] <= 0).sum())


def _mean_edge(topology: Topology, vertices: np.ndarray) -> float:
    i, j = topology.edges.vertices.T
    return float(norm(vertices[i] - vertices[j]).mean())

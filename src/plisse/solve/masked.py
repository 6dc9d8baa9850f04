"""Solution on a masked grid: anneal, polish, and take away the few quads that stand in the way (§3.4 on real meshes).

A polish that does not converge spoils everything around the place that does not fit, so it is not accepted; the
worst quads go instead, and the rest is annealed again.
"""

from dataclasses import dataclass

import numpy as np

from plisse.geometry.vectors import norm
from plisse.leastsquares import NotPositiveDefinite
from plisse.measure.folds import fold_angles
from plisse.measure.intersection import intersecting_faces
from plisse.measure.planarity import planarity_defect
from plisse.measure.regularity import MIN_SECTOR, OPENING_RANGE, inverted_faces
from plisse.measure.sectors import angle_defect, sector_angles
from plisse.solve.anneal import SLOWLY, anneal
from plisse.solve.constraints import Constraints
from plisse.solve.energies.mid_surface import mid_surface_closeness
from plisse.solve.polish import Polished, polish
from plisse.structure.grid import grid
from plisse.structure.masks import cleaned
from plisse.structure.topology import Topology

__all__ = ["Masked", "MaskedGrid", "Trim", "irregular", "relaxed", "solve_masked"]

CONVERGED = 1e-10
FEWEST_QUADS = 30
AGAIN = SLOWLY[3:]
FAIRNESS = {"closeness": 0.01, "across": 0.1}
RESISTING = 0.03  # an irregular face with a larger defect is a cause, with a smaller one a consequence
GLIMPSE, POLISH_STEPS = 4, 6  # steps after which a polish must show promise, and steps after that
PROMISING = 0.03


@dataclass(frozen=True)
class Trim:
    """How a solution is sought: in at most `rounds`, each of which may take away the `worst` fraction of quads.

    `hold` weighs the closeness of the mid-surface: near the reference, or free to drift where that helps. Creases
    must open by `least_opening` radians.
    """

    rounds: int = 10
    worst: float = 0.01
    hold: float = 0.1
    least_opening: float = OPENING_RANGE[0]


@dataclass(frozen=True, eq=False)
class MaskedGrid:
    """The quads of a grid (n, m) that a mask keeps, over the vertices they use.

    `used` (V,) are the numbers l·m + i of the vertices in the whole grid; their order is kept. `seams` are the columns
    of vertices along which the topology has a seam. In a ring the last crease borders on the first.
    """

    shape: tuple[int, int]
    closed: bool
    mask: np.ndarray
    topology: Topology
    used: np.ndarray
    seams: tuple[int, ...] = ()
    is_ring: bool = False

    @classmethod
    def of(cls, shape: tuple[int, int], closed: bool, mask: np.ndarray, seams: tuple[int, ...] = (),
           is_ring: bool = False) -> "MaskedGrid":
        """Compact topology of a masked grid, with seams at those columns where quads meet."""
        whole = grid(*shape, closed_creases=closed, closed_family=is_ring, mask=mask)
        used = np.unique(whole.quads)
        number = np.full(whole.vertex_count, -1)
        number[used] = np.arange(len(used))
        assert whole.ordering is not None
        rows, columns = np.nonzero(mask & np.roll(mask, 1, axis=1))
        rows, columns = rows[on_seam := np.isin(columns, seams)], columns[on_seam]
        apart = number[np.stack([rows * shape[1] + columns, (rows + 1) % shape[0] * shape[1] + columns], axis=1)]
        topology = Topology(len(used), number[whole.quads], (), whole.ordering[used], apart)
        return cls(shape, closed, mask, topology, used, tuple(np.unique(columns).tolist()), is_ring)

    @property
    def rows(self) -> np.ndarray:
        """Crease number (V,) of every vertex."""
        return self.used // self.shape[1]


@dataclass(frozen=True, eq=False)
class Masked:
    """A solution: the grid that is left, vertices (V, 3) in model units, the largest residual, and what went on.

    `history` has the number of quads and the largest residual of every round.
    """

    grid: MaskedGrid
    vertices: np.ndarray
    defect: float
    faults: int
    history: tuple[tuple[int, float], ...]

    @property
    def is_exact(self) -> bool:
        """Whether the polish converged."""
        return self.defect < CONVERGED

    @property
    def is_sound(self) -> bool:
        """Whether it is exact and no face is irregular."""
        return self.is_exact and self.faults == 0


def solve_masked(start: np.ndarray, normals: np.ndarray, mask: np.ndarray, closed: bool,
                 trim: Trim = Trim(), weights: tuple[float, ...] = SLOWLY, seams: tuple[int, ...] = (),
                 is_ring: bool = False) -> Masked | None:
    """Exact structure near a zigzag `start` (n, m, 3) on the quads of a mask, or on most of them.

    `normals` (n, m, 3) are those of the reference: the mid-surface is held along them. `seams` are columns of vertices
    along which the sheet is cut apart. In a ring the last crease borders on the first. None when fewer than 30 quads
    are left.
    """
    shape = start.shape[:2]
    rest = np.ascontiguousarray(start.reshape(-1, 3))
    current = rest.copy()
    mask = cleaned(mask, closed, seams, is_ring)
    history: list[tuple[int, float]] = []
    found: Masked | None = None
    for _ in range(trim.rounds):
        if mask.sum() < FEWEST_QUADS:
            break
        part = MaskedGrid.of(shape, closed, mask, seams, is_ring)
        vertices, defect = relaxed(part, rest, current, normals.reshape(-1, 3), weights, trim.hold)
        current[part.used] = vertices
        faulty = _faulty(part, vertices, defect < CONVERGED, trim)
        history.append((len(part.topology.quads), defect))
        found = Masked(part, vertices, defect, int(faulty.sum()), tuple(history))
        if found.is_sound:
            break
        lost = np.zeros_like(mask)
        lost[mask] = faulty
        mask = cleaned(mask & ~lost, closed, seams, is_ring)
        weights = () if found.is_exact else AGAIN
    return found


def irregular(part: MaskedGrid, vertices: np.ndarray, least_opening: float = OPENING_RANGE[0]) -> np.ndarray:
    """Mask (F,) of faces with thin sectors or turned corners, at creases that hardly open or fold the wrong way."""
    topology, edges = part.topology, part.topology.edges
    corners = topology.corners
    angles = sector_angles(topology, vertices)
    thin = np.minimum(angles, np.pi - angles) < MIN_SECTOR
    bad = inverted_faces(topology, vertices) | (np.bincount(corners.face, thin, topology.face_count) > 0)
    fold = fold_angles(topology, vertices)
    inner = ~edges.is_boundary
    opening = np.pi - np.abs(fold)
    side = np.sign(fold) * np.where(part.rows[edges.vertices[:, 0]] % 2, 1, -1)
    creases = inner & edges.is_crease
    usual = np.sign(side[creases].sum())
    wrong = creases & ((opening < least_opening) | (opening > OPENING_RANGE[1]) | (side != usual))
    wrong |= inner & ~edges.is_crease & (np.abs(fold) > np.pi / 2)
    bad[edges.faces[wrong].ravel()] = True
    return bad


def _faulty(part: MaskedGrid, vertices: np.ndarray, converged: bool, trim: Trim) -> np.ndarray:
    """Mask (F,) of the faces to take away: irregular or cutting others where converged, else those that resist."""
    bad = irregular(part, vertices, trim.least_opening)
    if converged:
        if not bad.any():
            bad[intersecting_faces(part.topology, vertices)[:, 0]] = True
        return bad
    at_vertices = np.abs(angle_defect(part.topology, vertices))
    defect = np.maximum(planarity_defect(part.topology, vertices), at_vertices[part.topology.quads].max(axis=1))
    return (defect > np.quantile(defect, 1 - trim.worst)) | (bad & (defect > RESISTING))


def relaxed(part: MaskedGrid, rest: np.ndarray, current: np.ndarray, normals: np.ndarray,
             weights: tuple[float, ...], hold: float) -> tuple[np.ndarray, float]:
    """Vertices (V, 3), polished if that converges and annealed otherwise, and the largest residual after polishing."""
    topology = part.topology
    a, b = rest[part.used][topology.edges.vertices.T]
    unit = float(norm(a - b).mean())
    at_rest, at = (np.ascontiguousarray(vertices[part.used].T / unit) for vertices in (rest, current))
    extra = [mid_surface_closeness(topology, at_rest, normals[part.used].T, hold)] if hold > 0 else []
    try:
        if weights:
            at = anneal(topology, at, rest=at_rest, weights=weights, fairness=FAIRNESS, extra=extra)
        done = _polished(Constraints(topology), at)
    except NotPositiveDefinite:
        return at.T * unit, np.inf
    return (done.vertices if done.defect < CONVERGED else at).T * unit, done.defect


def _polished(constraints: Constraints, vertices: np.ndarray) -> Polished:
    """A polish that is given up early where it leads nowhere."""
    done = polish(constraints, vertices, steps=GLIMPSE)
    if CONVERGED <= done.defect < PROMISING:
        done = polish(constraints, done.vertices, steps=POLISH_STEPS)
    return done

"""The parallel mesh nearest to given places, all edge scales positive: a convex quadratic program (§2.3).

Unknowns are vertices and edge scales. Edges of a spanning tree tie vertices to scales, faces and loops close, scales stay
above a limit, and the weighted squared distance to the targets is least. Clarabel (interior points) solves it; the scales
are then projected onto the linear space, so that the result is parallel to rounding error.
Where only a few handles are given, differences of neighbouring scales count as well, so that the change is spread.
"""

from collections.abc import Mapping

import numpy as np
from scipy.sparse import block_array, coo_array, csc_array, csr_array, diags_array, eye_array, kron, vstack

from plisse.errors import Infeasible, InvalidStructure
from plisse.extras import optional
from plisse.geometry.vectors import norm
from plisse.measure.sectors import angle_defect
from plisse.measure.verdict import EXACT
from plisse.structure.chains import successive_triples
from plisse.structure.incidence import edge_lookup
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure
from plisse.transform.edge_scales import ParallelSpace
from plisse.transform.parallel import realised

__all__ = ["FAIRNESS", "nearest_parallel", "with_handles"]

HOLD = 1000.0  # how much a handle weighs against all other vertices together
TOLERANCE = 1e-10
MOST_UNEVEN = 2000.0  # times as long against the original as the shortest edge the longest may become
AT_BOUND = 1.01
FAIRNESS = 10.0  # of differences of scales where handles pull


def nearest_parallel(structure: PleatedStructure, targets: np.ndarray, weights: np.ndarray | None = None, *,
                     least_scale: float = 0.05, fairness: float = 0.0) -> PleatedStructure:
    """The parallel mesh X that minimises the mean of w |X − target|² / h² under edge scales ≥ `least_scale`.

    `targets` (V, 3) in model units, `weights` (V,) not negative, default 1; h is the mean edge length, translations are
    free. Raises Infeasible, with a place that can be reached, where targets would make all edges as short as the limit or
    some of them more than 2000 times as long as others. `fairness` times the mean squared difference of the scales of
    successive edges is added. Raises InvalidStructure for targets that do not fit, MissingExtra where Clarabel is not
    installed.
    """
    space = ParallelSpace(structure)
    targets, weights = _checked(structure, targets, weights, least_scale)
    scales = _solved(space, targets, weights, least_scale, fairness)
    found = realised(space, scales, anchor=0)
    shift = np.average(targets - found.vertices, axis=0, weights=weights)
    found = PleatedStructure(found.topology, found.vertices + shift, found.cut)
    _require_reachable(space, found, targets, weights, least_scale)
    return found


def _require_reachable(space: ParallelSpace, found: PleatedStructure, targets: np.ndarray, weights: np.ndarray,
                       least_scale: float) -> None:
    """Raises Infeasible for meshes that have collapsed, naming a place on the way to where they have not.

    All meshes between two parallel ones are parallel, and their scales lie between, so the place follows in one step.
    """
    scales, base = space.scales(found.vertices), space.structure
    shortest, longest = float(scales.min()), float(scales.max())
    if longest <= AT_BOUND * least_scale:
        what, way = f"all edges would shrink to {least_scale:g} of their length, the least scale", 0.9
    elif longest > MOST_UNEVEN * shortest:
        what = (f"edges would become {shortest:.3g} to {longest:.3g} times as long; the longest factor may be "
                f"{MOST_UNEVEN:g} times the shortest, which the least scale {least_scale:g} bounds")
        way = (MOST_UNEVEN - 1) / (longest - 1 + MOST_UNEVEN * (1 - shortest))
    elif (np.abs(angle_defect(found.topology, found.vertices)).max() > EXACT
          >= np.abs(angle_defect(base.topology, base.vertices)).max()):
        what, way = f"edges would become {shortest:.3g} to {longest:.3g} times as long, which rounding does not bear", 0.1
    else:
        return
    pulled = int(np.argmax(weights * norm(targets - base.vertices)))
    x, y, z = (1 - way) * base.vertices[pulled] + way * found.vertices[pulled]
    raise Infeasible(f"the targets are out of reach: {what}; the point at {place_of(base.topology, pulled)} "
                     f"can go to about {x:.5g}, {y:.5g}, {z:.5g}")


def with_handles(structure: PleatedStructure, positions, handles: Mapping) -> tuple[np.ndarray, np.ndarray]:
    """Targets (V, 3) and weights (V,): vertices stay where they are or at `positions`, handles weigh a thousand times more.

    Handles are {vertex or (crease, point): [x, y, z]}, counted from 0.
    """
    targets = np.array(structure.vertices if positions is None else positions, dtype=float)
    weights = np.full(structure.topology.vertex_count, 1.0 / structure.topology.vertex_count)
    for key, place in handles.items():
        vertex = _vertex(structure, key)
        targets[vertex] = np.asarray(place, dtype=float)
        weights[vertex] = HOLD
    return targets, weights


def _vertex(structure: PleatedStructure, key) -> int:
    count, creases = structure.topology.vertex_count, structure.topology.creases
    if isinstance(key, int | np.integer):
        if not 0 <= key < count:
            raise InvalidStructure(f"there is no vertex {key}; vertices run from 0 to {count - 1}")
        return int(key)
    crease, point = key
    if not 0 <= crease < len(creases):
        raise InvalidStructure(f"there is no crease {crease + 1}; the structure has {len(creases)}")
    if not 0 <= point < len(creases[crease].vertices):
        raise InvalidStructure(f"crease {crease + 1} has no point {point + 1}; it has {len(creases[crease].vertices)}")
    return int(creases[crease].vertices[point])


def _checked(structure: PleatedStructure, targets, weights, least_scale: float) -> tuple[np.ndarray, np.ndarray]:
    targets = np.asarray(targets, dtype=float)
    if targets.shape != structure.vertices.shape or not np.isfinite(targets).all():
        raise InvalidStructure(f"the mesh to be near to has {len(targets)} places, but the structure has "
                               f"{len(structure.vertices)} vertices with three finite coordinates each")
    if not 0 < least_scale <= 1:
        raise InvalidStructure(f"edge scales cannot all be at least {least_scale:g}; give a limit above 0, at most 1")
    weights = np.ones(len(targets)) if weights is None else np.asarray(weights, dtype=float)
    if weights.shape != (len(targets),) or not (weights >= 0).all() or not weights.sum() > 0:
        raise InvalidStructure("weights must be one number per vertex, none negative and not all zero")
    return targets, weights


def _solved(space: ParallelSpace, targets: np.ndarray, weights: np.ndarray, least_scale: float,
            fairness: float) -> np.ndarray:
    """Edge scales (E,) of the optimum."""
    clarabel = optional("clarabel", extra="parallel", purpose="nearest parallel meshes")
    size, (count, edges) = space.structure.mean_edge, (len(targets), len(space.directions))
    origin = space.structure.vertices.mean(axis=0)
    wanted = (targets - origin) / size
    total = weights.sum()
    objective = csc_array(block_array([[kron(diags_array(weights / total), eye_array(3)), None],
                                       [None, fairness * _unevenness(space)]]))
    linear = np.concatenate([-(weights[:, None] / total * wanted).ravel(), np.zeros(edges)])
    equations = _equations(space, size)
    bounds = csr_array(block_array([[csr_array((edges, 3 * count)), -eye_array(edges)]]))
    right = np.concatenate([np.zeros(equations.shape[0]), np.full(edges, -least_scale)])
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = TOLERANCE
    cones = [clarabel.ZeroConeT(equations.shape[0]), clarabel.NonnegativeConeT(edges)]
    rows = csc_array(vstack([equations, bounds]))
    solution = clarabel.DefaultSolver(objective, linear, rows, right, cones, settings).solve()
    if str(solution.status) not in ("Solved", "AlmostSolved"):
        raise Infeasible(f"the nearest parallel mesh was not found: the convex solver stopped with {solution.status}; move "
                         "the targets nearer to the structure")
    return np.array(solution.x)[3 * count:]


def _equations(space: ParallelSpace, size: float) -> csr_array:
    """Rows on (vertices, scales): tree edges and loop edges join their ends, faces close."""
    edges, count = space.structure.topology.edges.vertices, space.structure.topology.vertex_count
    tied = np.concatenate([space.spanning, space.loops])
    rows = np.arange(len(tied))
    ones = np.ones(len(tied))
    ends = csr_array(coo_array((np.concatenate([ones, -ones]), (np.tile(rows, 2), edges[tied][:, ::-1].T.ravel())),
                               shape=(len(tied), count)))
    lengths = coo_array((-(space.directions[tied] / size).ravel(),
                         (np.arange(3 * len(tied)), np.repeat(tied, 3))), shape=(3 * len(tied), len(edges)))
    faces = space.conditions[:2 * space.structure.topology.face_count]
    return csr_array(block_array([[kron(ends, eye_array(3)), lengths], [None, faces]]))


def _unevenness(space: ParallelSpace) -> csr_array:
    """Matrix (E, E) of the mean squared difference between scales of successive edges on creases and rulings."""
    topology = space.structure.topology
    edge = edge_lookup(topology)
    edges = topology.edges
    triples = np.concatenate([successive_triples(edges.vertices[kind]) for kind in (edges.is_crease, ~edges.is_crease)])
    rows = np.arange(len(triples))
    before, after = edge(triples[:, 0], triples[:, 1]), edge(triples[:, 1], triples[:, 2])
    entries = np.repeat([-1.0, 1.0], len(rows)), (np.tile(rows, 2), np.concatenate([before, after]))
    difference = csr_array(coo_array(entries, shape=(len(rows), len(space.directions))))
    return csr_array(difference.T @ difference) / max(len(rows), 1)

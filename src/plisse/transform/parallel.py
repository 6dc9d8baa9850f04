"""Parallel meshes (§2.3, Fig. 7): edges keep their directions and change their lengths, and the sheet stays exact.

A structure is developable because angles around vertices sum to 2π. Parallel edges enclose the same angles, so every
parallel mesh with positive edge scales is a pleated structure too, and principal where the first one is.
"""

from collections.abc import Mapping

import numpy as np
from scipy.sparse import coo_array, csr_array, eye_array, vstack

from plisse.errors import Infeasible, InvalidStructure
from plisse.geometry.vectors import norm
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.structure.grid_numbers import grid_numbers
from plisse.structure.incidence import edge_lookup
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Topology
from plisse.transform.edge_scales import ParallelSpace
from plisse.transform.principal import require_folded
from plisse.transform.saddle import least_quadratic, projected

__all__ = ["cut_apart", "from_polylines", "parallel", "realised", "require_positive", "spiral"]

CONSISTENT = 1e-9
SMALLEST = 1e-6  # scale below which a spiral has collapsed


def parallel(structure: PleatedStructure, *, lengths=None, widths=None, growth: float | None = None, positions=None,
             handles: Mapping | None = None, least_scale: float = 0.05) -> PleatedStructure:
    """A structure parallel to this one, laid flat (§2.3).

    One of three ways: factors `lengths` for the edges along the first crease and `widths` for those along the first
    zigzag of rulings, see `from_polylines`; `growth` of a spiral, see `spiral`; or `positions` (V, 3) and `handles`
    {(crease, point) or vertex: [x, y, z]} to be near to, with edge scales of at least `least_scale`, see
    `plisse.transform.nearest_parallel`. Raises Infeasible where edges would have to turn round,
    InvalidStructure for structures that lie flat.
    """
    require_folded(structure, "it has no parallel structures")
    by_factors, by_growth, by_place = (lengths is not None or widths is not None), growth is not None, \
        (positions is not None or handles is not None)
    if by_factors + by_growth + by_place != 1:
        raise InvalidStructure("a parallel mesh is made from factors (lengths, widths), from a growth, or from positions "
                               "and handles; give exactly one of these")
    if by_growth:
        assert growth is not None
        found = spiral(structure, growth)
    elif by_factors:
        found = from_polylines(structure, 1.0 if lengths is None else lengths, 1.0 if widths is None else widths)
    else:
        from plisse.transform.nearest_parallel import FAIRNESS, nearest_parallel, with_handles

        targets, weights = with_handles(structure, positions, handles or {})
        found = nearest_parallel(structure, targets, weights, least_scale=least_scale, fairness=FAIRNESS if handles else 0.0)
    return flatten(found, best_cut(found) if found.cut.is_trivial else found.cut)


def from_polylines(structure: PleatedStructure, lengths=1.0, widths=1.0, *, crease: int = 0,
                   ruling: int = 0) -> PleatedStructure:
    """The parallel mesh determined by two transverse polylines with their directions kept (Cauchy data, §2.3).

    `lengths` and `widths` are the factors for the edges along the crease and the ruling polyline of these numbers: one
    for all or one per edge, in the order of `topology.creases` and `topology.rulings`. They determine a grid; on other
    topologies the mesh is the one whose remaining edges change least. The first vertex of the crease stays where it is.
    Raises Infeasible where the factors contradict each other or other edges would turn round.
    """
    space, topology = ParallelSpace(structure), structure.topology
    along, along_factors = _prescribed(topology, topology.creases, crease, lengths, "lengths", "crease")
    across, across_factors = _prescribed(topology, topology.rulings, ruling, widths, "widths", "zigzag of rulings")
    edges, factors = np.concatenate([along, across]), np.concatenate([along_factors, across_factors])
    entries = np.ones(len(edges)), (np.arange(len(edges)), edges)
    picked = csr_array(coo_array(entries, shape=(len(edges), len(space.directions))))
    right = np.concatenate([np.zeros(space.conditions.shape[0]), factors])
    matrix = csr_array(vstack([space.conditions, picked]))
    scales = least_quadratic(eye_array(matrix.shape[1]), np.ones(matrix.shape[1]), matrix, right)
    if not np.abs(matrix @ scales - right).max() <= CONSISTENT * max(1.0, float(np.abs(scales).max())):
        raise Infeasible("these factors contradict each other, because the structure is closed or singular; cut it open, or "
                         "prescribe fewer")
    return realised(space, scales, anchor=int(topology.creases[crease].vertices[0]))


def spiral(structure: PleatedStructure, growth: float) -> PleatedStructure:
    """The parallel mesh whose edges grow evenly along the creases, `growth` times from one end to the other (Fig. 7).

    Every edge shall be q times as long against the original as its neighbour one column before. A structure with
    helical symmetry becomes one with spiral symmetry: similarities take every column to the next. Others follow as evenly
    as they can; along cones and cylinders, whose crease edges are parallel, rulings cannot grow. The total length of all
    creases stays the same. Closed structures are cut along a zigzag of rulings first. Raises Infeasible where edges would
    turn round, InvalidStructure for topologies that are no grid.
    """
    if not (np.isfinite(growth) and growth > 0):
        raise Infeasible(f"a spiral cannot grow by the factor {growth:g}; give a positive number")
    structure = cut_apart(structure)
    numbers, space = grid_numbers(structure.topology), ParallelSpace(structure)
    edge = edge_lookup(structure.topology)
    along, across = edge(numbers[:, :-1], numbers[:, 1:]), edge(numbers[:-1], numbers[1:])
    growing = _growing(along, across, growth ** (1 / (numbers.shape[1] - 1)), len(space.directions))
    scales = _keeping(space, growing, [along])
    if not scales.min() > SMALLEST:
        scales = _keeping(space, growing, [along, across])
    return realised(space, scales, anchor=int(numbers[0, 0]))


def _growing(along: np.ndarray, across: np.ndarray, ratio: float, size: int) -> csr_array:
    """Matrix (size, size) of Σ ((λ after − q λ before) / qⁱ)² over neighbours one column apart."""
    before = np.concatenate([part[:, :-1].ravel() for part in (along, across)])
    after = np.concatenate([part[:, 1:].ravel() for part in (along, across)])
    column = np.concatenate([np.tile(np.arange(1.0, part.shape[1]), len(part)) for part in (along, across)])
    weight, rows = ratio**-column, np.arange(len(before))
    entries = np.concatenate([weight, -ratio * weight]), (np.tile(rows, 2), np.concatenate([after, before]))
    difference = csr_array(coo_array(entries, shape=(len(rows), size)))
    return csr_array(difference.T @ difference)


def _keeping(space: ParallelSpace, hessian: csr_array, groups: list[np.ndarray]) -> np.ndarray:
    """Edge scales (E,) that minimise a quadratic form while the total length of every group of edges stays the same."""
    lengths = norm(space.directions)
    kept = np.zeros((len(groups), len(lengths)))
    for row, group in zip(kept, groups, strict=True):
        row[group.ravel()] = lengths[group.ravel()] / lengths[group.ravel()].sum()
    matrix = csr_array(vstack([space.conditions, csr_array(kept)]))
    right = np.concatenate([np.zeros(space.conditions.shape[0]), np.ones(len(groups))])
    return least_quadratic(hessian, np.zeros(len(lengths)), matrix, right)


def cut_apart(structure: PleatedStructure) -> PleatedStructure:
    """The structure cut open into a disk, both copies of the cut as vertices of their own."""
    cut = best_cut(structure) if structure.cut.is_trivial else structure.cut
    return PleatedStructure(cut.topology, structure.vertices[cut.source])


def require_positive(space: ParallelSpace, scales: np.ndarray) -> None:
    """Nothing; raises Infeasible, saying where, when edges (E,) would shrink to nothing or turn round."""
    bad = np.flatnonzero(scales <= 0)
    if not len(bad):
        return
    worst = bad[np.argmin(scales[bad])]
    vertex = int(space.structure.topology.edges.vertices[worst, 0])
    kind = "crease" if space.structure.topology.edges.is_crease[worst] else "ruling"
    raise Infeasible(f"{len(bad)} of {len(scales)} edges would turn round, the worst a {kind} edge at "
                     f"{place_of(space.structure.topology, vertex)} with the factor {scales[worst]:.2g}; change less, or "
                     "move handles instead, which keeps factors positive")


def realised(space: ParallelSpace, scales: np.ndarray, anchor: int) -> PleatedStructure:
    """The parallel mesh with these edge scales (E,), freed of what they miss the conditions by; `anchor` stays in place."""
    scales = projected(scales, space.conditions)
    require_positive(space, scales)
    vertices = space.positions(scales)
    structure = space.structure
    vertices = vertices + structure.vertices[anchor] - vertices[anchor]
    return PleatedStructure(structure.topology, vertices, structure.cut)


def _prescribed(topology: Topology, lines, number: int, factors, name: str, kind: str) -> tuple[np.ndarray, np.ndarray]:
    """Edges along a polyline and the factor for each."""
    if not 0 <= number < len(lines):
        raise InvalidStructure(f"there is no {kind} {number + 1}; the structure has {len(lines)}")
    line = lines[number]
    path = line.path
    edges = edge_lookup(topology)(path[:-1], path[1:])
    values = np.asarray(factors, dtype=float)
    if values.ndim > 1 or values.size not in (1, len(edges)):
        raise InvalidStructure(f"{name} has {values.size} factors, but {kind} {number + 1} has {len(edges)} edges; give one "
                               "for all or one for each")
    if not (np.isfinite(values).all() and (values > 0).all()):
        raise InvalidStructure(f"{name} must be positive factors, and one is {values.ravel()[np.argmin(values)]:g}")
    return edges, np.broadcast_to(values, len(edges))

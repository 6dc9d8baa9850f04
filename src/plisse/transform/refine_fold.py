"""One fold replaced by three, locally, by parallelism (§2.3, right half of Fig. 7).

At every vertex p of a crease the zigzag goes back along a ruling u and on along a ruling w. A new zigzag leaves u before
p, runs parallel to w, then parallel to u, and joins w: p becomes p + s u, p + s u + t w, p + t w. All new edges and faces
are parallel to those around the old crease, so the sheet stays exact; mountain becomes mountain, valley, mountain. The
new creases are parallel to the old one, which fixes s and t along the crease up to one factor each.
"""

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np

from plisse.errors import Infeasible, InvalidStructure
from plisse.geometry.vectors import angle_between, dot, norm
from plisse.solve.cutting import best_cut
from plisse.solve.flatten import flatten
from plisse.structure.place import place_of
from plisse.structure.pleated import PleatedStructure
from plisse.structure.topology import Polyline, Topology
from plisse.transform.principal import require_folded

__all__ = ["inner_creases", "refine_fold", "refine_folds"]

CLOSES = 1e-10


def refine_fold(structure: PleatedStructure, crease: int, *, fraction: float = 1 / 3,
                at: float | None = None) -> PleatedStructure:
    """The structure with fold `crease` (number in `topology.creases`, from 0) replaced by three, laid flat (§2.3).

    New creases lie at `fraction` of both strips' rulings from the old one: where there is least room for them, or at the
    position `at` in [0, 1] along the crease. Nothing moves beyond the two strips. Raises InvalidStructure for creases
    without a strip on both sides, Infeasible where the new creases leave their strips.
    """
    found = refine_folds(structure, [crease], fraction=fraction, at=at)
    return flatten(found, best_cut(found))


def refine_folds(structure: PleatedStructure, creases: Iterable[int], *, fraction: float = 1 / 3,
                 at: float | None = None) -> PleatedStructure:
    """The structure with several folds replaced at once, not yet laid flat; with 1/3 strips are split into thirds."""
    topology, vertices = structure.topology, structure.vertices
    require_folded(structure, "it has no fold to replace")
    if not 0 < fraction < 1:
        raise InvalidStructure(f"new creases cannot lie at {fraction:g} of a strip; give a fraction between 0 and 1")
    if at is not None and not 0 <= at <= 1:
        raise InvalidStructure(f"there is no position {at:g} along a crease; positions run from 0 to 1")
    quads, hubs = topology.quads.copy(), [hub.copy() for hub in topology.hubs]
    places = vertices.copy()
    folds = [_fold(topology, number) for number in creases]
    seams = topology.seams
    ordering = [np.arange(len(vertices), dtype=float) if topology.ordering is None else topology.ordering]
    count = len(vertices)
    for fold in folds:
        back, ahead = (_offsets(structure, fold, side, fraction, at) for side in (fold.back, fold.ahead))
        old = fold.path
        middle, far = count + np.arange(len(old)), count + len(old) + np.arange(len(old))
        # the face before keeps the numbers of the old crease, the face beyond gets the far ones
        renumber = np.arange(count)
        renumber[old] = far
        quads[fold.beyond[fold.beyond < len(topology.quads)]] = \
            renumber[quads[fold.beyond[fold.beyond < len(topology.quads)]]]
        for face in fold.beyond[fold.beyond >= len(topology.quads)] - len(topology.quads):
            hubs[face] = renumber[hubs[face]]
        seams = _seams(seams, fold, middle, far)
        quads = np.concatenate([quads, _strip(old, middle, fold.closed), _strip(middle, far, fold.closed)])
        places[old] = vertices[old] + back
        places = np.concatenate([places, vertices[old] + back + ahead, vertices[old] + ahead])
        ordering += [ordering[0][old]] * 2
        count = len(places)
    found = PleatedStructure(Topology(count, quads, tuple(hubs), np.concatenate(ordering), seams), places)
    _require_room(structure, found, folds, fraction)
    return found


def inner_creases(topology: Topology) -> list[int]:
    """Numbers of the creases with a strip on both sides all along."""
    inner = {frozenset(edge) for edge in topology.edges.vertices[~topology.edges.is_boundary].tolist()}
    return [number for number, crease in enumerate(topology.creases)
            if all(frozenset(edge) in inner for edge in _segments(crease).tolist())]


class _Fold(NamedTuple):
    """A crease's vertices (n,), its neighbours `back` and `ahead` along rulings, and the faces beyond it."""

    number: int
    path: np.ndarray
    back: np.ndarray
    ahead: np.ndarray
    beyond: np.ndarray
    closed: bool


def _fold(topology: Topology, number: int) -> _Fold:
    if not 0 <= number < len(topology.creases):
        raise InvalidStructure(f"there is no crease {number + 1}; the structure has {len(topology.creases)}")
    crease, corners = topology.creases[number], topology.corners
    path, ends = crease.vertices, _segments(crease)
    count = np.int64(topology.vertex_count)
    key = corners.vertex * count + corners.next
    order = np.argsort(key)

    def corner(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        at = np.minimum(np.searchsorted(key[order], a * count + b), len(key) - 1)
        if (key[order][at] != a * count + b).any():
            raise InvalidStructure(f"crease {number + 1} lies on the boundary, at least partly, so there is no fold to "
                                   "replace; take an inner crease")
        return order[at]

    beyond, before = corner(ends[:, 0], ends[:, 1]), corner(ends[:, 1], ends[:, 0])
    ahead = _neighbours(topology, corners.face[beyond], ends, forward=True)
    back = _neighbours(topology, corners.face[before], ends, forward=False)
    for pair in (ahead, back):
        if (pair[1:, 0] != pair[:-1, 1]).any() or (crease.closed and pair[0, 0] != pair[-1, 1]):
            raise InvalidStructure(f"crease {number + 1} passes a vertex with more than two rulings; only plain folds can "
                                   "be replaced by three")
    back_ends, ahead_ends = (pair[:, 0] if crease.closed else np.append(pair[:, 0], pair[-1, 1]) for pair in (back, ahead))
    return _Fold(number, path, back_ends, ahead_ends, corners.face[beyond], crease.closed)


def _neighbours(topology: Topology, faces: np.ndarray, ends: np.ndarray, forward: bool) -> np.ndarray:
    """Other ends (K, 2) of the rulings that faces have at both ends of their crease edges."""
    corners = topology.corners
    count = np.int64(topology.vertex_count)
    key = corners.face * count + corners.vertex
    order = np.argsort(key)
    first, second = (order[np.searchsorted(key[order], faces * count + ends[:, k])] for k in (0, 1))
    if forward:
        return np.stack([corners.previous[first], corners.next[second]], axis=1)
    return np.stack([corners.next[first], corners.previous[second]], axis=1)


def _offsets(structure: PleatedStructure, fold: _Fold, neighbours: np.ndarray, fraction: float,
             at: float | None) -> np.ndarray:
    """Vectors (n, 3) along rulings from the old crease to a parallel one."""
    points = structure.vertices[fold.path]
    rulings = structure.vertices[neighbours] - points
    edges = np.diff(np.concatenate([points, points[:1]]) if fold.closed else points, axis=0)
    later = np.roll(rulings, -1, axis=0)[:len(edges)]
    ratio = np.sin(angle_between(rulings[:len(edges)], edges)) / np.sin(angle_between(later, -edges))
    profile = np.exp(np.concatenate([[0.0], np.cumsum(np.log(ratio))]))
    if fold.closed:
        if abs(profile[-1] - 1) > CLOSES:
            raise Infeasible(f"crease {fold.number + 1} is closed and a crease parallel to it misses itself by "
                             f"{100 * abs(profile[-1] - 1):.2g} % after one turn; cut the structure open first")
        profile = profile[:-1]
    lengths = norm(rulings)
    share = profile / lengths
    least = share.max() if at is None else share[round(at * (len(share) - 1))]
    if fraction / least * share.max() >= 1:
        worst = place_of(structure.topology, int(fold.path[np.argmax(share)]))
        raise Infeasible(f"a crease parallel to this one leaves its strip at {worst}; use a fraction below "
                         f"{least / share.max():.2g}, or place it there")
    return (fraction / least * share)[:, None] * rulings


def _seams(seams: np.ndarray, fold: _Fold, middle: np.ndarray, far: np.ndarray) -> np.ndarray:
    """Seams (S, 2) that cross the fold, carried on over its new creases."""
    place = np.full(int(max(seams.max(initial=0), fold.path.max(), fold.ahead.max())) + 1, -1)
    place[fold.path] = np.arange(len(fold.path))
    crossing = place[seams]
    if (crossing >= 0).all(axis=1).any():
        raise InvalidStructure(f"crease {fold.number + 1} is a seam of the sheet, so there is no fold to replace")
    out = seams.copy()
    for own, other in ((0, 1), (1, 0)):
        on = np.flatnonzero(crossing[:, own] >= 0)
        beyond = on[seams[on, other] == fold.ahead[crossing[on, own]]]
        out[beyond, own] = far[crossing[beyond, own]]
    at = np.unique(crossing[crossing >= 0])
    return np.concatenate([out, np.stack([fold.path[at], middle[at]], axis=1), np.stack([middle[at], far[at]], axis=1)])


def _strip(lower: np.ndarray, upper: np.ndarray, closed: bool) -> np.ndarray:
    """Quads (K, 4) between two creases; the first runs along `lower`."""
    quads = np.stack([lower, np.roll(lower, -1), np.roll(upper, -1), upper], axis=1)
    return quads if closed else quads[:-1]


def _segments(line: Polyline) -> np.ndarray:
    path = line.path
    return np.stack([path[:-1], path[1:]], axis=1)


def _require_room(before: PleatedStructure, after: PleatedStructure, folds: list[_Fold], fraction: float) -> None:
    """Raise Infeasible, naming the largest fraction, where an edge turned round: all edges are linear in the fraction."""
    quads = before.topology.quads
    faces = after.topology.quads[:len(quads)]
    old = [before.vertices[np.roll(quads, -1, axis=1)] - before.vertices[quads]]
    new = [after.vertices[np.roll(faces, -1, axis=1)] - after.vertices[faces]]
    start = before.topology.vertex_count
    for fold in folds:
        steps = len(fold.path) - (not fold.closed)
        middle = after.vertices[start:start + len(fold.path)]
        old.append((np.roll(before.vertices[fold.path], -1, axis=0) - before.vertices[fold.path])[:steps])
        new.append((np.roll(middle, -1, axis=0) - middle)[:steps])
        start += 2 * len(fold.path)
    one, other = (np.concatenate([part.reshape(-1, 3) for part in parts]) for parts in (old, new))
    shrinking = (1 - dot(one, other) / dot(one, one)).max() / fraction
    if fraction * shrinking >= 1:
        raise Infeasible(f"the new creases have no room, because edges would turn round; use a fraction below "
                         f"{1 / shrinking:.2g}")

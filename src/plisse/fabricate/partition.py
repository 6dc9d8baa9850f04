"""Chains and graphs of regions in as few good parts as can be found, with short borders between them.

What is good stays good when it gets smaller; then the parts of a chain are as few as possible.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import breadth_first_order, connected_components

__all__ = ["Regions", "partition"]

Good = Callable[[np.ndarray], bool]


@dataclass(frozen=True, eq=False)
class Regions:
    """Areas (R,) of regions, pairs (L, 2) of neighbours and the length (L,) of the border between them."""

    areas: np.ndarray
    pairs: np.ndarray
    lengths: np.ndarray

    @property
    def chain(self) -> np.ndarray | None:
        """The regions in order from one end to the other, where they form a chain."""
        count = len(self.areas)
        degree = np.bincount(self.pairs.ravel(), minlength=count)
        if len(self.pairs) != count - 1 or degree.max(initial=0) > 2:
            return None
        order = self.spread_from(int(np.argmin(degree)))
        return order if len(order) == count else None

    def spread_from(self, start: int, inside: np.ndarray | None = None) -> np.ndarray:
        """Regions reached from one of them, nearest first, without leaving `inside` (mask)."""
        return breadth_first_order(self._links(inside), start, directed=False, return_predecessors=False)

    def components(self, inside: np.ndarray) -> list[np.ndarray]:
        """Connected parts (masks) of a set of regions (mask)."""
        _, label = connected_components(self._links(inside), directed=False)
        return [label == k for k in np.unique(label[inside])]

    def border(self, inside: np.ndarray) -> float:
        """Length of the border between a set of regions (mask) and the rest."""
        return float(self.lengths[inside[self.pairs[:, 0]] != inside[self.pairs[:, 1]]].sum())

    def _links(self, inside: np.ndarray | None):
        pairs = self.pairs if inside is None else self.pairs[inside[self.pairs].all(axis=1)]
        return coo_array((np.ones(len(pairs)), pairs.T), shape=(len(self.areas),) * 2).tocsr()


def partition(regions: Regions, good: Good) -> list[np.ndarray]:
    """Good, connected parts (masks over regions) that cover all; single regions must be good."""
    chain = regions.chain
    if chain is None:
        return _merged(regions, good, _halved(regions, good, np.ones(len(regions.areas), bool)))
    return [_mask(chain[a:b], len(chain)) for a, b in _intervals(regions, good, chain)]


def _mask(chosen: np.ndarray, count: int) -> np.ndarray:
    mask = np.zeros(count, bool)
    mask[chosen] = True
    return mask


def _intervals(regions: Regions, good: Good, chain: np.ndarray) -> list[tuple[int, int]]:
    """The fewest intervals of a chain; among those short borders and equal areas."""
    count = len(chain)
    reach = _reach(good, chain)
    border = np.zeros(count + 1)
    position = np.argsort(chain)[regions.pairs].max(axis=1)
    border[position] = regions.lengths / max(regions.lengths.mean(), 1e-300) if count > 1 else 0.0
    area = np.concatenate([[0.0], np.cumsum(regions.areas[chain])]) / regions.areas.sum()
    fewest = _count(reach)
    number, cost = np.full(count + 1, count + 1), np.full(count + 1, np.inf)
    number[0], cost[0] = 0, 0.0
    origin = np.zeros(count + 1, int)
    for start in range(count):
        ends = np.arange(start + 1, reach[start] + 1)
        trial = cost[start] + border[ends] + fewest * (area[ends] - area[start]) ** 2
        better = (number[start] + 1 < number[ends]) | ((number[start] + 1 == number[ends]) & (trial < cost[ends]))
        number[ends[better]], cost[ends[better]], origin[ends[better]] = number[start] + 1, trial[better], start
    cuts = [count]
    while cuts[-1]:
        cuts.append(int(origin[cuts[-1]]))
    return list(zip(cuts[:0:-1], cuts[-2::-1], strict=True))


def _reach(good: Good, chain: np.ndarray) -> np.ndarray:
    """For every start (R,) the end of the longest good interval; ends never move back."""
    count, end = len(chain), 1
    reach = np.empty(count, int)
    for start in range(count):
        end = max(end, start + 1)
        while end < count and good(_mask(chain[start:end + 1], count)):
            end += 1
        reach[start] = end
    return reach


def _count(reach: np.ndarray) -> int:
    """Number of intervals when each is as long as it can be."""
    at = number = 0
    while at < len(reach):
        at, number = int(reach[at]), number + 1
    return number


def _halved(regions: Regions, good: Good, part: np.ndarray) -> list[np.ndarray]:
    """A part cut in two along short borders, again and again, until all are good."""
    pending, done = regions.components(part), []
    while pending:
        part = pending.pop()
        if part.sum() == 1 or good(part):
            done.append(part)
        else:
            near = _near_half(regions, part)
            pending += regions.components(near) + regions.components(part & ~near)
    return done


def _near_half(regions: Regions, part: np.ndarray) -> np.ndarray:
    """The regions near one end of a part, up to a short border that leaves neither side with less than a quarter."""
    far = regions.spread_from(int(np.flatnonzero(part)[0]), part)[-1]
    order = regions.spread_from(int(far), part)
    share = np.cumsum(regions.areas[order]) / regions.areas[order].sum()
    sizes = np.flatnonzero((share[:-1] >= 0.25) & (share[:-1] <= 0.75)) + 1
    if len(sizes) == 0:
        sizes = np.array([int(np.clip(np.searchsorted(share, 0.5) + 1, 1, len(order) - 1))])
    outside = regions.border(part)
    return min((_mask(order[:size], len(part)) for size in sizes.tolist()),
               key=lambda near: regions.border(near) + regions.border(part & ~near) - outside)


def _merged(regions: Regions, good: Good, parts: list[np.ndarray]) -> list[np.ndarray]:
    """Neighbouring parts joined where the union is good, along the longest borders first."""
    label = np.argmax(np.stack(parts), axis=0)
    refused: set[frozenset[int]] = set()
    while True:
        between = _borders(regions, label, refused)
        if not between:
            return [label == k for k in np.unique(label)]
        a, b = min(between, key=lambda pair: (-between[pair], pair))
        union = (label == a) | (label == b)
        if good(union):
            label[union] = a
            refused = {frozenset(a if k == b else k for k in pair) for pair in refused}
        else:
            refused.add(frozenset((a, b)))


def _borders(regions: Regions, label: np.ndarray, refused: set[frozenset[int]]) -> dict[tuple[int, int], float]:
    """Length of the border between every two neighbouring parts that may still be joined."""
    out: dict[tuple[int, int], float] = {}
    ends = np.sort(label[regions.pairs], axis=1)
    for (a, b), length in zip(ends.tolist(), regions.lengths.tolist(), strict=True):
        if a != b and frozenset((a, b)) not in refused:
            out[a, b] = out.get((a, b), 0.0) + length
    return out

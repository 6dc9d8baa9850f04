"""Where creases and columns cross: found with chords, then moved onto both cubics by Newton's method (§2.6)."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import shapely

from plisse.layout.asymptotic.leaf import BETWEEN, Leaf, hermite

__all__ = ["Crossings", "Met", "met"]

NEWTON_STEPS = 5


class Met(NamedTuple):
    """Crossings (X,) of curves with others: numbers of both, places in the plane, and lengths along both
    in the plane."""

    one: np.ndarray
    other: np.ndarray
    places: np.ndarray
    on_one: np.ndarray
    on_other: np.ndarray


@dataclass(frozen=True, eq=False)
class Crossings:
    """The first crossing of every crease with every column it meets: `crease` and `column` (X,) are numbers in `creases`
    and `columns`, `places` (X,) lie in the plane, `along` and `across` (X,) are lengths along both in the plane."""

    creases: tuple[Leaf, ...]
    columns: tuple[Leaf, ...]
    crease: np.ndarray
    column: np.ndarray
    places: np.ndarray
    along: np.ndarray
    across: np.ndarray

    @classmethod
    def of(cls, creases: Sequence[Leaf], columns: Sequence[Leaf]) -> "Crossings":
        """All of them."""
        return cls(tuple(creases), tuple(columns), *met(creases, columns))

    def with_columns(self, columns: Sequence[Leaf]) -> "Crossings":
        """These, and those of further columns."""
        more = Crossings.of(self.creases, columns)
        return Crossings(self.creases, self.columns + more.columns, np.append(self.crease, more.crease),
                         np.append(self.column, len(self.columns) + more.column), np.append(self.places, more.places),
                         np.append(self.along, more.along), np.append(self.across, more.across))

    def only(self, kept: np.ndarray) -> "Crossings":
        """Those of the columns of a mask."""
        on, number = kept[self.column], np.cumsum(kept) - 1
        return replace(self, columns=tuple(leaf for leaf, stays in zip(self.columns, kept, strict=True) if stays),
                       crease=self.crease[on], column=number[self.column[on]], places=self.places[on],
                       along=self.along[on], across=self.across[on])


def met(ones: Sequence[Leaf], others: Sequence[Leaf]) -> Met:
    """The first crossing along the ones of every two curves that cross."""
    one, other = _Stacked.of(ones), _Stacked.of(others)
    other_chord, chord = shapely.STRtree(one.chords).query(other.chords, predicate="intersects")
    order = np.lexsort((chord, other.owner[other_chord // BETWEEN], one.owner[chord // BETWEEN]))
    chord, other_chord = chord[order], other_chord[order]
    pair = np.stack([one.owner[chord // BETWEEN], other.owner[other_chord // BETWEEN]], axis=1)
    first = np.flatnonzero(np.r_[True, (np.diff(pair, axis=0) != 0).any(axis=1)][:len(pair)])
    chord, other_chord, pair = chord[first], other_chord[first], pair[first]
    on_one, on_other = (chord + 0.5) / BETWEEN, (other_chord + 0.5) / BETWEEN
    for _ in range(NEWTON_STEPS):
        (p, u), (q, v) = one.at(on_one, pair[:, 0]), other.at(on_other, pair[:, 1])
        turned = (np.conj(u) * v).imag
        on_one = on_one + (np.conj(q - p) * v).imag / turned
        on_other = on_other + (np.conj(q - p) * u).imag / turned
    places = one.at(on_one, pair[:, 0])[0]
    return Met(pair[:, 0], pair[:, 1], places, one.length(on_one, pair[:, 0]), other.length(on_other, pair[:, 1]))


@dataclass(frozen=True, eq=False)
class _Stacked:
    """The steps of several curves one after another: their cubics (4, M), lengths up to where they begin and their sizes
    (2, M), chords, whose they are, and where each curve begins."""

    ends: np.ndarray
    lengths: np.ndarray
    chords: np.ndarray
    owner: np.ndarray
    first: np.ndarray

    @classmethod
    def of(cls, leaves: Sequence[Leaf]) -> "_Stacked":
        count = np.array([len(leaf.steps.sizes) for leaf in leaves], int)
        lengths = [np.stack([leaf.steps.sums[:-1], leaf.steps.sizes]) for leaf in leaves]
        return cls(np.concatenate([np.empty((4, 0)), *(leaf.steps.ends for leaf in leaves)], axis=1),
                   np.concatenate([np.empty((2, 0)), *lengths], axis=1),
                   np.concatenate([np.empty(0, object), *(leaf.chords for leaf in leaves)]),
                   np.repeat(np.arange(len(count)), count), np.cumsum(count) - count)

    def at(self, parameter: np.ndarray, owner: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places and derivatives (N,) at parameters (N,), which count steps from the first curve on, of curves (N,)."""
        step = self._step(parameter, owner)
        return hermite(self.ends[:, step], parameter - step)

    def length(self, parameter: np.ndarray, owner: np.ndarray) -> np.ndarray:
        """Lengths (N,) in the plane up to parameters (N,) of curves (N,)."""
        step = self._step(parameter, owner)
        before, size = self.lengths[:, step]
        return before + size * (parameter - step)

    def _step(self, parameter: np.ndarray, owner: np.ndarray) -> np.ndarray:
        last = np.append(self.first[1:], len(self.owner))[owner] - 1
        return np.clip(np.floor(parameter).astype(int), self.first[owner], last)

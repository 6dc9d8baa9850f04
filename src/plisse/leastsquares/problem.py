"""Nonlinear least squares over energy terms: gather, evaluate, scatter, on fixed patterns."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.leastsquares import Factor, GramPattern, damped, factoriser
from plisse.leastsquares.kernel import Term

__all__ = ["Blocks", "Linearisation", "Problem"]

Blocks = dict[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class Linearisation:
    """Residuals (R,) and Jacobian entries (E,) at one point, both multiplied by √weight."""

    residual: np.ndarray
    entries: np.ndarray

    @property
    def cost(self) -> float:
        """Σ weight · residual²."""
        return float(self.residual @ self.residual)


class Problem:
    """Least squares over blocks of unknowns, each a component-first array (dim, count).

    `keys` give every row of every block a place in the elimination order, so that grids have a narrow band.
    Terms may be exchanged for terms of the same shape (`with_terms`) without building patterns anew.
    """

    def __init__(self, terms: list[Term], keys: dict[str, tuple[int, np.ndarray]]):
        self.terms = terms
        self._first_unknown = _number_unknowns(keys)
        self._dimension = {name: dimension for name, (dimension, _) in keys.items()}
        self._count = {name: len(key) for name, (_, key) in keys.items()}
        self.unknowns = sum(self._dimension[name] * self._count[name] for name in keys)

    def with_terms(self, terms: list[Term]) -> "Problem":
        """The same problem with other weights and data, sharing all patterns."""
        twin = object.__new__(Problem)
        twin.__dict__.update(self.__dict__)
        twin.terms = terms
        return twin

    @cached_property
    def _layout(self) -> tuple[np.ndarray, np.ndarray, int]:
        """Row and unknown of every Jacobian entry, and the number of rows."""
        rows, unknowns, start = [], [], 0
        for term in self.terms:
            height = self._dimension[term.arguments[0].block] if term.kernel.componentwise else 1
            for argument in term.arguments:
                dimension = self._dimension[argument.block]
                component = np.arange(dimension)[:, None]
                row = start + np.arange(term.count) + (component * term.count if height > 1 else 0 * component)
                rows.append(row.ravel())
                unknowns.append((self._first_unknown[argument.block][argument.index] + component).ravel())
            start += height * term.count
        return np.concatenate(rows), np.concatenate(unknowns), start

    @cached_property
    def _pattern(self) -> GramPattern:
        rows, unknowns, _ = self._layout
        return GramPattern(unknowns, rows, self.unknowns)

    @cached_property
    def _factoriser(self):
        return factoriser(self._pattern)

    def prepare(self) -> "Problem":
        """Builds all patterns now, so that problems made by `with_terms` share them."""
        _ = self._factoriser
        return self

    def residual(self, blocks: Blocks) -> np.ndarray:
        """Residuals (R,) times √weight."""
        return np.concatenate([np.sqrt(term.weight) * term.kernel(*_arguments(term, blocks), **term.data).ravel()
                               for term in self.terms])

    def linearise(self, blocks: Blocks) -> Linearisation:
        """Residuals and Jacobian entries at a point."""
        residuals: list[np.ndarray] = []
        entries: list[np.ndarray] = []
        for term in self.terms:
            arguments, scale = _arguments(term, blocks), np.sqrt(term.weight)
            residuals.append(scale * term.kernel(*arguments, **term.data).ravel())
            entries.extend(scale * gradient.ravel() for gradient in term.kernel.gradients(*arguments, **term.data))
        return Linearisation(np.concatenate(residuals), np.concatenate(entries))

    def gradient(self, at: Linearisation) -> np.ndarray:
        """Jᵀr (N,), half the gradient of the cost."""
        rows, unknowns, _ = self._layout
        return np.bincount(unknowns, at.entries * at.residual.take(rows), self.unknowns)

    def factor(self, at: Linearisation, damping: float) -> Factor:
        """Factor of JᵀJ + damping; more damping is added where the matrix is not positive definite."""
        _, unknowns, _ = self._layout
        largest = float(np.bincount(unknowns, at.entries**2).max())
        return damped(self._factoriser, at.entries, max(damping, 1e-14 * largest), attempts=12)

    def moved(self, blocks: Blocks, step: np.ndarray) -> Blocks:
        """Blocks after a step (N,) in the order of the unknowns."""
        out = {}
        for name, values in blocks.items():
            if name not in self._first_unknown:
                out[name] = values
                continue
            index = self._first_unknown[name] + np.arange(self._dimension[name])[:, None]
            out[name] = values + step[index]
        return out


def _arguments(term: Term, blocks: Blocks) -> list[np.ndarray]:
    return [blocks[argument.block].take(argument.index, axis=1) for argument in term.arguments]


def _number_unknowns(keys: dict[str, tuple[int, np.ndarray]]) -> dict[str, np.ndarray]:
    """First unknown of every row of every block, in the order of the keys."""
    names = list(keys)
    key = np.concatenate([keys[name][1] for name in names])
    width = np.concatenate([np.full(len(keys[name][1]), keys[name][0]) for name in names])
    order = np.argsort(key, kind="stable")
    first = np.empty(len(key), np.int64)
    first[order] = np.cumsum(width[order]) - width[order]
    cuts = np.cumsum([len(keys[name][1]) for name in names])[:-1]
    return dict(zip(names, np.split(first, cuts), strict=True))

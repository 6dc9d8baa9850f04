"""The optimised way (§3.4): anneal the zigzag on few columns, refine its displacement, polish to round-off."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

import numpy as np

from plisse.geometry.vectors import norm
from plisse.leastsquares import NotPositiveDefinite
from plisse.solve.anneal import WEIGHTS, anneal
from plisse.solve.attempt import Attempt, Start
from plisse.solve.polish import TOLERANCE, polish
from plisse.structure.pattern import interpolate_along

__all__ = ["CoarseToFine", "Worth"]

Worth = Callable[[int, np.ndarray], bool]

MIDDLE_COLUMNS = 160
HOPELESS = 1e-2
SUFFICIENT = 1e-6  # residual of a level that is only interpolated from


@dataclass(frozen=True)
class CoarseToFine:
    """Anneals on `columns` columns with `steps` Gauss–Newton steps per weight, then only polishes finer levels.

    A level that is only interpolated from is polished to `sufficient`; chords serve on the last one where it has `chords`
    columns or more.
    """

    name: str
    columns: int = 40
    steps: int = 1
    fairness: Mapping[str, float] = field(default_factory=dict)
    sufficient: float = SUFFICIENT
    chords: int = 61

    def __call__(self, start: Start, worth: Worth | None = None) -> Attempt:
        """The attempt on a start; numerical breakdown is a message, not an exception.

        `worth` is told the columns and vertices (V, 3) of the coarsest level and says whether finer ones shall follow.
        """
        displacement: np.ndarray | None = None
        history: list[float] = []
        iterations = 0
        try:
            for samples in self._levels(start):
                level = _Level(start, samples)
                vertices = level.rest if displacement is None else level.displaced(displacement)
                if displacement is None:
                    vertices = anneal(level.topology, vertices, principal=start.principal, steps=self.steps,
                                      fairness=self.fairness, workspace=start.workspace)
                    iterations += self.steps * len(WEIGHTS)
                last = samples == start.samples
                conditions = start.workspace.constraints(level.topology, start.principal)
                chord = last and samples >= self.chords
                done = polish(conditions, vertices, chord=chord,
                              steps=(20 if chord else 12) if last else 8 if displacement is None else 2,
                              tolerance=TOLERANCE if last else self.sufficient)
                iterations += len(done.history) - 2
                history += done.history[:-1]
                if displacement is None and not last and worth and not worth(samples, level.in_space(done.vertices)):
                    return Attempt(self.name, None, f"nothing better is to be seen with {samples} columns", iterations,
                                   tuple(history))
                displacement = level.displacement(done.vertices)
                if done.defect > HOPELESS:  # finer levels only polish: they cannot mend what is wrong here
                    displacement = _Level(start, start.samples).interpolated(displacement)
                    break
        except NotPositiveDefinite as error:
            return Attempt(self.name, None, f"the linear systems break down: {error}", iterations, tuple(history))
        if displacement is None or not np.isfinite(displacement).all():
            return Attempt(self.name, None, "the iteration diverges", iterations, tuple(history))
        vertices = (start.guides(start.samples) + displacement).reshape(-1, 3)
        return Attempt(self.name, vertices, "", iterations, tuple(history))

    def _levels(self, start: Start) -> list[int]:
        coarse = max(self.columns, 60 if start.pattern.closed else 0)
        levels = [coarse] if coarse < start.samples else []
        if start.samples >= 400:
            levels.append(MIDDLE_COLUMNS)
        return [*levels, start.samples]


class _Level:
    """One resolution, in units of its mean edge length along creases."""

    def __init__(self, start: Start, samples: int):
        self._guides = start.guides(samples)
        self._closed = start.pattern.closed
        self._unit = float(norm(np.diff(self._guides, axis=1)).mean())
        self.topology = start.grid(samples)
        self.rest = np.ascontiguousarray((self._guides / self._unit).reshape(-1, 3).T)

    def displaced(self, displacement: np.ndarray) -> np.ndarray:
        """Vertices (3, V) for a displacement (m, n', 3) from another level."""
        return self.rest + (self.interpolated(displacement) / self._unit).reshape(-1, 3).T

    def interpolated(self, displacement: np.ndarray) -> np.ndarray:
        """Displacement (m, n, 3) at this level from one (m, n', 3) at another, in model units."""
        parameters = np.linspace(0, 1, self._guides.shape[1], endpoint=not self._closed)
        return interpolate_along(displacement, self._closed, 3)(parameters).swapaxes(0, 1)

    def in_space(self, vertices: np.ndarray) -> np.ndarray:
        """Vertices (V, 3) in model units for vertices (3, V)."""
        return (vertices * self._unit).T

    def displacement(self, vertices: np.ndarray) -> np.ndarray:
        """Displacement (m, n, 3) of vertices (3, V) from the guides, in model units."""
        return ((vertices - self.rest) * self._unit).T.reshape(self._guides.shape)

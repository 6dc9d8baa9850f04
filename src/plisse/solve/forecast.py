"""What can be foretold from a pattern before solving: rulings, openings, curvature (§2.1).

Along a crease with curvature κ, torsion τ and half opening angle u the rulings make with the crease the angle given by
cot = (τ + u′) / (κ cos u). Where it vanishes the strip folds over: geometry, not numerics.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from plisse.geometry.frames import curvature, torsion
from plisse.geometry.polyline import arc_length, tangents
from plisse.geometry.vectors import angle_between, dot, norm
from plisse.solve.zigzag import zigzag_curves
from plisse.structure.pattern import Pattern

__all__ = ["Forecast", "forecast"]

LOW_RULING = np.radians(15.0)
HOPELESS_RULING = np.radians(5.0)
UNEQUAL_OPENINGS = 15.0
NARROW_STRIP = 0.05


@dataclass(frozen=True, eq=False)
class Forecast:
    """What is predicted for zigzag `creases` (m, n, 3) with half opening angles (m−2, n) of the inner ones, in radians."""

    creases: np.ndarray
    half_openings: np.ndarray
    principal: bool
    closed: bool
    narrowest: float

    @cached_property
    def curvature(self) -> np.ndarray:
        """Curvature (m, n) of the creases."""
        return np.array([curvature(curve, self.closed) for curve in self.creases])

    @cached_property
    def ruling_angles(self) -> np.ndarray:
        """Angles (m, n) between creases and rulings in radians."""
        # outermost creases have no fold; their strips are those of their neighbours
        inner = self.half_openings if len(self.half_openings) else np.full((1, self.creases.shape[1]), np.pi / 4)
        everywhere = np.concatenate([inner[:1], inner, inner[-1:]])[: len(self.creases)]
        return np.array([_ruling_angles(curve, bend, opening, self.closed)
                         for curve, bend, opening in zip(self.creases, self.curvature, everywhere, strict=True)])

    @property
    def is_hopeful(self) -> bool:
        """Whether a structure is likely: 98 of 101 designs with rulings above 5° could be solved, 3 of 19 below."""
        return bool(self.ruling_angles.min() > HOPELESS_RULING and self.warnings_of_openings() == [])

    def warnings(self) -> list[str]:
        """Sentences with place and remedy; empty for a pattern without difficulties."""
        return self._warnings_of_inflections() + self._warnings_of_rulings() + self.warnings_of_openings()

    def _warnings_of_rulings(self) -> list[str]:
        crease, column = np.unravel_index(np.argmin(self.ruling_angles), self.ruling_angles.shape)
        angle = self.ruling_angles[crease, column]
        if angle > LOW_RULING:
            return []
        return [f"rulings fall to {np.degrees(angle):.0f}° on crease {crease + 1} near {self._percent(column):.0f} % of its "
                "length; raise pattern.amplitude, lower the torsion of the seed curve, or keep fewer creases"]

    def _warnings_of_inflections(self) -> list[str]:
        relative = self.curvature / np.median(self.curvature, axis=1, keepdims=True)
        crease, column = np.unravel_index(np.argmin(relative), relative.shape)
        if relative[crease, column] > 0.05:
            return []
        return [f"the curvature of crease {crease + 1} nearly vanishes near {self._percent(column):.0f} % of its length, so "
                "its rulings turn along the crease; bend the seed curve more there, or cut the design before the inflection"]

    def warnings_of_openings(self) -> list[str]:
        """Sentences about folds that start almost flat or almost closed."""
        if self.half_openings.size == 0:
            return []
        opening = np.degrees(2 * np.median(self.half_openings, axis=1))
        shallow, tight = int(np.argmax(opening)), int(np.argmin(opening))
        out = []
        if opening[shallow] > 170:
            out.append(f"crease {shallow + 2} starts with an opening angle of {opening[shallow]:.1f}°, almost flat; "
                       "raise pattern.amplitude to about a quarter of pattern.width")
        if opening[tight] < 8:
            out.append(f"crease {tight + 2} starts with an opening angle of {opening[tight]:.1f}°, almost closed; lower "
                       "pattern.theta or pattern.amplitude")
        if self.principal and self.closed and np.ptp(opening) > UNEQUAL_OPENINGS:
            out.append(f"opening angles start between {opening.min():.0f}° and {opening.max():.0f}°, but closed principal "
                       "structures have nearly one for all creases; give one pattern.theta and one pattern.width")
        if self.narrowest < NARROW_STRIP:
            out.append(f"the narrowest strip is only {self.narrowest:.2g} times as wide as its vertices are apart; raise "
                       "pattern.amplitude or pattern.width, or pattern.samples")
        return out

    def _percent(self, column: np.intp) -> float:
        return 100 * int(column) / max(self.ruling_angles.shape[1] - 1, 1)


def forecast(pattern: Pattern, amplitude: float, principal: bool = False) -> Forecast:
    """Forecast for a pattern zigzagged by an amplitude in model units; constant fold angles where `principal`."""
    creases = zigzag_curves(pattern, amplitude)
    closed = pattern.closed
    half = _half_openings(creases, closed)
    if principal and len(half):
        half = np.broadcast_to(np.median(half, axis=1, keepdims=True), half.shape)
    gap, step = norm(np.diff(creases, axis=0)), norm(np.diff(creases[:-1], axis=1)).mean()
    return Forecast(creases, half, principal, closed, float(np.median(gap, axis=1).min() / step))


def _half_openings(creases: np.ndarray, closed: bool) -> np.ndarray:
    """Half the angle (m−2, n) between the directions to both neighbours, seen along the crease."""
    inner = creases[1:-1]
    along = tangents(inner, closed)
    back, ahead = (across - dot(across, along)[..., None] * along for across in (creases[:-2] - inner, creases[2:] - inner))
    return 0.5 * angle_between(back, ahead)


def _ruling_angles(curve: np.ndarray, kappa: np.ndarray, half_opening: np.ndarray, closed: bool) -> np.ndarray:
    """Angle (n,) between crease and rulings, the smaller of both sides: u and π − u give ± u′ in cot."""
    twist = torsion(curve, closed)
    step = arc_length(curve, closed)[-1] / (len(curve) - (not closed))
    change = (np.roll(half_opening, -1) - np.roll(half_opening, 1)) / (2 * step) if closed \
        else np.gradient(half_opening, step)
    slope = np.maximum(np.abs(twist + change), np.abs(twist - change))
    return np.arctan2(kappa * np.abs(np.cos(half_opening)), slope)

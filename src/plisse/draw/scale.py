"""Scales of colour maps: where a value lies between pale and dark, and what stands beside the colour bar."""

from dataclasses import dataclass

import numpy as np

__all__ = ["Scale", "defect_scale", "linear_scale"]

EXACT, NOISE, ROUGH = 1e-9, 1e-16, 1e-2
STEPS = (1.0, 2.0, 2.5, 5.0)
TICKS = 5  # gaps between ticks at most


@dataclass(frozen=True)
class Scale:
    """Values from `low` to `high`, by their logarithm or straight; `unit` follows numbers."""

    low: float
    high: float
    logarithmic: bool = False
    unit: str = ""

    def shares(self, values: np.ndarray) -> np.ndarray:
        """Positions of values in 0…1; nan stays nan."""
        if not self.logarithmic:
            return np.clip((values - self.low) / (self.high - self.low), 0, 1)
        with np.errstate(invalid="ignore"):
            powers = np.log10(np.where(np.isnan(values), np.nan, np.maximum(values, 1e-300)))
        low, high = np.log10([self.low, self.high])
        return np.clip((powers - low) / (high - low), 0, 1)

    def values(self, shares: np.ndarray) -> np.ndarray:
        """Values at positions in 0…1."""
        if self.logarithmic:
            return 10 ** (np.log10(self.low) + shares * np.log10(self.high / self.low))
        return self.low + shares * (self.high - self.low)

    def ticks(self) -> list[tuple[float, str]]:
        """Positions in 0…1 and their labels."""
        if self.logarithmic:
            low, high = round(np.log10(self.low)), round(np.log10(self.high))
            step = max(1, -(-(high - low) // TICKS))
            powers = list(range(high, low - 1, -step))[::-1]
            return [((power - low) / (high - low), f"1e{power}") for power in powers]
        step = _round_step((self.high - self.low) / TICKS)
        first = np.ceil(self.low / step - 1e-9) * step
        places = np.arange(first, self.high + 1e-9 * step, step)
        shares = (places - self.low) / (self.high - self.low)
        return [(share, f"{round(place, 9) + 0.0:g}{self.unit}")
                for share, place in zip(shares.tolist(), places.tolist(), strict=True)]


def defect_scale(largest: float) -> Scale:
    """Decades from round-off to the limit 1e-9 of what is exact, or from the limit to 1e-2 where it is exceeded;
    straight from 0 where even that is too little."""
    if largest <= EXACT:
        return Scale(NOISE, EXACT, True)
    return Scale(EXACT, ROUGH, True) if largest <= ROUGH else linear_scale(0.0, largest)


def linear_scale(low: float, high: float, unit: str = "", least: float = 1e-9) -> Scale:
    """A straight scale between round numbers around low and high, `least` long at least."""
    step = _round_step(max(high - low, least) / TICKS)
    start, end = np.floor(low / step + 1e-9) * step, np.ceil(high / step - 1e-9) * step
    return Scale(float(start), float(max(end, start + step)), False, unit)


def _round_step(wanted: float) -> float:
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(next((power * step for step in STEPS if power * step >= wanted * (1 - 1e-9)), 10 * power))

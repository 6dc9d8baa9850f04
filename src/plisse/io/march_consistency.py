"""What the numbers of a march must be to each other, beyond the type of each."""

from collections.abc import Callable
from itertools import pairwise

from plisse.errors import InvalidDesign
from plisse.recipe import March

__all__ = ["check_march"]

# of the values in a profile, in words as well: those of single values
RANGES: dict[str, tuple[str, Callable[[float], bool]]] = {
    "distance": ("from 1e-9 to 1e9", lambda value: 1e-9 <= value <= 1e9),
    "direction": ("between -90 and 90", lambda value: -90 < value < 90),
    "fold": ("between 2 and 178", lambda value: 2 < value < 178)}


def check_march(march: March, *, closed: bool) -> None:
    """Nothing; raises InvalidDesign where the numbers of a march contradict each other."""
    if march.seed_index >= march.creases:
        raise InvalidDesign(f"march.seed is {march.seed}, but march.creases is {march.creases}; give a crease from 1 to "
                            f"{march.creases}")
    _check_family("distance", march.distance, march.creases - 1, "strip")
    _check_family("direction", march.direction, march.creases, "crease")
    if march.fold is not None:
        _check_family("fold", march.fold, march.creases, "crease")
    if closed and march.samples < 15:
        raise InvalidDesign(f"march.samples is {march.samples}, too few for a closed curve; give at least 15")
    if closed and (march.direction != 0 or march.fold is not None):
        name = "direction" if march.direction != 0 else "fold"
        raise InvalidDesign(f"march.{name} is set, but along a closed curve directions and folds follow from the distances, "
                            "because creases must close; remove it")
    if closed and march.turn:
        raise InvalidDesign("march.turn is set, but planes that lean to both sides in turn do not close; remove it")


def _check_family(name: str, value: object, count: int, what: str) -> None:
    """One value, a list of the right length, or a rising table."""
    if not isinstance(value, list):
        return
    tables = [isinstance(entry, list) for entry in value]
    if any(tables) and not all(tables):
        raise InvalidDesign(f"march.{name} mixes numbers and [position, value] rows; give one kind")
    if not any(tables):
        if len(value) != count:
            raise InvalidDesign(f"march.{name} has {len(value)} values, but there are {count} {what}s; give one value, one "
                                f"per {what}, or a profile [[position, value], …]")
        return
    words, fits = RANGES[name]
    for k, row in enumerate(value):
        if not (len(row) == 2 and 0 <= row[0] <= 1 and fits(row[1])):
            raise InvalidDesign(f"march.{name}[{k}] is {row}; give [position from 0 to 1 across the family, "
                                f"{name} {words}]")
    positions = [row[0] for row in value]
    if len(value) < 2 or any(b <= a for a, b in pairwise(positions)):
        raise InvalidDesign(f"march.{name} has the positions {positions}; give at least two, in increasing order")

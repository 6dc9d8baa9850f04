"""The recipe of an explicit construction: principal structures in three numbers per crease."""

from typing import Annotated

from msgspec import Meta

from plisse.recipe.fields import Length, Strict

__all__ = ["March"]

ONE_OR_MANY = "degrees: one number, one per crease, or a profile [[position, degrees], …]"
FoldAngle = Annotated[float, Meta(gt=2, lt=178, description="degrees between 2 and 178")]
Direction = Annotated[float, Meta(gt=-90, lt=90, description="degrees between -90 and 90")]


class March(Strict, kw_only=True, frozen=True):
    """Creases marched outwards from a curve, to both sides, exact without any solver (§2.4, §2.5).

    The curve is crease number `seed` (the middle one if left out) of `creases`; it opens by `opening`. Three numbers,
    prescribed in the middle of the creases, determine every further one: its `distance` from the last one along the
    ruling there, its `direction` (0 is parallel to the last one, above 0 the strip widens along the curve), and its
    `fold` angle (180 − opening if left out), mountain and valley in turn. Each is one value, a list (one per strip or
    crease), or a profile along the family: a table [[position, value], …] with positions from 0 (first crease) to 1
    (last), smoothly interpolated. In lists the numbers of the seed, and the folds of the first and last crease, stand for
    nothing. Along a closed curve only distances are free. `turn` leans the rectifying planes of the seed to both sides in
    turn: 0 is smooth, other values make facets that alternate like those of a Miura.
    """

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")]
    distance: Annotated[Length | list[Length | list[float]], Meta(
        description="one length from 1e-9 to 1e9 model units, one per strip, or a profile [[position, length], …]")]
    direction: Annotated[Direction | list[Direction | list[float]],
                         Meta(description=ONE_OR_MANY)] = 0.0
    fold: Annotated[FoldAngle | list[FoldAngle | list[float]],
                    Meta(description=ONE_OR_MANY)] | None = None
    opening: FoldAngle = 90.0
    turn: Annotated[float, Meta(gt=-90, lt=90, description="degrees between -90 and 90")] = 0.0
    seed: Annotated[int, Meta(ge=1, le=1000, description="the number of a crease, from 1")] | None = None
    samples: Annotated[int, Meta(ge=5, le=20_000, description="a whole number from 5 to 20000")] = 201

    @property
    def seed_index(self) -> int:
        """Which crease the curve is, counted from 0."""
        return self.creases // 2 if self.seed is None else self.seed - 1

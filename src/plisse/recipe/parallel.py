"""What a design asks for of meshes parallel to its structure (§2.3, Fig. 7)."""

from typing import Annotated, Literal

from msgspec import Meta

from plisse.recipe.fields import Point, Strict

__all__ = ["Factors", "Move", "Parallel"]

Factor = Annotated[float, Meta(gt=0, le=1000, description="a factor above 0, at most 1000")]
Factors = Annotated[Factor | list[Factor | list[float]],
                    Meta(description="one factor, one per edge, or a table [[position, factor], …]")]
Number = Annotated[int, Meta(ge=1, le=1_000_000, description="a number from 1")]


class Move(Strict, kw_only=True, frozen=True):
    """A handle: point number `point` of crease number `crease`, both counted from 1, moves by `by` or to `to`."""

    crease: Number
    point: Number
    by: Point | None = None
    to: Point | None = None


class Parallel(Strict, kw_only=True, frozen=True):
    """Parallel meshes made of a structure, and folds of it replaced by three.

    First one of: `lengths` and `widths` (factors along the first crease and the first zigzag of rulings), `growth` (of a
    spiral, over the length of the creases), `moves` (handles, with all edge scales at least `least_scale`). Then `refine`:
    numbers of creases from 1, or all inner ones, `rounds` times, new creases at `fraction` of the strips' rulings, where
    they are narrowest, or at the percentage `at` of the crease's length.
    """

    lengths: Factors | None = None
    widths: Factors | None = None
    growth: Factor | None = None
    moves: Annotated[list[Move], Meta(min_length=1, description="a list of moves {crease, point, by or to}")] | None = None
    least_scale: Annotated[float, Meta(gt=0, le=1, description="a factor above 0, at most 1")] = 0.05
    refine: Literal["all"] | list[Number] | None = None
    fraction: Annotated[float, Meta(gt=0, lt=1, description="a number between 0 and 1")] = 1 / 3
    at: Annotated[float, Meta(ge=0, le=100, description="percent from 0 to 100")] | None = None
    rounds: Annotated[int, Meta(ge=1, le=4, description="a whole number from 1 to 4")] = 1

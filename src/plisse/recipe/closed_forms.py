"""Structures known in closed form."""

from typing import Annotated

from msgspec import Meta

from plisse.recipe.fields import Length, Strict

__all__ = ["ClosedForm", "Cones", "ConicCreases", "HelicalPleats", "Miura"]


class Cones(Strict, tag_field="kind", tag="cones", kw_only=True, frozen=True):
    """Alternating cones of equal slope: creases develop into concentric circles."""

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] = 8
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 100
    radius: Length = 100.0
    width: Length = 6.0
    slope: Annotated[float, Meta(ge=0.01, le=100, description="rise over run, from 0.01 to 100")] = 1.0
    sector: Annotated[float, Meta(ge=1, le=360, description="degrees from 1 to 360")] = 120.0


class ConicCreases(Strict, tag_field="kind", tag="conic-creases", kw_only=True, frozen=True):
    """Cones whose creases develop into similar ellipses with shared foci, through the bounces of a billiard ball.

    `size` is the half axis of the first ellipse, `growth` the ratio of successive ones, `fold` the fold angle of all
    creases; vertices begin at the eccentric angle `start` and turn by about `step` degrees each.
    """

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] = 9
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 100
    size: Length = 100.0
    eccentricity: Annotated[float, Meta(ge=0, lt=0.95, description="a number from 0 below 0.95")] = 0.45
    growth: Annotated[float, Meta(gt=1, le=2, description="a ratio above 1, at most 2")] = 1.1
    fold: Annotated[float, Meta(gt=2, lt=178, description="degrees between 2 and 178")] = 70.0
    start: Annotated[float, Meta(ge=-360, le=360, description="degrees from -360 to 360")] = 60.0
    step: Annotated[float, Meta(ge=0.01, lt=60, description="degrees from 0.01, below 60")] = 1.5


class Miura(Strict, tag_field="kind", tag="miura", kw_only=True, frozen=True):
    """The Miura-ori with zigzag creases; `sector` and `fold` in degrees."""

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] = 7
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 12
    edge: Length = 10.0
    ruling: Length = 12.0
    sector: Annotated[float, Meta(gt=5, lt=90, description="degrees between 5 and 90")] = 65.0
    fold: Annotated[float, Meta(gt=1, lt=89, description="degrees between 1 and 89")] = 50.0


class HelicalPleats(Strict, tag_field="kind", tag="helical", kw_only=True, frozen=True):
    """Pleats on coaxial helices of equal pitch, from `radius` outward; one screw takes every column to the next.

    `slope` in degrees is the rise of the first strip against the radius, `width` the length of all rulings.
    """

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] = 9
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 100
    radius: Length = 30.0
    pitch: Annotated[float, Meta(ge=-1e9, le=1e9, description="rise per turn in model units, up to 1e9")] = 90.0
    turns: Annotated[float, Meta(ge=0.01, le=50, description="a number of turns from 0.01 to 50")] = 1.0
    width: Length = 5.0
    slope: Annotated[float, Meta(gt=1, lt=89, description="degrees between 1 and 89")] = 50.0


ClosedForm = Cones | ConicCreases | HelicalPleats | Miura

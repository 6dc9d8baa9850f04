"""The recipe of a reconstruction."""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from plisse.recipe.fields import Inclination, Length, Point, Range, Strict, Units, without_none

__all__ = ["Pull", "Surface", "SurfaceDesign", "SurfacePattern"]


class Pull(Strict, kw_only=True, frozen=True):
    """An edit of a surface: `point` moves by `displacement`, its surroundings follow smoothly up to `radius`."""

    point: Point
    displacement: Point
    radius: Length


class Surface(Strict, kw_only=True, frozen=True):
    """A reference surface: a mesh file, a height z(x, y) over a rectangle, a radius r(x) about the z axis for x = z
    over the range `x`, or a torus [R, r].

    With `guide` (points joined on the surface) or `fan` (a point) creases are pseudo-geodesics of constant inclination;
    otherwise rows are laid out over the whole surface, around `centre` where it is given, and inclinations are fitted.
    `handles`, or an `edited_file` with the same faces, change the surface after it was laid out and solved; the
    structure follows and is solved again (Fig. 23). Without `overhang` inclinations stay below 45° when they are fitted
    and creases open by 15° at least; where faces overhang all the same the report says how many.
    """

    file: str | None = None
    height: str | None = None
    radius: str | None = None
    torus: tuple[Length, Length] | None = None
    x: Range = (-100.0, 100.0)
    y: Range = (-100.0, 100.0)
    centre: Point | None = None
    overhang: bool = False
    guide: Annotated[list[Point], Meta(min_length=2, description="two or more points [x, y, z]")] | None = None
    guide_closed: bool = False
    fan: Point | None = None
    fan_radius: Length | None = None
    reach: Length | None = None
    handles: list[Pull] | None = None
    edited_file: str | None = None
    beyond: bool = False
    tuned: bool = True


class SurfacePattern(Strict, kw_only=True, frozen=True):
    """What may be asked of the pleats over a surface; everything else follows from its size and curvature.

    Along a guide `theta` is kept, and `width` and `amplitude` are needed; over a whole surface `theta` is a preference,
    and the report gives the inclinations along every crease.
    """

    theta: Inclination | None = None
    width: Length | None = None
    amplitude: Length | None = None
    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] | None = None
    samples: Annotated[int, Meta(ge=5, le=20_000, description="a whole number from 5 to 20000")] = 60
    initial: Annotated[Literal["binormal", "normal"], Meta(description="binormal, or normal for the failure of Fig. 25")] = \
        "binormal"


class SurfaceDesign(Strict, kw_only=True, frozen=True):
    """The recipe of a reconstruction (§3.1)."""

    surface: Surface
    pattern: SurfacePattern = msgspec.field(default_factory=SurfacePattern)
    units: Units = "mm"

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them; keys that are not set are left out."""
        return without_none(msgspec.to_builtins(self))

"""The recipe of a reconstruction."""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

from plisse.recipe.design import Solve
from plisse.recipe.fields import Inclination, Length, Point, Range, Strict, Units, without_none
from plisse.recipe.strips import Strips

__all__ = ["Pull", "Section", "Surface", "SurfaceDesign", "SurfacePattern"]

Degrees = Annotated[float, Meta(ge=20, le=160, description="degrees from 20 to 160")]
Turn = Annotated[list[float], Meta(min_length=2, max_length=2, description="two angles in degrees")]


class Section(Strict, kw_only=True, frozen=True):
    """The curve in which the plane through `point` orthogonal to `normal` cuts a surface, the part nearest to `point`."""

    point: Point
    normal: Point


class Pull(Strict, kw_only=True, frozen=True):
    """An edit of a surface: `point` moves by `displacement`, its surroundings follow smoothly up to `radius`."""

    point: Point
    displacement: Point
    radius: Length


class Surface(Strict, kw_only=True, frozen=True):
    """A reference surface: a mesh file, a height z(x, y) over a rectangle, a radius r(x) about the z axis for x = z
    over the range `x`, or a torus [R, r].

    Creases are pseudo-geodesics of constant inclination along a guide: `guide` (points joined on the surface),
    `guide_file` (points in a file), `guide_section` (a plane section), or `guide_boundary` (a boundary loop, 1 for the
    longest). `guide_closed` closes the first two. Their `directions` are "tuned" for even gaps, "orthogonal", or an
    angle with the guide. Around a `point` they start in all directions, or in a range of `directions` [from, to], counted
    about the normal from the x axis. They run for `reach` at most, over the boundary where `beyond` allows it, and the
    family is cropped to a rectangle or to the surface's outline.
    Otherwise rows are laid out over the whole surface, around `centre` where it is given, and inclinations are fitted.
    `side` says where the first crease lies, above being where the normals point. `boundary` keeps the surface's
    boundary: rows of an annulus begin and end on it, a family starts on it, and no crease reaches beyond.
    At most `seams` cut a whole surface apart along rulings where one sheet does not reach; left out, it stays in one
    piece unless seams cover notably more.
    `handles`, or an `edited_file` with the same faces, change the surface after it was laid out and solved; the
    structure follows and is solved again (Fig. 23). Without `overhang` fitted pleats open by 15° at least and upright ones
    are preferred; the report says how many faces overhang all the same. Along guides `overhang = false` refuses sizes
    that would.
    """

    file: str | None = None
    height: str | None = None
    radius: str | None = None
    torus: tuple[Length, Length] | None = None
    x: Range = (-100.0, 100.0)
    y: Range = (-100.0, 100.0)
    centre: Point | None = None
    overhang: bool | None = None
    guide: Annotated[list[Point], Meta(min_length=2, description="two or more points [x, y, z]")] | None = None
    guide_file: str | None = None
    guide_section: Section | None = None
    guide_boundary: Annotated[int, Meta(ge=1, le=10_000, description="the number of a boundary loop, 1 for the longest")] \
        | None = None
    guide_closed: bool = False
    point: Point | None = None
    directions: Annotated[Literal["tuned", "orthogonal"] | Degrees | Turn, Meta(
        description="tuned, orthogonal or degrees from 20 to 160 along a guide, [from, to] at a point")] | None = None
    reach: Length | None = None
    handles: list[Pull] | None = None
    edited_file: str | None = None
    beyond: bool = False
    crop: Annotated[Literal["rectangle", "outline"], Meta(description="rectangle or outline")] | None = None
    side: Annotated[Literal["below", "above"], Meta(description="below or above")] = "below"
    boundary: bool = False
    seams: Annotated[int, Meta(ge=0, le=100, description="a whole number from 0 to 100")] | None = None

    @property
    def has_guide(self) -> bool:
        """Whether creases are shot from a guide."""
        return not all(way is None for way in (self.guide, self.guide_file, self.guide_section, self.guide_boundary))

    @property
    def is_guided(self) -> bool:
        """Whether creases have constant inclination, from a guide or around a point."""
        return self.has_guide or self.point is not None


class SurfacePattern(Strict, kw_only=True, frozen=True):
    """What may be asked of the pleats over a surface; everything else follows from its size and curvature.

    Along a guide or around a point `theta` is kept, and `width` and `amplitude` are needed, around a point `creases` as
    well: they are `width` apart where there is room for so many. Over a whole surface `theta` is a preference, and the
    report gives the inclinations along every crease. `samples` are vertices per crease, 60 along a guide; over a whole
    surface the columns of the layout are doubled until there are as many.
    """

    theta: Inclination | None = None
    width: Length | None = None
    amplitude: Length | None = None
    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] | None = None
    samples: Annotated[int, Meta(ge=5, le=20_000, description="a whole number from 5 to 20000")] | None = None
    initial: Annotated[Literal["binormal", "normal"], Meta(description="binormal, or normal for the failure of Fig. 25")] = \
        "binormal"


class SurfaceDesign(Strict, kw_only=True, frozen=True):
    """The recipe of a reconstruction (§3.1)."""

    surface: Surface
    pattern: SurfacePattern = msgspec.field(default_factory=SurfacePattern)
    solve: Solve = msgspec.field(default_factory=Solve)
    strips: Strips | None = None
    units: Units = "mm"

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them; keys without meaning are left out."""
        data = without_none(msgspec.to_builtins(self))
        for name in ("x", "y") if self.surface.height is None else ():
            if name == "y" or self.surface.radius is None:
                del data["surface"][name]
        return data

"""The recipe of a structure: one typed tree for TOML, Python, the command line and provenance.

Angles are in degrees and lengths in model units here and only here; everything behind uses radians.
"""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

__all__ = ["MILLIMETRES", "Arc", "ClosedForm", "Cones", "ConicCreases", "Curve", "Design", "Ellipse", "Helix", "Miura",
           "Pattern", "Points", "Pull", "Solve", "Spline", "Surface", "SurfaceDesign", "SurfacePattern", "TorusKnot"]

Length = Annotated[float, Meta(ge=1e-9, le=1e9, description="a length in model units from 1e-9 to 1e9")]
Inclination = Annotated[float, Meta(ge=0, lt=90, description="degrees from 0 up to, not including, 90")]
Units = Annotated[Literal["mm", "cm", "m", "in", "ft"], Meta(description="mm, cm, m, in or ft")]
Range = Annotated[tuple[float, float], Meta(description="two rising numbers")]
Point = Annotated[list[float], Meta(min_length=3, max_length=3, description="three coordinates [x, y, z]")]


class _Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    pass


class Arc(_Strict, tag_field="kind", tag="arc", kw_only=True, frozen=True):
    """Circular arc of `radius` about the z axis through `angle` degrees, symmetric about the x axis."""

    radius: Length
    angle: Annotated[float, Meta(ge=1, le=360, description="degrees from 1 to 360")] = 180.0
    closed: bool = False


class Helix(_Strict, tag_field="kind", tag="helix", kw_only=True, frozen=True):
    """Helix about the z axis; `pitch` is the rise per turn."""

    radius: Length
    pitch: Annotated[float, Meta(ge=-1e9, le=1e9, description="rise per turn in model units, up to 1e9")]
    turns: Annotated[float, Meta(ge=0.01, le=50, description="a number of turns from 0.01 to 50")] = 1.0
    closed: bool = False


class Ellipse(_Strict, tag_field="kind", tag="ellipse", kw_only=True, frozen=True):
    """Ellipse in the xy plane with half axes a and b, closed unless `angle` < 360 degrees of its parameter."""

    a: Length
    b: Length
    angle: Annotated[float, Meta(ge=1, le=360, description="degrees from 1 to 360")] = 360.0
    closed: bool = True


class TorusKnot(_Strict, tag_field="kind", tag="torus-knot", kw_only=True, frozen=True):
    """(p, q) torus knot: p times around the axis at radius R, q times around the tube of radius r.

    `rz` is the tube's half height where it differs from r.
    """

    p: Annotated[int, Meta(ge=1, le=30, description="a whole number from 1 to 30")]
    q: Annotated[int, Meta(ge=1, le=30, description="a whole number from 1 to 30")]
    R: Length
    r: Length
    rz: Length | None = None
    closed: bool = True


class Spline(_Strict, tag_field="kind", tag="spline", kw_only=True, frozen=True):
    """Quintic spline that interpolates the points; `file` (.csv .txt .npy .obj) stands for `points`."""

    points: Annotated[list[Point], Meta(description="a list of points [x, y, z]")] | None = None
    file: str | None = None
    closed: bool = False


class Points(_Strict, tag_field="kind", tag="points", kw_only=True, frozen=True):
    """A measured polyline, smoothed over the length `smooth` (0: interpolated)."""

    points: Annotated[list[Point], Meta(description="a list of points [x, y, z]")] | None = None
    file: str | None = None
    smooth: Annotated[float, Meta(ge=0, le=1e9, description="a length in model units, 0 for none")] = 0.0
    closed: bool = False


Curve = Arc | Helix | Ellipse | TorusKnot | Spline | Points


class Pattern(_Strict, kw_only=True, frozen=True):
    """The guiding curves and how far the zigzag leaves them (§3.2, §3.3)."""

    theta: Annotated[Inclination | list[Inclination],
                     Meta(description="degrees from 0 up to, not including, 90: one number or one per crease")] = 0.0
    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")]
    width: Annotated[Length | list[Length | list[float]],
                     Meta(description="one length, one per strip, or a table [[position, width], …]")]
    amplitude: Length
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 200
    spacing: Annotated[Literal["mirror", "uniform"],
                       Meta(description="mirror (widths coupled by Fig. 11) or uniform (the paper's)")] = "mirror"
    method: Annotated[Literal["accurate", "paper"],
                      Meta(description="accurate (midpoint steps) or paper (one step of Fig. 14 per strip)")] = "accurate"
    smoothing: Annotated[float, Meta(ge=1e-3, le=1, description="a fraction of the curve's length")] | None = None


class Cones(_Strict, tag_field="kind", tag="cones", kw_only=True, frozen=True):
    """Alternating cones of equal slope: creases develop into concentric circles."""

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] = 8
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 100
    radius: Length = 100.0
    width: Length = 6.0
    slope: Annotated[float, Meta(ge=0.01, le=100, description="rise over run, from 0.01 to 100")] = 1.0
    sector: Annotated[float, Meta(ge=1, le=360, description="degrees from 1 to 360")] = 120.0


class ConicCreases(_Strict, tag_field="kind", tag="conic-creases", kw_only=True, frozen=True):
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


class Miura(_Strict, tag_field="kind", tag="miura", kw_only=True, frozen=True):
    """The Miura-ori with zigzag creases; `sector` and `fold` in degrees."""

    creases: Annotated[int, Meta(ge=3, le=1000, description="a whole number from 3 to 1000")] = 7
    samples: Annotated[int, Meta(ge=3, le=20_000, description="a whole number from 3 to 20000")] = 12
    edge: Length = 10.0
    ruling: Length = 12.0
    sector: Annotated[float, Meta(gt=5, lt=90, description="degrees between 5 and 90")] = 65.0
    fold: Annotated[float, Meta(gt=1, lt=89, description="degrees between 1 and 89")] = 50.0


ClosedForm = Cones | ConicCreases | Miura


class Solve(_Strict, kw_only=True, frozen=True):
    """How the zigzag becomes exact (§3.4)."""

    principal: bool = False
    method: Annotated[Literal["exact", "paper"], Meta(description="exact or paper")] = "exact"
    weights: Annotated[list[Annotated[float, Meta(ge=0, description="a weight, at least 0")]],
                       Meta(min_length=5, max_length=5,
                            description="five weights: planarity, closeness, isometry, fairness, principal")] | None = None
    iterations: Annotated[int, Meta(ge=1, le=1000, description="a whole number from 1 to 1000")] = 20
    cut: Annotated[float, Meta(ge=0, lt=100, description="percent of the crease's length, from 0 below 100")] | None = None


class Design(_Strict, kw_only=True, frozen=True):
    """A whole recipe, as `report.json` repeats it with all defaults: curve and pattern, or a closed form."""

    curve: Curve | None = None
    pattern: Pattern | None = None
    closed_form: ClosedForm | None = None
    solve: Solve = msgspec.field(default_factory=Solve)
    units: Units = "mm"

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them; keys that are not set are left out."""
        return _without_none(msgspec.to_builtins(self))

    @property
    def is_closed(self) -> bool:
        """Whether the creases are closed curves."""
        return self.curve is not None and self.curve.closed


class Pull(_Strict, kw_only=True, frozen=True):
    """An edit of a surface: `point` moves by `displacement`, its surroundings follow smoothly up to `radius`."""

    point: Point
    displacement: Point
    radius: Length


class Surface(_Strict, kw_only=True, frozen=True):
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


class SurfacePattern(_Strict, kw_only=True, frozen=True):
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


class SurfaceDesign(_Strict, kw_only=True, frozen=True):
    """The recipe of a reconstruction (§3.1)."""

    surface: Surface
    pattern: SurfacePattern = msgspec.field(default_factory=SurfacePattern)
    units: Units = "mm"

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them; keys that are not set are left out."""
        return _without_none(msgspec.to_builtins(self))


def _without_none(value):
    if isinstance(value, dict):
        return {key: _without_none(item) for key, item in value.items() if item is not None}
    return value


MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}

"""The recipe of a structure: one typed tree for TOML, Python, the command line and provenance.

Angles are in degrees and lengths in model units here and only here; everything behind uses radians.
"""

from typing import Annotated, Literal

import msgspec
from msgspec import Meta

__all__ = ["Arc", "Curve", "Design", "Ellipse", "Helix", "Pattern", "Points", "Solve", "Spline", "TorusKnot"]

Length = Annotated[float, Meta(gt=0, description="a positive length in model units")]
Inclination = Annotated[float, Meta(ge=0, lt=90, description="degrees from 0 up to, not including, 90")]
Point = Annotated[list[float], Meta(min_length=3, max_length=3, description="three coordinates [x, y, z]")]


class _Strict(msgspec.Struct, frozen=True, forbid_unknown_fields=True, kw_only=True):
    pass


class Arc(_Strict, tag_field="kind", tag="arc", kw_only=True):
    """Circular arc of `radius` about the z axis through `angle` degrees, symmetric about the x axis."""

    radius: Length
    angle: Annotated[float, Meta(gt=0, le=360, description="degrees above 0, at most 360")] = 180.0
    closed: bool = False


class Helix(_Strict, tag_field="kind", tag="helix", kw_only=True):
    """Helix about the z axis; `pitch` is the rise per turn."""

    radius: Length
    pitch: Annotated[float, Meta(description="rise per turn in model units")]
    turns: Annotated[float, Meta(gt=0, le=50, description="number of turns above 0, at most 50")] = 1.0
    closed: bool = False


class Ellipse(_Strict, tag_field="kind", tag="ellipse", kw_only=True):
    """Ellipse in the xy plane with half axes a and b, closed unless `angle` < 360 degrees of its parameter."""

    a: Length
    b: Length
    angle: Annotated[float, Meta(gt=0, le=360, description="degrees above 0, at most 360")] = 360.0
    closed: bool = True


class TorusKnot(_Strict, tag_field="kind", tag="torus-knot", kw_only=True):
    """(p, q) torus knot: p times around the axis at radius R, q times around the tube of radius r.

    `rz` is the tube's half height where it differs from r.
    """

    p: Annotated[int, Meta(ge=1, le=30, description="a whole number from 1 to 30")]
    q: Annotated[int, Meta(ge=1, le=30, description="a whole number from 1 to 30")]
    R: Length
    r: Length
    rz: Length | None = None
    closed: bool = True


class Spline(_Strict, tag_field="kind", tag="spline", kw_only=True):
    """Quintic spline that interpolates the points; `file` (.csv .txt .npy .obj) stands for `points`."""

    points: Annotated[list[Point], Meta(description="a list of points [x, y, z]")] | None = None
    file: str | None = None
    closed: bool = False


class Points(_Strict, tag_field="kind", tag="points", kw_only=True):
    """A measured polyline, smoothed over the length `smooth` (0: interpolated)."""

    points: Annotated[list[Point], Meta(description="a list of points [x, y, z]")] | None = None
    file: str | None = None
    smooth: Annotated[float, Meta(ge=0, description="a length in model units, 0 for none")] = 0.0
    closed: bool = False


Curve = Arc | Helix | Ellipse | TorusKnot | Spline | Points


class Pattern(_Strict, kw_only=True):
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
    smoothing: Annotated[float, Meta(gt=0, le=1, description="a fraction of the curve's length")] | None = None


class Solve(_Strict, kw_only=True):
    """How the zigzag becomes exact (§3.4)."""

    principal: bool = False
    method: Annotated[Literal["exact", "paper"], Meta(description="exact or paper")] = "exact"
    weights: Annotated[list[Annotated[float, Meta(ge=0, description="a weight, at least 0")]],
                       Meta(min_length=5, max_length=5,
                            description="five weights: planarity, closeness, isometry, fairness, principal")] | None = None
    iterations: Annotated[int, Meta(ge=1, le=1000, description="a whole number from 1 to 1000")] = 20
    cut: Annotated[float, Meta(ge=0, lt=100, description="percent of the crease's length, from 0 below 100")] | None = None


class Design(_Strict, kw_only=True):
    """A whole recipe, as `report.json` repeats it with all defaults."""

    curve: Curve
    pattern: Pattern
    solve: Solve = msgspec.field(default_factory=Solve)
    units: Annotated[Literal["mm", "cm", "m", "in", "ft"], Meta(description="mm, cm, m, in or ft")] = "mm"

    def to_dict(self) -> dict:
        """Plain dictionaries and lists, as TOML or JSON would hold them."""
        return msgspec.to_builtins(self)


MILLIMETRES = {"mm": 1.0, "cm": 10.0, "m": 1000.0, "in": 25.4, "ft": 304.8}

"""Seed curves of an evolution."""

from typing import Annotated

from msgspec import Meta

from plisse.recipe.fields import Length, Point, Strict

__all__ = ["Arc", "Curve", "Ellipse", "Helix", "Points", "Spline", "TorusKnot"]


class Arc(Strict, tag_field="kind", tag="arc", kw_only=True, frozen=True):
    """Circular arc of `radius` about the z axis through `angle` degrees, symmetric about the x axis."""

    radius: Length
    angle: Annotated[float, Meta(ge=1, le=360, description="degrees from 1 to 360")] = 180.0
    closed: bool = False


class Helix(Strict, tag_field="kind", tag="helix", kw_only=True, frozen=True):
    """Helix about the z axis; `pitch` is the rise per turn."""

    radius: Length
    pitch: Annotated[float, Meta(ge=-1e9, le=1e9, description="rise per turn in model units, up to 1e9")]
    turns: Annotated[float, Meta(ge=0.01, le=50, description="a number of turns from 0.01 to 50")] = 1.0
    closed: bool = False


class Ellipse(Strict, tag_field="kind", tag="ellipse", kw_only=True, frozen=True):
    """Ellipse in the xy plane with half axes a and b, closed unless `angle` < 360 degrees of its parameter."""

    a: Length
    b: Length
    angle: Annotated[float, Meta(ge=1, le=360, description="degrees from 1 to 360")] = 360.0
    closed: bool = True


class TorusKnot(Strict, tag_field="kind", tag="torus-knot", kw_only=True, frozen=True):
    """(p, q) torus knot: p times around the axis at radius R, q times around the tube of radius r.

    `rz` is the tube's half height where it differs from r.
    """

    p: Annotated[int, Meta(ge=1, le=30, description="a whole number from 1 to 30")]
    q: Annotated[int, Meta(ge=1, le=30, description="a whole number from 1 to 30")]
    R: Length
    r: Length
    rz: Length | None = None
    closed: bool = True


class Spline(Strict, tag_field="kind", tag="spline", kw_only=True, frozen=True):
    """Quintic spline that interpolates the points; `file` (.csv .txt .npy .obj) stands for `points`."""

    points: Annotated[list[Point], Meta(description="a list of points [x, y, z]")] | None = None
    file: str | None = None
    closed: bool = False


class Points(Strict, tag_field="kind", tag="points", kw_only=True, frozen=True):
    """A measured polyline, smoothed over the length `smooth` (0: interpolated)."""

    points: Annotated[list[Point], Meta(description="a list of points [x, y, z]")] | None = None
    file: str | None = None
    smooth: Annotated[float, Meta(ge=0, le=1e9, description="a length in model units, 0 for none")] = 0.0
    closed: bool = False


Curve = Arc | Helix | Ellipse | TorusKnot | Spline | Points
